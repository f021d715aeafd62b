//! Intermediate pass of `rc-block`: stopping criterion and empty blocks [KW03 §2.3].

use ash::vk;

use super::{constants, cull, rays};
use crate::feature::surface::gathered;
use crate::feature::{self, APART, EARLY_ENDS, ISO_SURFACE};
use crate::geometry::segment_begins;
use crate::part::access::Usage;
use crate::part::form::Form;
use crate::part::rows::{Context, Hook};
use crate::part::{Draw, Group, Step};
use crate::resource;
use crate::twin;

/// Decides who takes part in main pass `pass`; runs for every fragment, since it writes depth.
pub fn block_skip(context: &Context, pass: u32, form: Form) -> Step {
    let mut accesses = vec![Usage::Vertices.of(resource::BOX), Usage::Sampled.of(resource::FRAME)];
    let mut draw = Draw::plain(segment_begins(context.view), "block_skip.frag", twin::block_skip::block_skip);
    rays::find(context, &mut draw, &mut accesses);
    accesses.extend(feature::reads(context, Hook::Ray));
    accesses.extend(feature::reads(context, Hook::RayEnd));
    accesses.extend(feature::reads(context, Hook::Decide));
    accesses.extend(context.has(&EARLY_ENDS).then_some(Usage::Sampled.of(gathered(context))));
    draw.define(feature::defines(context, Hook::Ray));
    draw.define(feature::defines(context, Hook::RayEnd));
    draw.specialize(feature::constants(context, Hook::Ray));
    draw.define(EARLY_ENDS.define(context));
    draw.define(APART.define(context));
    draw.define(ISO_SURFACE.define(context));
    let scene = context.scene;
    draw.specialize([constants::samples(scene), constants::depth_bits(scene), constants::spans(scene)]);
    draw.specialize([constants::projection(context)]);
    draw.specialize(feature::constants(context, Hook::Decide));
    cull::mark_into(&mut draw, &mut accesses, form.mark, vk::CompareOp::ALWAYS);
    Step::drawn(format!("block_skip #{pass}"), Group::Intermediate, pass, accesses, draw)
}
