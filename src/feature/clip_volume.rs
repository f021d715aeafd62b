//! Another volume, by whose values the scene's own one is clipped [Stegmaier05 §6].
//!
//! Samples are kept or clipped as a whole, by the clip volume's value where they are; surfaces by place, so that a ray which comes
//! into what is kept within surfaces meets the innermost of them there, as at a clip plane. Skipping stays lossless: what is clipped
//! counts as nothing, and where surfaces let something through all that lies within one is interesting, since a cut may show it.

use crate::error::{Error, Result};
use crate::part::rows::{Feature, Hook, Why};
use crate::resource;
use crate::scene::Scene;

/// Another volume, inside or outside of whose level is what is kept.
pub const CLIP_VOLUME: Feature = Feature {
    with: Some("CLIP_VOLUME"),
    constants: |context| {
        let clip = context.scene.cutting_volume();
        clip.map(|clip| ("KEEPS_INSIDE", u32::from(clip.keeps_inside))).into_iter().collect()
    },
    reads: |_| vec![resource::CLIP_VOLUME, resource::CLIP_VOLUME_PLACE],
    ..Feature::at(Hook::Sample, "clip volume", |context| match context.scene.clip_volume {
        None => Err(Why::Untold),
        Some(_) if context.scene.cutting_volume().is_none() => Err("it cuts nothing off the volume".into()),
        Some(_) => Ok(()),
    })
};

/// Whether a scene's clip volume has a meaning with what else it asks for.
///
/// # Errors
/// When light goes on ways on which nobody asks what is clipped.
pub fn check(scene: &Scene) -> Result<()> {
    let effects = &scene.settings.effects;
    let input = match () {
        () if scene.clip_volume.is_none() => return Ok(()),
        () if effects.shadows => "effects.shadows (--shadows)",
        () if effects.translucency.is_some() => "effects.translucency (--translucency)",
        () if effects.refraction.is_some() => "effects.refraction (--refraction)",
        () => return Ok(()),
    };
    Err(Error::usage(
        input,
        "leads light through the volume as it is without a clip volume, and the scene has one",
        "leave it out, or cut with planes (--clip-plane) in place of clip.volume",
    ))
}

/// Whether a method that goes along rays in passes draws the scene.
///
/// # Errors
/// When it has a clip volume, of which one loop alone knows.
pub fn check_passes(scene: &Scene) -> Result<()> {
    if scene.clip_volume.is_none() {
        return Ok(());
    }
    Err(Error::usage(
        format!("--method {}", scene.settings.method.name),
        "takes no clip volume, and clip.volume gives one",
        "use --method single-pass, or another single-pass method, or cut with planes or meshes",
    ))
}
