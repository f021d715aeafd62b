//! Iso-surfaces.

use crate::error::{Error, Result};
use crate::part::Constant;
use crate::part::resource::Resource;
use crate::part::rows::{Context, Feature, Hook, Why};
use crate::projection::{self, COMPOSITE};
use crate::resource;
use crate::scene::Scene;
use crate::scene::settings::{Accumulate, Filter, Find, Offset, Refine, Shows};

/// Iso-surfaces that rays look for in place of colours [KW03 §2.2, Thesis ch. 5 §3.2].
pub const ISO_SURFACE: Feature = Feature {
    of_cells: true,
    with: Some("SURFACE"),
    reads: |_| vec![resource::SURFACE_LEVELS],
    ..Feature::at(Hook::Sample, "iso-surface", |context| if is_drawn(context) { Ok(()) } else { Err(Why::Untold) })
};

/// Whether there are iso-surfaces, whatever they are drawn by.
pub fn is_drawn(context: &Context) -> bool {
    context.scene.surface.is_some() && context.passes > 0
}

/// Surfaces that let something through, so that rays go on behind them [Stegmaier05 §6].
pub const TRANSPARENT_SURFACES: Feature = Feature {
    with: Some("TRANSPARENT"),
    ..Feature::at(Hook::Sample, "transparent surfaces", |context| {
        match context.has(&ISO_SURFACE) && context.scene.sees_through_surfaces() {
            true => Ok(()),
            false => Err(Why::Untold),
        }
    })
};

/// Surfaces within the colours of the volume [Stegmaier05 §6].
pub const SURFACES_IN_VOLUME: Feature = Feature {
    of_cells: true,
    with: Some("IN_VOLUME"),
    ..Feature::at(Hook::Sample, "surfaces in the volume", |context| {
        match context.has(&ISO_SURFACE) && context.scene.surfaces_in_volume() {
            true => Ok(()),
            false => Err(Why::Untold),
        }
    })
};

/// What rays gather: colours, or places on a surface that is lit afterwards.
pub fn gathered(context: &Context) -> Resource {
    match context.scene.ends_at_surfaces() && context.has(&ISO_SURFACE) && !context.method.loops() {
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
    match () {
        // Those within cells have checks of their own (cells.rs).
        () if scene.tetrahedra.is_some() && row.name == COMPOSITE.name => Ok(()),
        () if row.name != COMPOSITE.name => {
            let input = format!("projection.kind (--projection {})", row.name);
            refuse(&input, "shows values, and a surface is where one is, not how large", "use composite with surfaces")
        }
        () if sampling.preintegrates() && !scene.surfaces_in_volume() => refuse(
            "sampling.classification (--classification pre-integrated)",
            "makes colours of the values between samples, and surfaces have one of their own",
            "use post with surfaces, or draw them with the volume (--surface-volume)",
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
        () if scene.sees_through_surfaces() => check_transparent(scene),
        () if settings.surface.shows != Shows::Color => check_numbers(scene),
        () => Ok(()),
    }
}

/// Whether transparent surfaces have a meaning with what else the scene asks for.
fn check_transparent(scene: &Scene) -> Result<()> {
    let surface = &scene.settings.surface;
    match () {
        () if surface.find == Find::Range => refuse(
            "surface.find (--find range)",
            "asks for places with a value in a range, and rays meet transparent surfaces where they cross their values",
            "use crossing, or opacity = 1",
        ),
        () if surface.shows != Shows::Color => refuse(
            "surface.shows (--surface-shows)",
            "asks for one place or normal a pixel, and rays go on behind transparent surfaces",
            "show colours, or give opacity = 1",
        ),
        () if !scene.polygons.clips().is_empty() => refuse(
            "clip.mesh",
            "cuts into transparent surfaces, and nothing tells where a ray that it lets in begins within one",
            "use planes, or opacity = 1",
        ),
        () => Ok(()),
    }
}

/// Whether a method ends its rays at the surfaces of a scene, as it does where they are opaque.
///
/// # Errors
/// When one of them is transparent, which asks for a shader that holds the whole ray.
pub fn check_opaque(scene: &Scene) -> Result<()> {
    match () {
        () if scene.surfaces_in_volume() => refuse(
            "surface.volume (--surface-volume)",
            "draws surfaces with the volume, and rays of several passes look for surfaces or gather colours, not both",
            "use --method single-pass, or leave it out",
        ),
        () if scene.sees_through_surfaces() => refuse(
            "surface.levels",
            "has a surface with an opacity below 1, and rays of several passes end at the first surface that they meet",
            "use --method single-pass, or opacity = 1",
        ),
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
