//! From counts, times and pictures to tables, JSON, CSV and the report: [`runner`] runs frames and fills a
//! [`record::Run`], everything else here only reads it.
//!
//! 1. [`record`]: one run and the results file; the reference of the format.
//! 2. [`statistics`], [`timing`]: a median and how far the samples lie from it.
//! 3. [`picture`], [`error`]: float pictures, their files, and how far one lies from another.
//! 4. [`comparison`]: runs of one scene side by side, with `rc-block` as the measure of the others.
//! 5. [`saving`]: what became of the fragments saved; [`cost`]: how that depends on what a sample costs.
//! 6. [`orbit`]: frames of a camera that goes around; [`reproduce`]: the papers' tables, theirs beside ours.
//! 7. [`mod@probe`]: what a driver culls. [`accuracy`]: error against run time.
//! 8. [`mod@compare`]: two results, of other devices or commits.
//! 9. [`table`], [`csv`], [`plot`], [`report`]: the same rows for a terminal, a spreadsheet, the eye and a reader.

pub mod accuracy;
pub mod compare;
pub mod comparison;
pub mod cost;
pub mod csv;
mod entries;
pub mod error;
mod frame_times;
pub mod limits;
pub mod number;
pub mod orbit;
pub mod picture;
pub mod plot;
pub mod probe;
pub mod record;
pub mod report;
pub mod reproduce;
pub mod runner;
pub mod saving;
pub mod stability;
pub mod statistics;
pub mod table;
pub mod timing;
mod warnings;
pub mod write;

pub use error::{PictureError, compare};
pub use picture::Picture;
pub use record::{Results, Run};
pub use report::{ReportInput, report_html};
pub use statistics::Statistics;
pub use timing::{HostTimes, Timing, Timings};
pub use write::write_atomically;
