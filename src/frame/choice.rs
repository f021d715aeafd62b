//! What a device makes of a plan: which builds run on it, and which on the host.

use crate::error::Result;
use crate::method;
use crate::part::form::Form;
use crate::part::rows::Traversal;
use crate::plan::{self, Choice, Plan};
use crate::resource::{gradient_bytes, largest_buffer, largest_shell_buffer};
use crate::scene::Scene;
use crate::scene::settings::Builder;
use crate::scene::texture::{Coding, TextureChoice};
use crate::structure::Lookup;
use crate::vulkan::Device;

/// Plans the frame of a scene for a device; `lookup`: the distances to look up, where they are not the method's own.
///
/// # Errors
/// As [`plan::plan_for`].
pub fn plan_on(device: &Device, scene: &Scene, form: Option<Form>, lookup: Option<Lookup>) -> Result<Plan> {
    let method = method::of(scene.settings.method.name)?;
    let looked_up = lookup.or_else(|| method.distance().map(|distance| Lookup::new(scene, distance)));
    let shells = method.traversal == Traversal::Shells;
    let on_host = builds_on_host(device, scene, looked_up) || shells && builds_shells_on_host(device, scene);
    plan::plan_for(scene, Choice { form, on_host, lookup })
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

/// Whether the host builds shells whatever is asked for: where the device has no room to, or its texture holds values that are rounded.
fn builds_shells_on_host(device: &Device, scene: &Scene) -> bool {
    TextureChoice::of(scene).kept == Coding::Spread || largest_shell_buffer(scene) > device.info.max_storage_buffer
}
