//! What a device makes of a plan: which builds run on it, and which on the host.

use ash::vk;

use crate::error::Result;
use crate::method;
use crate::part::form::Form;
use crate::part::rows::Traversal;
use crate::plan::{self, Choice, Plan};
use crate::resource::texels::texel_format;
use crate::resource::{gradient_bytes, largest_buffer, largest_shell_buffer};
use crate::scene::Scene;
use crate::scene::settings::{Builder, Filter};
use crate::scene::texture::{Coding, TextureChoice};
use crate::structure::Lookup;
use crate::vulkan::Device;

/// Plans the frame of a scene for a device; `lookup`: the distances to look up, where they are not the method's own.
///
/// # Errors
/// As [`plan::plan_for`].
pub fn plan_on(device: &Device, scene: &Scene, form: Option<Form>, lookup: Option<Lookup>) -> Result<Plan> {
    plan::check(scene)?;
    let method = method::of(scene.settings.method.name)?;
    let looked_up = lookup.or_else(|| method.distance().map(|distance| Lookup::new(scene, distance)));
    let shells = scene.shells.as_ref().filter(|_| method.traversal == Traversal::Shells);
    shells.map_or(Ok(()), |shells| shells.count(&scene.field))?;
    let on_host = builds_on_host(device, scene, looked_up) || shells.is_some() && builds_shells_on_host(device, scene);
    plan::plan_for(scene, Choice { form, on_host, lookup, most_texels: Some(device.info.max_texel_buffer) })
}

/// Whether the host builds distances, gradients and shells: where it is asked to, where the device has no room to, and on a device that is a
/// CPU, for which the host is the faster (`cargo bench --bench build`).
fn builds_on_host(device: &Device, scene: &Scene, lookup: Option<Lookup>) -> bool {
    let gradients = if scene.has_gradient_texture() { gradient_bytes(scene) } else { 0 };
    let largest = lookup.map_or(0, |lookup| largest_buffer(&scene.field, &lookup)).max(gradients);
    match scene.settings.method.build {
        Builder::Host => true,
        _ if largest > device.info.max_storage_buffer => true,
        Builder::Device => false,
        Builder::Auto => device.info.is_cpu(),
    }
}

/// Whether the host builds shells whatever is asked for: where the device has no room to, or cannot have the volume in a texture as it
/// is.
fn builds_shells_on_host(device: &Device, scene: &Scene) -> bool {
    let (info, texture) = (&device.info, TextureChoice::of(scene));
    let read = match scene.settings.sampling.filter {
        Filter::Hardware => vk::FormatFeatureFlags::SAMPLED_IMAGE_FILTER_LINEAR,
        Filter::Exact | Filter::Nearest => vk::FormatFeatureFlags::SAMPLED_IMAGE,
    };
    texture.kept == Coding::Spread
        || !device.format_supports(texel_format(texture.format), read)
        || scene.field.dims().iter().any(|side| *side > info.max_image_3d as usize)
        || largest_shell_buffer(scene) > info.max_storage_buffer
}
