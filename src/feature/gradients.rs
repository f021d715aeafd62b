//! Gradients in a texture, in place of differences in the shader [Stegmaier05 §4, Thesis ch. 7 §7.3].

use super::lights::LIT_SAMPLES;
use super::surface::is_drawn;
use crate::error::{self, Error};
use crate::part::Constant;
use crate::part::rows::{Context, Feature, Hook, Why};
use crate::resource;
use crate::scene::Scene;
use crate::scene::gradients::GradientCoding;
use crate::scene::settings::{GradientOperator, GradientTexture, Gradients};

/// A texture of gradients, which the lighting pass reads.
pub const GRADIENT_TEXTURE: Feature = Feature {
    with: Some("GRADIENTS"),
    constants: |context| if needed(context).is_ok() { vec![codes(context.scene)] } else { Vec::new() },
    reads: |context| vec![resource::gradients(context.scene)],
    ..Feature::at(Hook::Light, "gradient texture", needed)
};

fn needed(context: &Context) -> Result<(), Why> {
    let there = context.has(&LIT_SAMPLES) || is_drawn(context) && !context.method.goes_through_cells();
    match (context.scene.settings.shading.gradients, there && context.scene.reads_gradients()) {
        (Gradients::Precomputed, true) => Ok(()),
        (Gradients::Precomputed, false) if context.scene.effect.is_some() => {
            Err("effects on samples without lights take gradients in the shader".into())
        }
        (Gradients::Precomputed, false) => Err("no gradient is read".into()),
        (Gradients::OnTheFly, true) => Err("gradients are taken in the shader".into()),
        (Gradients::OnTheFly, false) => Err(Why::Untold),
    }
}

/// Samples that take value and gradient from one texture.
pub const GRADIENTS_BESIDE_SAMPLES: Feature = Feature {
    with: Some("GRADIENTS"),
    constants: |context| if beside_samples(context) { back(context.scene) } else { Vec::new() },
    reads: |context| vec![resource::gradients(context.scene)],
    ..Feature::at(Hook::Sample, "gradients beside samples", |context| {
        if beside_samples(context) { Ok(()) } else { Err(Why::Untold) }
    })
};

fn beside_samples(context: &Context) -> bool {
    context.has(&LIT_SAMPLES) && context.has(&GRADIENT_TEXTURE)
}

/// Of `gradient.glsl`: what the value beside a gradient is in the volume's texture.
fn back(scene: &Scene) -> Vec<Constant> {
    let [times, plus] = GradientCoding::of(scene).back.map(f32::to_bits);
    vec![("VALUE_TIMES", times), ("VALUE_PLUS", plus), codes(scene)]
}

/// Of `gradient.glsl`: whether gradients are codes of 8 bits.
fn codes(scene: &Scene) -> Constant {
    ("GRADIENT_CODES", u32::from(scene.settings.shading.format == GradientTexture::Rgba8))
}

/// Whether gradients can be had as a scene asks.
///
/// # Errors
/// When they cannot.
pub fn check(scene: &Scene) -> error::Result<()> {
    let shading = &scene.settings.shading;
    match (shading.gradients, shading.gradient) {
        (Gradients::OnTheFly, GradientOperator::Sobel) => Err(Error::usage(
            "shading.gradient (--gradient sobel)",
            "is made of 27 voxels before frames, and shaders take central differences",
            "use --gradients precomputed, or --gradient central",
        )),
        _ => Ok(()),
    }
}
