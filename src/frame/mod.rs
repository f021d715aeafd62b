//! Runs plans: on a device ([`gpu`]) or in f64 through the twins ([`cpu`]).

pub mod background;
pub mod build;
pub mod choice;
pub mod compile;
pub mod cpu;
mod following;
pub mod gpu;
mod object;
mod pipelines;
mod queries;
pub mod resident;
pub mod schedule;
pub mod self_check;
pub mod structures;
pub mod texture_unit;
mod upload;

pub use background::{Background, ServedDistance};
pub use choice::plan_on;
pub use cpu::{Counts, CpuFrame, LayerCounts};
pub use gpu::{EarlyEnd, GpuFrame};
pub use queries::{FrameRun, Measure};
pub use resident::Resident;
pub use self_check::{SelfCheck, Verdict, culls_late, self_check};
pub use structures::Structures;
