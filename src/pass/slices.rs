//! Slices of the volume [Thesis §3.4], those of a main pass or all of them.

use super::{constants, cull};
use crate::feature;
use crate::geometry::SLICES;
use crate::math::blend::Blend;
use crate::part::access::Usage;
use crate::part::rows::{Context, Hook};
use crate::part::{Constant, Draw, Group, Step};
use crate::resource;
use crate::scene::settings::Cull;
use crate::scene::slices::SliceSurface;
use crate::twin;

/// The slices of main pass `pass`, culled by `culled` = (how, greatest stored depth), or run for every fragment.
pub fn slices(context: &Context, pass: u32, culled: Option<(Cull, f32)>) -> Step {
    let mut accesses = vec![
        Usage::Vertices.of(resource::SLICE_CORNERS),
        Usage::Sampled.of(resource::FRAME),
        Usage::Sampled.of(resource::SLICES),
    ];
    accesses.extend(feature::values(context));
    accesses.push(Usage::Color.of(resource::ACCUMULATED));
    let mut draw = Draw::plain(&SLICES, "slices.frag", twin::slices::slices);
    draw.specialize([constants::projection(context), surface(context)]);
    if context.view.stack_axis().is_some() {
        draw.define(["STACK"]);
        draw.specialize([("BETWEEN", u32::from(context.scene.settings.method.between))]);
    }
    for hook in [Hook::Interval, Hook::Ray, Hook::RayEnd, Hook::Sample] {
        accesses.extend(feature::reads(context, hook));
        draw.define(feature::defines(context, hook));
        draw.specialize(feature::constants(context, hook));
    }
    draw.blend = blend(context);
    if let Some((how, bound)) = culled {
        cull::cull_by_stored(&mut draw, &mut accesses, how, bound);
    }
    let name = if context.method.back_to_front() { "slice_pass".to_owned() } else { format!("slice_pass #{pass}") };
    Step::drawn(name, Group::Main, pass, accesses, draw)
}

/// How a sample, or a layer, goes into what is drawn already.
pub fn blend(context: &Context) -> Blend {
    match context.projection().blend {
        Blend::Over if context.method.back_to_front() => Blend::InFront,
        blend => blend,
    }
}

/// Of `slices.glsl`: on which surfaces slices lie.
pub fn surface(context: &Context) -> Constant {
    let code = match context.view.slices.as_ref().map(|slices| slices.surface) {
        Some(SliceSurface::Axis(axis)) => axis as u32,
        Some(SliceSurface::Depth) | None => 3,
        Some(SliceSurface::Distance) => 4,
    };
    ("SLICE_SURFACE", code)
}
