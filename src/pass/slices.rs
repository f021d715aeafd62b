//! Slices of the volume [Thesis §3.4], those of a main pass or all of them.

use super::{constants, cull};
use crate::feature;
use crate::geometry::{SLICES, SLICES_CUT};
use crate::part::access::Usage;
use crate::part::rows::{Context, Hook};
use crate::part::{Draw, Group, Step};
use crate::resource;
use crate::scene::settings::{Cull, SliceCut};
use crate::twin;

/// The slices of main pass `pass`, culled by `culled` = (how, greatest stored depth), or run for every fragment.
pub fn slices(context: &Context, pass: u32, culled: Option<(Cull, f32)>) -> Step {
    let on_device = context.scene.settings.method.slice_cut == SliceCut::Device;
    let geometry = if on_device { &SLICES_CUT } else { &SLICES };
    let mut accesses = vec![Usage::Vertices.of(geometry.vertices)];
    accesses.extend(on_device.then(|| Usage::Placing.of(resource::SLICE_CUT)));
    accesses.extend([resource::FRAME, resource::SLICES].map(|resource| Usage::Sampled.of(resource)));
    accesses.extend(feature::values(context));
    accesses.push(Usage::Color.of(resource::ACCUMULATED));
    let mut draw = Draw::plain(geometry, "slices.frag", twin::slices::slices);
    draw.specialize([constants::projection(context), constants::slice_surface(context)]);
    if context.view.stack_axis().is_some() {
        draw.define(["STACK"]);
        draw.specialize([("BETWEEN", u32::from(context.scene.settings.method.between))]);
    }
    for hook in [Hook::Interval, Hook::Ray, Hook::RayEnd, Hook::Sample] {
        accesses.extend(feature::reads(context, hook));
        draw.define(feature::defines(context, hook));
        draw.specialize(feature::constants(context, hook));
    }
    draw.blend = context.blend();
    if let Some((how, bound)) = culled {
        cull::cull_by_stored(&mut draw, &mut accesses, how, bound);
    }
    let name = if context.method.back_to_front() { "slice_pass".to_owned() } else { format!("slice_pass #{pass}") };
    Step::drawn(name, Group::Main, pass, accesses, draw)
}
