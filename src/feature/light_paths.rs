//! What becomes of light on its way to surfaces [Stegmaier05 §6].

use super::surface::{ISO_SURFACE, is_lit};
use crate::error::{Error, Result};
use crate::part::rows::{Context, Feature, Hook, Why};
use crate::scene::Scene;
use crate::scene::settings::Find;

/// Surfaces that shade each other and themselves.
pub const SHADOWS: Feature = Feature {
    with: Some("SHADOWS"),
    constants: |context| {
        let bias = context.scene.shadow_bias().filter(|_| context.has(&SHADOWS));
        bias.map(|bias| ("SHADOW_BIAS", (bias as f32).to_bits())).into_iter().collect()
    },
    ..Feature::at(Hook::Light, "shadows", |context| match context.scene.shadow_bias() {
        Some(_) => shown(context),
        None => Err(Why::Untold),
    })
};

/// Light that comes through what surfaces enclose.
pub const TRANSLUCENCY: Feature = Feature {
    with: Some("TRANSLUCENT"),
    constants: |context| {
        let there = context.scene.translucency().filter(|_| context.has(&TRANSLUCENCY));
        let constants = there.map(|there| [("ABSORPTION", there.absorption), ("THROUGH", there.part)]);
        constants.into_iter().flatten().map(|(name, value)| (name, (value as f32).to_bits())).collect()
    },
    ..Feature::at(Hook::Light, "translucency", |context| match context.scene.translucency() {
        Some(translucency) if context.plans() && translucency.part == 0.0 => Err("its part of colours is 0".into()),
        Some(_) => shown(context),
        None => Err(Why::Untold),
    })
};

fn shown(context: &Context) -> std::result::Result<(), Why> {
    match context.has(&ISO_SURFACE) && !is_lit(context) {
        true => Err("places and normals of surfaces show, which no light changes".into()),
        false if context.has(&ISO_SURFACE) => Ok(()),
        false => Err(Why::Untold),
    }
}

/// Whether what a scene asks for of light has a meaning in it.
///
/// # Errors
/// When there is no surface, or surfaces are places with values in a range.
pub fn check(scene: &Scene) -> Result<()> {
    let Some(input) = asked(scene) else { return Ok(()) };
    match () {
        () if scene.surface.is_none() => Err(Error::usage(
            input,
            "is about light on iso-surfaces, and the scene has none",
            "add one (--iso VALUE, or [surface]), or leave it out",
        )),
        () if scene.settings.surface.find == Find::Range => Err(Error::usage(
            input,
            "needs surfaces that light crosses, and surface.find (--find range) asks for places with a value in a range",
            "use crossing, or leave it out",
        )),
        () => Ok(()),
    }
}

/// Whether a method that goes along rays in passes draws the scene.
///
/// # Errors
/// When light goes further than to where rays meet surfaces.
pub fn check_passes(scene: &Scene) -> Result<()> {
    asked(scene).map_or(Ok(()), |input| {
        Err(Error::usage(
            input,
            "asks for rays from surfaces to lights, and those of several passes end at surfaces",
            "use --method single-pass, or leave it out",
        ))
    })
}

/// The setting that asks for something.
pub(super) fn asked(scene: &Scene) -> Option<&'static str> {
    let effects = &scene.settings.effects;
    match () {
        () if effects.shadows => Some("effects.shadows (--shadows)"),
        () if effects.translucency.is_some() => Some("effects.translucency (--translucency)"),
        () => None,
    }
}
