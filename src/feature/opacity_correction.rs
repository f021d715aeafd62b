//! Opacities for other lengths than the reference length.

use super::classification::CLASSIFICATION;
use super::preintegration::PREINTEGRATION;
use crate::part::rows::{Context, Feature, Hook, Why};
use crate::scene::settings::{Alpha, Last};

/// 1 - (1 - a)^(length / reference) for every sample.
pub const OPACITY_CORRECTION: Feature = Feature {
    constants: |context| vec![("CORRECT_OPACITY", u32::from(context.has(&OPACITY_CORRECTION)))],
    ..Feature::at(Hook::Sample, "opacity correction", needed)
};

fn needed(context: &Context) -> Result<(), Why> {
    if !context.has(&CLASSIFICATION) {
        return Err(Why::Untold);
    }
    let sampling = &context.scene.settings.sampling;
    if sampling.alpha == Alpha::Paper {
        return Err("alpha = \"paper\" takes opacities as they stand".into());
    }
    if context.scene.last() == Last::Partial {
        return Ok(());
    }
    // The way from slice to slice is another one on each ray.
    if context.view.slices.as_ref().is_some_and(|slices| !slices.evenly_spaced(&context.view.rays)) {
        return Ok(());
    }
    if context.has(&PREINTEGRATION) {
        return Err("the pre-integrated table is made for the step".into());
    }
    if sampling.step == context.scene.transfer.reference {
        return Err("the step is the reference length".into());
    }
    Ok(())
}
