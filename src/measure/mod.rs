//! Measuring, and nothing else: [`runner`] runs frames and leaves a [`record::Run`] with its pictures ([`measured`]);
//! [`abreast`] takes several scenes in turn.
//!
//! 1. [`record`]: one run and the results file; the reference of the format.
//! 2. [`statistics`], [`timing`]: a median and how far the samples lie from it.
//! 3. [`picture`], [`error`]: float pictures, their files, and how far one lies from another.
//! 4. [`law`]: skipping changes no picture; [`saving`]: what became of the fragments saved.
//! 5. [`costs`]: what work costs on a device, for `auto`.
//! 6. [`limits`]: whether a scene fits; [`mod@write`]: files that are there completely or not at all.

pub mod abreast;
mod checked;
mod chosen;
pub mod costs;
mod entries;
pub mod error;
mod facts;
pub mod fragment_kind;
mod frame_times;
pub mod law;
pub mod limits;
pub mod measured;
pub mod notes;
pub mod picture;
pub mod ply;
pub mod record;
pub mod runner;
pub mod saving;
pub mod statistics;
pub mod timing;
pub mod view;
mod warnings;
pub mod write;

pub use checked::{Checked, CostSource};
pub(crate) use checked::{no_device, refuse_missing};
pub use error::{PictureError, compare};
pub use measured::Measured;
pub use picture::Picture;
pub use record::{Results, Run};
pub use statistics::Statistics;
pub use timing::{HostTimes, Timing, Timings};
pub use write::write_atomically;
