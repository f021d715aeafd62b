//! Cells that stay transparent.

use crate::part::rows::{Feature, Hook};
use crate::resource;

/// A mask of cells that stay transparent, since a value of theirs is missing.
pub const HOLES: Feature = Feature {
    with: Some("HOLES"),
    reads: |_| vec![resource::HOLES],
    ..Feature::at(Hook::Sample, "hole mask", |context| match context.scene.field.holes {
        Some(_) => Ok(()),
        None => Err("every voxel is a number, or is replaced by one".into()),
    })
};
