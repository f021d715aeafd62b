//! What is asked of the methods and of a device. Each experiment has its `run` (what is measured), its `record` (what is
//! kept as JSON), its `text` for a terminal and its `page` for a reader, as far as it needs them.
//!
//! 1. [`bench`]: every method on every scene. [`orbit`]: frames of a camera that goes around.
//! 2. [`reproduce`]: the papers' tables, theirs beside ours.
//! 3. [`accuracy`]: error against run time. [`stability`]: stiff and extreme scenes.
//! 4. [`mod@probe`]: what a driver culls before shading.
//! 5. [`mod@compare`]: two results, of other devices or commits.

pub mod accuracy;
pub mod bench;
pub mod compare;
pub mod orbit;
pub mod probe;
pub mod reproduce;
pub mod stability;
