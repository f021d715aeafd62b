//! Intermediate pass of near-neighbor skipping [Thesis §5.3].

use ash::vk;

use super::{constants, cull, rays};
use crate::feature::layers::first_section;
use crate::feature::surface::gathered;
use crate::feature::{self, APART, EARLY_ENDS, ISO_SURFACE};
use crate::geometry::segment_begins;
use crate::part::access::Usage;
use crate::part::form::Form;
use crate::part::rows::{Context, Hook};
use crate::part::{Draw, Group, Step};
use crate::resource;
use crate::scene::settings::Mark;
use crate::twin;
use crate::twin::section::section_end;

/// Runs before main pass `pass`, for rays whose stored section begins at or before it; where it is the first of its kind, before which
/// nothing is marked, for all of them.
pub fn near_neighbor(context: &Context, pass: u32, first: bool, form: Form) -> Step {
    let mut accesses = vec![Usage::Vertices.of(resource::BOX), Usage::Sampled.of(resource::FRAME)];
    // Behind a layer rays begin anew [Thesis ch. 6 §4].
    let anew = context.section > first_section(context) && first;
    let culled = !anew && (!first || form.mark != Mark::Copy);
    let twin = if anew { twin::near_neighbor::anew } else { twin::near_neighbor::near_neighbor };
    let mut draw = Draw::plain(segment_begins(context.view), "near_neighbor.frag", twin);
    rays::find(context, &mut draw, &mut accesses);
    accesses.extend(feature::reads(context, Hook::Ray));
    accesses.extend(feature::reads(context, Hook::RayEnd));
    accesses.extend(context.has(&EARLY_ENDS).then_some(Usage::Sampled.of(gathered(context))));
    accesses.extend(feature::reads(context, Hook::Decide));
    draw.define(feature::defines(context, Hook::Ray));
    draw.define(feature::defines(context, Hook::RayEnd));
    draw.specialize(feature::constants(context, Hook::Ray));
    draw.define(feature::defines(context, Hook::Decide));
    draw.define(ISO_SURFACE.define(context));
    draw.define(anew.then_some("BEGINS"));
    let scene = context.scene;
    draw.specialize([constants::samples(scene), constants::depth_bits(scene), constants::spans(scene)]);
    draw.specialize([constants::projection(context)]);
    draw.specialize(feature::constants(context, Hook::Decide));
    if context.has(&APART) {
        draw.specialize([("PARTIAL_AHEAD", u32::from(context.method.fused))]);
    }
    if culled {
        cull::cull_by_stored(&mut draw, &mut accesses, form.cull, section_end(pass, context.passes) as f32);
    }
    let compare = if anew { vk::CompareOp::ALWAYS } else { cull::rising(form.mark) };
    cull::mark_into(&mut draw, &mut accesses, form.mark, compare);
    Step::drawn(format!("near_neighbor #{pass}"), Group::Intermediate, pass, accesses, draw)
}
