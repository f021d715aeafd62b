//! Polygons in the volume, and the depth layers they are peeled into [Thesis ch. 6].

use crate::error::{Error, Result};
use crate::part::resource::Resource;
use crate::part::rows::{Context, Feature, Hook, Why};
use crate::projection;
use crate::resource;
use crate::scene::Scene;

/// Transparent polygons, peeled layer by layer.
pub const DEPTH_LAYERS: Feature = Feature::of_frame("depth layers", |context| match context.layers {
    0 => Err("no transparent polygons".into()),
    _ => Ok(()),
});

/// The layer at which this part of each ray begins.
pub const LAYER_BEFORE: Feature = Feature {
    with: Some("LAYER_BEFORE"),
    reads: |context| vec![resource::LAYER.at(context.section as u16 - 1)],
    ..Feature::at(Hook::Ray, "begin at a layer", |context| told(context.section > 0))
};

/// The layer at which this part of each ray ends.
pub const LAYER_BEHIND: Feature = Feature {
    with: Some("LAYER_BEHIND"),
    reads: |context| vec![resource::LAYER.at(context.section as u16)],
    ..Feature::at(Hook::Ray, "end at a layer", |context| told(context.section < context.layers))
};

/// Opaque polygons, at which rays end.
pub const OPAQUE_SURFACE: Feature = Feature {
    with: Some("OPAQUE"),
    reads: |context| vec![opaque_layer(context)],
    ..Feature::at(Hook::Ray, "opaque surface", |context| match context.opaque {
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

/// Whether parts of rays are drawn one after the other, or end at polygons.
pub fn cut(context: &Context) -> bool {
    context.layers > 0 || context.opaque
}

/// Whether a scene's polygons can be drawn as it asks.
///
/// # Errors
/// When its projection has no colours to blend theirs with.
pub fn check(scene: &Scene) -> Result<()> {
    let row = projection::of(&scene.settings);
    if scene.polygons.is_empty() || !row.shows_values() {
        return Ok(());
    }
    let input = format!("projection.kind (--projection {})", row.name);
    Err(Error::usage(
        input,
        "shows values, which colours of polygons cannot be blended with",
        "use composite, or leave out [[mesh]]",
    ))
}
