//! Rays in single floats, where these are good enough for what samples are made of.

use super::layers;
use crate::part::rows::{Context, Feature, Hook, Why};
use crate::resource;
use crate::scene::settings::Filter;
use crate::scene::single_rays::ENOUGH;
use crate::scene::texture::TextureChoice;

/// Rays that are found in single floats, not in double-floats.
pub const SINGLE_RAYS: Feature = Feature {
    with: Some("SINGLE_RAYS"),
    reads: |_| vec![resource::SINGLE_RAYS],
    ..Feature::at(Hook::Interval, "rays in single floats", needed)
};

fn needed(context: &Context) -> Result<(), Why> {
    let (scene, method) = (context.scene, context.method);
    let along_rays = method.on_device && method.takes_samples() && method.stack().is_none();
    let whole = !layers::cut(context) && scene.clip_planes().is_empty() && scene.clip_volume.is_none();
    // What surfaces, lights and rays that bend make of a difference has no bound.
    let bounded = scene.surface.is_none() && scene.lights.is_empty() && scene.settings.effects.refraction.is_none();
    if !along_rays || !whole || !bounded {
        return Err(Why::Untold);
    }
    // Shaders that interpolate keep places to 2^-22 voxels, which a single float of a place in the whole volume does not tell.
    if scene.settings.sampling.filter != Filter::Hardware {
        return Err(Why::Untold);
    }
    let error = context.view.single_rays(scene).error;
    let off = error * scene.field.dims().into_iter().max().unwrap_or(1) as f64;
    if off > ENOUGH {
        return Err(format!("they may be {off:.1e} voxels off in this view, where {ENOUGH:.1e} is enough").into());
    }
    let (x, precision) = (TextureChoice::of(scene).error, scene.settings.volume.precision);
    if x <= precision && x + scene.error_of_places(error) > precision {
        return Err("with them x would not be as precise as asked for".into());
    }
    Ok(())
}
