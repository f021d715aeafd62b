//! What measuring a method leaves.

use super::picture::Picture;
use super::record::Run;
use crate::part::rows::Method;

/// A run and its pictures.
#[derive(Clone, Debug)]
pub struct Measured {
    /// The method that made it.
    pub method: &'static Method,
    pub run: Run,
    pub picture: Picture,
    /// The f64 twin's picture, where there is one.
    pub reference: Option<Picture>,
    /// Whether the self-check found the form right (or there is nothing to be wrong).
    pub trusted: bool,
    /// Pixels whose bits are not those of the first run with the same samples; none where there is no such run.
    pub differing: Option<u64>,
    /// Frames of an orbit whose picture is not that of the first such run.
    pub differing_frames: Option<u64>,
}
