//! An artificial cost of samples.

use crate::part::rows::{Feature, Hook, Why};

/// Further fetches of the volume with each sample, which change no picture.
pub const EXTRA_FETCHES: Feature = Feature {
    constants: |context| vec![("EXTRA_FETCHES", context.scene.settings.sampling.extra_fetches)],
    ..Feature::at(Hook::Sample, "extra fetches", |context| match context.scene.settings.sampling.extra_fetches {
        0 => Err(Why::Untold),
        _ => Ok(()),
    })
};
