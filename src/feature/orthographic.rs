//! Orthographic views, whose rays lie side by side.

use crate::part::rows::{Feature, Hook, Why};

/// Rays that all go the same way.
pub const ORTHOGRAPHIC: Feature = Feature {
    with: Some("ORTHOGRAPHIC"),
    ..Feature::at(Hook::Interval, "orthographic view", |context| match context.view.rays.parallel() {
        true => Ok(()),
        false => Err(Why::Untold),
    })
};
