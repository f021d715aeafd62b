//! Two results side by side: other devices, drivers or commits. Counts are compared exactly, times with their spread.

mod record;
mod text;

pub use record::{Comparison, Difference, FORMAT, RunComparison, TimeDifference, compare};
pub use text::text;
