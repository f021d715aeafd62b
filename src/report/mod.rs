//! From records to what is read: the rows that every comparison shows, what they claim, pages and plots.
//!
//! 1. [`number`]: numbers as a reader wants them.
//! 2. [`comparison`]: runs of one scene side by side, with `rc-block` as the measure of the others; [`limit`]: how far frames are from
//!    what skipping could leave of them.
//! 3. [`cost`]: how what is saved depends on what a sample costs. [`claim`], [`mod@branching`], [`choice`]: what the runs come to, in sentences.
//! 4. [`table`]: rows under columns, as text, CSV and HTML. [`html`]: a page and its pieces. [`plot`]: plots as SVG.

pub mod branching;
pub mod choice;
pub mod claim;
pub mod comparison;
pub mod cost;
pub mod growth;
pub mod html;
pub mod limit;
pub mod number;
pub mod plot;
pub mod table;

pub use branching::branching;
pub use choice::choices;
pub use claim::{claims, verdict};
