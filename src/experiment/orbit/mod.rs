//! Frames of a camera that goes around the volume: which structure each of them read, and what it saved.

mod record;
mod run;

pub use record::Summary;
pub use run::{Orbit, orbit, orbits};
