//! Lights on samples and on surfaces: the illumination model of Phong [Thesis §4.2.1].

use super::surface::{is_drawn, is_lit};
use crate::error::{Error, Result};
use crate::part::Constant;
use crate::part::resource::Resource;
use crate::part::rows::{Context, Feature, Hook, Why};
use crate::projection;
use crate::resource;
use crate::scene::Scene;

/// Each sample lit by its gradient, which the shader takes [Thesis ch. 7 §7.3].
pub const LIT_SAMPLES: Feature = Feature {
    with: Some("LIT"),
    constants: |context| vec![white_lights(context)],
    reads: |context| vec![lights(context)],
    ..Feature::at(Hook::Sample, "lights on samples", |context| match context.scene.lights.is_empty() {
        false if context.scene.surface.is_some() => Err("lights shine on surfaces, once for all rays".into()),
        false => Ok(()),
        true => Err(Why::Untold),
    })
};

/// Red, green and blue of lights that differ.
pub const LIGHT_COLORS: Feature = Feature::of_frame("colours of lights", |context| {
    if !is_drawn(context) && !context.has(&LIT_SAMPLES) {
        return Err(Why::Untold);
    }
    if is_drawn(context) && !is_lit(context) {
        return Err("places and normals of surfaces show, which no light changes".into());
    }
    match context.plans() && context.scene.shining().iter().all(|light| light.is_white()) {
        true => Err("every light is white".into()),
        false => Ok(()),
    }
});

/// The lights as shaders read them.
pub fn lights(context: &Context) -> Resource {
    if context.has(&LIGHT_COLORS) { resource::LIGHTS } else { resource::WHITE_LIGHTS }
}

/// Of `phong.glsl`: whether lights are white.
pub fn white_lights(context: &Context) -> Constant {
    ("WHITE_LIGHTS", u32::from(!context.has(&LIGHT_COLORS)))
}

/// Whether a scene's lights have something to shine on.
///
/// # Errors
/// When they have not.
pub fn check(scene: &Scene) -> Result<()> {
    if scene.lights.is_empty() || scene.surface.is_some() {
        return Ok(());
    }
    let row = projection::of(&scene.settings);
    if row.shows_values() {
        return Err(Error::usage(
            format!("projection.kind (--projection {})", row.name),
            "shows values, and lights shine on colours",
            "use composite with [[light]], or leave the lights out",
        ));
    }
    if scene.settings.sampling.preintegrates() {
        return Err(Error::usage(
            "sampling.classification (--classification pre-integrated)",
            "makes colours of all values between two samples, which have no gradient",
            "use post with [[light]], or leave the lights out",
        ));
    }
    Ok(())
}
