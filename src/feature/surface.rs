//! Iso-surfaces.

use crate::error::{Error, Result};
use crate::part::Constant;
use crate::part::resource::Resource;
use crate::part::rows::{Context, Feature, Hook, Why};
use crate::projection::{self, COMPOSITE};
use crate::resource;
use crate::scene::Scene;
use crate::scene::settings::{Accumulate, Filter, Offset, Refine, Shows};

/// Iso-surfaces that rays look for in place of colours [KW03 §2.2, Thesis ch. 5 §3.2].
pub const ISO_SURFACE: Feature = Feature {
    with: Some("SURFACE"),
    reads: |_| vec![resource::SURFACE_LEVELS],
    ..Feature::at(Hook::Sample, "iso-surface", |context| match context.scene.surface {
        Some(_) if context.passes > 0 => Ok(()),
        _ => Err(Why::Untold),
    })
};

/// What rays gather: colours, or places on a surface that is lit afterwards.
pub fn gathered(context: &Context) -> Resource {
    match context.has(&ISO_SURFACE) && !context.method.loops() {
        true => resource::SURFACE_HIT,
        false => resource::ACCUMULATED,
    }
}

/// Of `lighting.frag`: how the place of a surface is found.
pub fn refine(context: &Context) -> Constant {
    let code = match context.scene.settings.surface.refine {
        Refine::None => 0,
        Refine::Linear => 1,
        Refine::Exact => 2,
    };
    ("REFINE", code)
}

/// Whether the surface's colours show, which lights and a normal make.
pub fn is_lit(context: &Context) -> bool {
    context.scene.settings.surface.shows == Shows::Color
}

/// Of `lighting.frag`: what it shows of a surface; no define where that is its colour.
pub fn shows(context: &Context) -> Option<&'static str> {
    match context.scene.settings.surface.shows {
        Shows::Color => None,
        Shows::Position => Some("SHOWS_POSITION"),
        Shows::Normal => Some("SHOWS_NORMAL"),
    }
}

/// Whether a scene's surfaces can be drawn as it asks.
///
/// # Errors
/// When what else the scene asks for has no meaning with surfaces.
pub fn check(scene: &Scene) -> Result<()> {
    let (settings, row) = (&scene.settings, projection::of(&scene.settings));
    if scene.surface.is_none() {
        return Ok(());
    }
    let sampling = &settings.sampling;
    let transparent = settings.surface.levels.iter().find(|level| level.opacity < 1.0);
    match () {
        () if row.name != COMPOSITE.name => {
            let input = format!("projection.kind (--projection {})", row.name);
            refuse(&input, "shows values, and a surface is where one is, not how large", "use composite with surfaces")
        }
        () if sampling.preintegrates() => refuse(
            "sampling.classification (--classification pre-integrated)",
            "makes colours of the values between samples, and surfaces have one of their own",
            "use post with surfaces",
        ),
        () if sampling.offset != Offset::Left => refuse(
            "sampling.offset (--offset midpoint)",
            "takes no sample where a ray begins, and surfaces are sought from there on",
            "use left with surfaces",
        ),
        () if scene.field.holes.is_some() => refuse(
            "volume.nan (--nan hole)",
            "leaves cells without values, and no surface goes through them",
            "use --nan replace with surfaces",
        ),
        () if sampling.filter == Filter::Nearest && settings.surface.refine != Refine::None => refuse(
            "sampling.filter (--filter nearest)",
            "has no values between voxels, where the place of a surface could be refined",
            "use --refine none, or another filter",
        ),
        () if transparent.is_some() => refuse(
            "surface.levels",
            "has a surface with an opacity below 1, and rays of several passes end at the first surface that they meet",
            "give opacity = 1, or leave it out",
        ),
        () if settings.surface.shows != Shows::Color => check_numbers(scene),
        () => Ok(()),
    }
}

/// Whether a picture can hold places or normals, which are numbers of either sign.
fn check_numbers(scene: &Scene) -> Result<()> {
    let accumulate = match scene.settings.image.accumulate {
        Accumulate::Rgba32f => None,
        Accumulate::Rgba16f => Some("rgba16f"),
        Accumulate::Rgba8 => Some("rgba8"),
    };
    if let Some(name) = accumulate {
        return refuse(
            &format!("image.accumulate (--accumulate {name})"),
            "holds colours, and has too few digits, or no sign, for the places and normals that surface.shows (--surface-shows) asks for",
            "use rgba32f, or show colours",
        );
    }
    if scene.polygons.show() {
        return refuse(
            "mesh",
            "has polygons, whose colours would be blended with the places or normals that surface.shows (--surface-shows) asks for",
            "leave the meshes out, or show colours",
        );
    }
    Ok(())
}

fn refuse(input: &str, problem: &str, remedy: &str) -> Result<()> {
    Err(Error::usage(input, problem, remedy))
}
