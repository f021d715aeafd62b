//! Pre-integrated classification [Stegmaier05 §4].

use crate::part::rows::{Feature, Hook};
use crate::resource;

/// A table of what the transfer function gives between two values, and its axes.
pub const PREINTEGRATION: Feature = Feature {
    with: Some("PREINTEGRATED"),
    reads: |_| vec![resource::PREINTEGRATED, resource::AXIS],
    ..Feature::at(Hook::Sample, "pre-integrated table", |context| {
        match context.scene.settings.sampling.preintegrates() {
            true => Ok(()),
            false => Err("samples are classified by their own value".into()),
        }
    })
};
