//! Rays that bend where the index of refraction changes [Stegmaier05 §6].

use crate::error::{Error, Result};
use crate::part::Constant;
use crate::part::rows::{Feature, Hook, Why};
use crate::projection;
use crate::resource;
use crate::scene::settings::{Filter, Gradients};
use crate::scene::texture::TextureMap;
use crate::scene::{RefractiveIndex, Scene};

/// Rays that bend at their samples.
pub const REFRACTION: Feature = Feature {
    with: Some("REFRACTION"),
    constants: |context| if context.has(&REFRACTION) { constants(context.scene) } else { Vec::new() },
    reads: |_| vec![resource::REFRACTIVE_INDEX],
    ..Feature::at(Hook::Sample, "refraction", |context| {
        match RefractiveIndex::of(context.scene, TextureMap::IDENTITY) {
            None => Err(Why::Untold),
            Some(_) if context.passes == 0 => Err(Why::Untold),
            Some(index) if context.plans() && !changes(context.scene, &index) => {
                Err("the index of refraction is the same for all values of the volume".into())
            }
            Some(_) => Ok(()),
        }
    })
};

/// Whether the index changes among the values of a scene.
fn changes(scene: &Scene, index: &RefractiveIndex) -> bool {
    let [least, most] = scene.field.extremes().map(f64::from);
    let slack = scene.value_slack();
    index.changing().into_iter().any(|[from, to]| least - slack <= to && from <= most + slack)
}

/// Of `refraction.glsl`.
fn constants(scene: &Scene) -> Vec<Constant> {
    let pieces = scene.settings.effects.refraction.as_ref().map_or(0, |one| one.points.len() as u32 + 1);
    vec![
        ("INDEX_PIECES", pieces),
        ("INDEX_SEARCH", pieces.next_power_of_two() / 2),
        ("LONGEST_WAY", (scene.longest_way() as f32).to_bits()),
    ]
}

/// Whether rays that bend have a meaning with what else the scene asks for.
///
/// # Errors
/// When they have none.
pub fn check(scene: &Scene) -> Result<()> {
    if scene.settings.effects.refraction.is_none() {
        return Ok(());
    }
    let (settings, row) = (&scene.settings, projection::of(&scene.settings));
    let refuse = |input: &str, problem: &str, remedy: &str| Err(Error::usage(input, problem, remedy));
    let kind = format!("projection.kind (--projection {})", row.name);
    match () {
        () if row.shows_values() => refuse(
            &kind,
            "weighs values by the length of rays, which nobody knows of rays that bend before they have ended",
            "use composite, or leave the refraction out",
        ),
        () if scene.surface.is_some() => refuse(
            "surface (--iso)",
            "is sought along straight ways, and effects.refraction (--refraction) bends rays",
            "leave out one of the two",
        ),
        () if scene.polygons.show() || !scene.polygons.clips().is_empty() => refuse(
            "mesh",
            "is seen along straight rays, and effects.refraction (--refraction) bends them",
            "leave out the meshes, or the refraction",
        ),
        () if settings.sampling.filter == Filter::Nearest => refuse(
            "sampling.filter (--filter nearest)",
            "has no values between voxels, where an index of refraction could change",
            "use another filter, or leave the refraction out",
        ),
        () if settings.shading.gradients == Gradients::Precomputed && !scene.lights.is_empty() => refuse(
            "shading.gradients (--gradients precomputed)",
            "keeps gradients whose length is lost, and rays bend by it",
            "use on-the-fly, or leave the refraction out",
        ),
        () => Ok(()),
    }
}

/// Whether a method that goes along rays in passes draws the scene.
///
/// # Errors
/// When its rays would have to bend, or end at a background.
pub fn check_passes(scene: &Scene) -> Result<()> {
    let effects = &scene.settings.effects;
    let asked = match () {
        () if effects.refraction.is_some() => "effects.refraction (--refraction)",
        () if scene.backdrop.is_some() => "effects.background (--behind)",
        () => return Ok(()),
    };
    Err(Error::usage(
        asked,
        "asks for a ray that is held by one shader from its begin to what is behind the volume",
        "use --method single-pass, or leave it out",
    ))
}
