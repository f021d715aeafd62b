//! A user's effect: GLSL that samples and surfaces go through.
//!
//! Skipping stays lossless: an effect is asked only where the transfer function has given an opacity above 0.

use std::sync::Arc;

use crate::error::{Error, Result};
use crate::glsl::Insert;
use crate::part::Constant;
use crate::part::rows::{Context, Feature, Hook, Why};
use crate::projection;
use crate::scene::Scene;
use crate::scene::effect::SIGNATURE;
use crate::scene::settings::Shows;

/// A user's effect on samples, or on the surfaces that rays meet.
pub const EFFECT: Feature = Feature {
    with: Some("EFFECT"),
    constants: |context| if context.has(&EFFECT) { units(context) } else { Vec::new() },
    ..Feature::at(Hook::Sample, "effect", |context| match context.scene.effect {
        Some(_) => Ok(()),
        None => Err(Why::Untold),
    })
};

/// Of `effect.glsl`: the volume's own values where x is 0, and how much they rise until it is 1.
fn units(context: &Context) -> Vec<Constant> {
    let [low, high] = context.scene.field.range;
    let bits = |value: f64| (value as f32).to_bits();
    vec![("EFFECT_LOW", bits(low)), ("EFFECT_SPAN", bits(high - low))]
}

/// The effect's text, as shaders include it.
pub fn insert(context: &Context) -> Option<Arc<Insert>> {
    let effect = context.scene.effect.as_ref()?;
    Some(Arc::new(Insert { name: effect.name.clone(), text: effect.text.clone(), defines: SIGNATURE }))
}

/// Whether a scene has colours that its effect may change.
///
/// # Errors
/// When it has none, or none that belong to a sample.
pub fn check(scene: &Scene) -> Result<()> {
    let Some(effect) = &scene.effect else { return Ok(()) };
    let (settings, row) = (&scene.settings, projection::of(&scene.settings));
    let remedy = |word: &str| format!("use {word} with --effect {}, or leave the effect out", effect.file());
    match () {
        () if row.shows_values() => Err(Error::usage(
            format!("projection.kind (--projection {})", row.name),
            "shows values, and an effect changes colours",
            remedy("composite"),
        )),
        () if settings.sampling.preintegrates() => Err(Error::usage(
            "sampling.classification (--classification pre-integrated)",
            "makes colours of all values between two samples, and an effect is asked about one",
            remedy("post"),
        )),
        () if scene.surface.is_some() && settings.surface.shows != Shows::Color => Err(Error::usage(
            "surface.shows (--surface-shows)",
            "shows places or normals of surfaces, and an effect changes their colours",
            remedy("color"),
        )),
        () => Ok(()),
    }
}
