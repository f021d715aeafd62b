//! Interpolation between voxels: by the shader, by the texture unit, or not at all.

use crate::part::Constant;
use crate::part::rows::{Context, Feature, Hook, Why};
use crate::scene::settings::Filter;

/// Interpolation by the shader, in f32.
pub const SHADER_INTERPOLATION: Feature =
    Feature::at(Hook::Sample, "interpolation in the shader", |context| match context.scene.settings.sampling.filter {
        Filter::Exact => Ok(()),
        Filter::Hardware => Err("the texture unit interpolates".into()),
        Filter::Nearest => Err(Why::Untold),
    });

/// Interpolation between voxels, whoever does it.
pub const INTERPOLATION: Feature = Feature {
    constants,
    ..Feature::at(Hook::Sample, "interpolation", |context| match context.scene.settings.sampling.filter {
        Filter::Hardware | Filter::Exact => Ok(()),
        Filter::Nearest => Err("a sample has the value of the nearest voxel".into()),
    })
};

/// The constant FILTER of `volume.glsl`, by the codes there.
fn constants(context: &Context) -> Vec<Constant> {
    let code = match context.scene.settings.sampling.filter {
        Filter::Hardware => 0,
        Filter::Exact => 1,
        Filter::Nearest => 2,
    };
    vec![("FILTER", code)]
}
