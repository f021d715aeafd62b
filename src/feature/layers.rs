//! Polygons in the volume, the depth layers they are peeled into, and clip geometry [Thesis ch. 6].

use crate::error::{Error, Result};
use crate::part::Constant;
use crate::part::resource::Resource;
use crate::part::rows::{Context, Feature, Hook, Method, Why};
use crate::projection;
use crate::resource;
use crate::scene::Scene;
use crate::scene::mesh::{ClipMesh, Keep, Windings};

/// Transparent polygons and clip geometry, peeled layer by layer.
pub const DEPTH_LAYERS: Feature = Feature::of_frame("depth layers", |context| match context.layers {
    0 => Err("no transparent polygons".into()),
    _ => Ok(()),
});

/// Where the volume begins on each ray, by clip geometry: behind its first surface, or where the ray begins inside of it.
pub const CLIP_BEGIN: Feature = Feature::of_frame("begin of rays in clip geometry", |context| {
    let polygons = &context.scene.polygons;
    let outside = |clip: &ClipMesh| clip.rays_begin_outside(&context.view.rays, context.view.size);
    match polygons.clips() {
        [] => Err(Why::Untold),
        _ if polygons.cuts_in_front() || !context.plans() => Ok(()),
        clips if clips.iter().all(outside) => Err("every ray begins outside of it, and it is closed".into()),
        _ => Ok(()),
    }
});

/// The layer at which this part of each ray begins; in front of all layers the place where clip geometry lets it begin.
pub const LAYER_BEFORE: Feature = Feature {
    with: Some("LAYER_BEFORE"),
    reads: |context| match context.section.checked_sub(1) {
        Some(layer) => vec![resource::LAYER.at(layer as u16)],
        None => vec![clip_begin(context)],
    },
    ..Feature::at(Hook::Ray, "begin at a layer", |context| told(context.section > 0 || context.has(&CLIP_BEGIN)))
};

/// Parts of rays that are not drawn, since clip geometry does not keep them.
pub const CLIPPED: Feature = Feature {
    with: Some("CLIPPED"),
    ..Feature::at(Hook::Ray, "clipped parts of rays", |context| {
        told(!context.scene.polygons.clips().is_empty() && context.has(&LAYER_BEFORE))
    })
};

/// The layer at which this part of each ray ends.
pub const LAYER_BEHIND: Feature = Feature {
    with: Some("LAYER_BEHIND"),
    reads: |context| vec![resource::LAYER.at(context.section as u16)],
    ..Feature::at(Hook::RayEnd, "end at a layer", |context| told(context.section < context.layers))
};

/// Opaque polygons, at which rays end.
pub const OPAQUE_SURFACE: Feature = Feature {
    with: Some("OPAQUE"),
    reads: |context| vec![opaque_layer(context)],
    ..Feature::at(Hook::RayEnd, "opaque surface", |context| match context.opaque {
        true => Ok(()),
        false => Err("no opaque polygons".into()),
    })
};

/// Parts of frames that nobody would miss by name.
fn told(there: bool) -> std::result::Result<(), Why> {
    if there { Ok(()) } else { Err(Why::Untold) }
}

/// The image of opaque polygons: behind those of all layers.
pub fn opaque_layer(context: &Context) -> Resource {
    resource::LAYER.at(context.layers as u16)
}

/// The image of where clip geometry lets the volume begin: behind that of opaque polygons.
pub fn clip_begin(context: &Context) -> Resource {
    resource::LAYER.at(context.layers as u16 + 1)
}

/// The first part of rays that is drawn. Where each ray begins outside of what clip geometry keeps, it is that behind the first
/// layer.
pub fn first_section(context: &Context) -> u32 {
    let clips = context.scene.polygons.clips();
    u32::from(!context.has(&CLIP_BEGIN) && !Windings::default().kept_by(clips))
}

/// Whether parts of rays are drawn one after the other, or rays begin or end at polygons.
pub fn cut(context: &Context) -> bool {
    context.layers > 0 || context.opaque || context.has(&CLIP_BEGIN)
}

/// Of `clip.glsl`: how many clip meshes there are, and which of them keep what is inside.
pub fn clip_meshes(context: &Context) -> [Constant; 2] {
    let clips = context.scene.polygons.clips();
    let counted = if context.scene.polygons.cuts_in_front() { &[] } else { clips };
    let inside = |(i, clip): (usize, &ClipMesh)| u32::from(clip.keep == Keep::Inside) << i;
    [("CLIP_MESHES", counted.len() as u32), ("CLIP_INSIDE", counted.iter().enumerate().map(inside).sum())]
}

/// Whether a scene's polygons can be drawn as it asks.
///
/// # Errors
/// When its projection has no colours to blend theirs with, or no parts of rays.
pub fn check(scene: &Scene, method: &Method) -> Result<()> {
    let row = projection::of(&scene.settings);
    // Of shells each is brighter than the surfaces behind it, or is added to them.
    if scene.polygons.is_empty() || !row.shows_values() || !method.takes_samples() {
        return Ok(());
    }
    let input = format!("projection.kind (--projection {})", row.name);
    let problem = match scene.polygons.show() {
        true => "shows values, which colours of polygons cannot be blended with",
        false => "shows a value of the whole ray, of which clip geometry leaves parts",
    };
    Err(Error::usage(input, problem, "use composite, or leave out [[mesh]] and the tables [[clip]] with a mesh"))
}
