//! `auto`: which method draws a scene, and with which settings, from a look at the scene that takes a small part of a frame.
//!
//! [`Look`] casts a coarse grid of rays through the voxels, [`Work`] estimates from it what each method of
//! `crate::method::METHODS` would do, `cost` turns that into time by constants that were measured, and `choose` takes the least.

mod choose;
mod coarse;
mod cost;
mod error;
mod look;
mod record;
mod settle;
mod small;
mod tunings;
mod work;

pub use choose::{DeviceFacts, MethodFacts, choose};
pub use coarse::Coarse;
pub use cost::{build_ms, frame_ms};
pub use error::{ErrorChoice, Tried};
pub use look::{Look, LookRay, Seen};
pub use record::{AutoRecord, Estimate};
pub use settle::{is_asked, settle};
pub use work::{Tuning, Work};
