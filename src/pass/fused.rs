//! Main pass of the fused forms of near-neighbor skipping: it samples and marks where the ray goes on [Thesis §5.7].

use super::{constants, cull};
use crate::feature::surface::gathered;
use crate::feature::{self, DISTANCES, EARLY_ENDS};
use crate::geometry::segment_begins;
use crate::part::access::Usage;
use crate::part::form::Form;
use crate::part::rows::{Context, Hook};
use crate::part::{Draw, Group, Step};
use crate::resource;
use crate::twin;
use crate::twin::section::section_end;

/// Main pass `pass`, for rays whose stored section begins at or before it. The last one has nothing left to decide and marks
/// nothing, unless rays go on behind a layer: those that do not are dead there.
pub fn fused(context: &Context, pass: u32, form: Form) -> Step {
    let mut accesses = vec![
        Usage::Vertices.of(resource::BOX),
        Usage::Sampled.of(resource::FRAME),
        Usage::Sampled.of(resource::ENTRY),
        Usage::Sampled.of(resource::DIRECTION),
    ];
    accesses.extend(feature::values(context));
    accesses.extend(feature::reads(context, Hook::Ray));
    accesses.extend(feature::reads(context, Hook::RayEnd));
    if context.has(&DISTANCES) {
        accesses.push(Usage::Sampled.of(resource::NEAREST_DISTANCE));
    }
    // Its own opacity is read where a ray may end.
    let drawn = if context.has(&EARLY_ENDS) { Usage::ColorInput } else { Usage::Color };
    accesses.push(drawn.of(gathered(context)));
    accesses.extend(feature::reads(context, Hook::Sample));
    let mut draw = Draw::plain(segment_begins(context.view), "fused.frag", twin::fused::fused);
    draw.define(feature::defines(context, Hook::Ray));
    draw.define(feature::defines(context, Hook::RayEnd));
    draw.specialize(feature::constants(context, Hook::Ray));
    draw.define(feature::defines(context, Hook::Sample));
    draw.define(feature::defines(context, Hook::Decide));
    draw.blend = context.projection().blend;
    let scene = context.scene;
    draw.specialize([constants::samples(scene), constants::depth_bits(scene), constants::spans(scene)]);
    draw.specialize(feature::constants(context, Hook::Sample));
    draw.specialize(feature::constants(context, Hook::Decide));
    let rounding = twin::fused::rounding_of_gathered(scene);
    draw.specialize([("BLEND_ROUNDING", rounding.to_bits()), constants::projection(context)]);
    cull::cull_by_stored(&mut draw, &mut accesses, form.cull, section_end(pass, context.passes) as f32);
    if pass + 1 < context.passes || context.section < context.layers {
        cull::mark_into(&mut draw, &mut accesses, form.mark, cull::rising(form.mark));
    } else {
        draw.define(["MARK_NONE"]);
    }
    Step::drawn(format!("fused #{pass}"), Group::Main, pass, accesses, draw)
}
