//! `auto`: which method draws a scene, and with which settings, from a look at the scene that takes a small part of a frame.
//!
//! [`Look`] casts a coarse grid of rays through the voxels, [`Work`] estimates from it what each method of
//! `crate::method::METHODS` would do, `cost` turns that into time by constants that were measured and by [`DeviceCosts`], which say what a
//! device makes of these, and `choose` takes the least.

mod choose;
mod coarse;
mod cost;
mod device_costs;
mod error;
mod look;
mod record;
mod settle;
mod small;
mod tunings;
mod work;

pub use choose::{DeviceFacts, MethodFacts, choose, timed};
pub use coarse::Coarse;
pub use cost::{build_ms, frame_ms};
pub use device_costs::{DeviceCosts, Factors, KINDS, TimedFrame, Way};
pub use error::{ErrorChoice, Tried};
pub use look::{Look, LookRay, Seen};
pub use record::{AutoRecord, Estimate};
pub use settle::{is_asked, settle};
pub use tunings::Tuning;
pub use work::Work;

/// The text that estimates follow from: costs that were measured by another one are of no use.
pub const MODEL: [&str; 4] =
    [include_str!("coarse.rs"), include_str!("cost.rs"), include_str!("look.rs"), include_str!("work.rs")];
