//! A plane behind the volume [Stegmaier05 §4].

use crate::error::{Error, Result};
use crate::part::Constant;
use crate::part::rows::{Context, Feature, Hook, Why};
use crate::projection;
use crate::resource;
use crate::scene::backdrop::{Pattern, pixels_in_texel};
use crate::scene::settings::Shows;
use crate::scene::{Backdrop, Scene};

/// What is behind the volume, in every pixel of the view.
pub const BACKDROP: Feature = Feature {
    with: Some("BACKDROP"),
    constants: |context| context.scene.backdrop.as_ref().map_or_else(Vec::new, |one| constants(context.scene, one)),
    ..Feature::at(Hook::Sample, "background", |context| match context.scene.backdrop {
        Some(_) => Ok(()),
        None => Err(Why::Untold),
    })
};

/// A picture behind the volume, in place of a checker.
pub const BACKDROP_PICTURE: Feature = Feature {
    with: Some("BACKDROP_PICTURE"),
    reads: |_| vec![resource::BACKDROP],
    ..Feature::at(Hook::Sample, "picture behind the volume", |context| match picture(context) {
        true => Ok(()),
        false => Err(Why::Untold),
    })
};

fn picture(context: &Context) -> bool {
    context.scene.backdrop.as_ref().is_some_and(|one| matches!(one.pattern, Pattern::Picture(_)))
}

/// Of `backdrop.glsl`.
pub fn constants(scene: &Scene, backdrop: &Backdrop) -> Vec<Constant> {
    let view = scene.settings.image.size;
    let [width, height] = view.map(f64::from);
    let pattern = match &backdrop.pattern {
        Pattern::Checker(squares) => ("SQUARES", *squares),
        Pattern::Picture(picture) => ("PIXELS_IN_TEXEL", pixels_in_texel(picture, view)),
    };
    let all = [("BEHIND", backdrop.distance), ("VIEW_WIDTH", width), ("VIEW_HEIGHT", height), pattern];
    all.into_iter().map(|(name, value)| (name, (value as f32).to_bits())).collect()
}

/// Whether something behind the volume has a meaning with what else the scene asks for.
///
/// # Errors
/// When it has none.
pub fn check(scene: &Scene) -> Result<()> {
    if scene.backdrop.is_none() {
        return Ok(());
    }
    let row = projection::of(&scene.settings);
    let refuse = |input: &str, problem: &str, remedy: &str| Err(Error::usage(input, problem, remedy));
    let kind = format!("projection.kind (--projection {})", row.name);
    match () {
        () if row.shows_values() => refuse(
            &kind,
            "makes opaque pictures of values, which nothing is seen behind",
            "use composite, or leave the background out",
        ),
        () if scene.surface.is_some() && scene.settings.surface.shows != Shows::Color => refuse(
            "surface.shows (--surface-shows)",
            "shows places or normals of surfaces, which the colours of a background would be mixed with",
            "show colours, or leave the background out",
        ),
        () if scene.polygons.show() || !scene.polygons.clips().is_empty() => refuse(
            "mesh",
            "has polygons, which are blended under the volume where its rays leave off, and effects.background (--behind) fills that",
            "leave out the meshes, or the background",
        ),
        () => Ok(()),
    }
}
