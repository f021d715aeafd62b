//! What is asked of the methods and of a device. Each experiment has its `run` (what is measured), its `record` (what is
//! kept as JSON), its `text` for a terminal and its `page` for a reader, as far as it needs them.
//!
//! 1. [`mod@bench`]: every method on every scene. [`orbit`]: frames of a camera that goes around.
//! 2. [`reproduce`]: the papers' tables, theirs beside ours.
//! 3. [`accuracy`]: error against run time. [`stability`]: stiff and extreme scenes.
//! 4. [`mod@probe`]: what a driver culls before shading.
//! 5. [`mod@compare`]: two results, of other devices or commits.
//!
//! An experiment writes its JSON and its pictures into a [`folder`] and then makes its pages of these alone, so that
//! [`mod@render`] can make them again.

pub mod accuracy;
pub mod bench;
pub mod compare;
pub mod folder;
mod host;
pub mod orbit;
pub mod probe;
pub mod render;
pub mod reproduce;
pub mod stability;

pub use host::Host;

/// The file of a bench's results: their report takes the name that others have alone.
const BENCH_JSON: &str = "results.json";
