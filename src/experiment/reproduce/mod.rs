//! The thesis' tables, theirs beside ours.

mod page;
pub mod papers;
mod record;
mod rows;
mod text;

pub use page::page;
pub use record::{FORMAT, ReproducedSet, Reproduction, Shown, Variant};
pub use rows::{FragmentLine, lines, verdict};
pub use text::{csv, text};
