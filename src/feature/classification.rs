//! Classification by the transfer function.

use super::surface::ISO_SURFACE;
use crate::part::rows::{Feature, Hook};

/// Colours and opacities of values; without, samples have nothing but their value.
pub const CLASSIFICATION: Feature = Feature {
    of_cells: true,
    without: Some("VALUES"),
    ..Feature::at(Hook::Sample, "classification", |context| match context.projection().shows_values() {
        true => Err(format!("{} shows values, not colours", context.projection().name).into()),
        false if context.scene.surfaces_in_volume() => Ok(()),
        false if context.has(&ISO_SURFACE) => Err("a surface has one colour, and samples tell where it is".into()),
        false => Ok(()),
    })
};
