//! Pre-integrated classification [Stegmaier05 §4].

use super::classification::CLASSIFICATION;
use crate::part::rows::{Feature, Hook, Why};
use crate::resource;

/// A table of what the transfer function gives between two values, and its axes.
pub const PREINTEGRATION: Feature = Feature {
    with: Some("PREINTEGRATED"),
    reads: |_| vec![resource::PREINTEGRATED, resource::AXIS],
    ..Feature::at(Hook::Sample, "pre-integrated table", |context| {
        match context.scene.settings.sampling.preintegrates() {
            true => Ok(()),
            false if !context.has(&CLASSIFICATION) => Err(Why::Untold),
            false => Err("samples are classified by their own value".into()),
        }
    })
};
