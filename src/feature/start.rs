//! What the pixels of rays begin with.

use crate::part::rows::{Feature, Why};

/// A value that every ray begins with, whether it takes a sample or not.
pub const START: Feature = Feature::of_frame("start of rays", |context| match context.projection().shows_values() {
    true if context.method.loops() => Err(Why::Untold),
    true => Ok(()),
    false => Err(Why::Untold),
});
