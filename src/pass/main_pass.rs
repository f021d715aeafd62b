//! Main pass: ray traversal [KW03 §2.1, Thesis §5.2.2].

use super::{constants, cull};
use crate::feature;
use crate::geometry::BOX_FRONT;
use crate::part::access::Usage;
use crate::part::rows::{Context, Hook};
use crate::part::{Draw, Group, Step};
use crate::resource;
use crate::scene::settings::Cull;
use crate::twin;

/// Main pass `pass`, culled by `culled` = (how, greatest stored depth), or run for every fragment.
pub fn main_pass(context: &Context, pass: u32, culled: Option<(Cull, f32)>) -> Step {
    let mut accesses = vec![
        Usage::Vertices.of(resource::BOX),
        Usage::Sampled.of(resource::FRAME),
        Usage::Sampled.of(resource::ENTRY),
        Usage::Sampled.of(resource::DIRECTION),
        Usage::Sampled.of(resource::VOLUME),
        Usage::Color.of(resource::ACCUMULATED),
    ];
    accesses.extend(feature::reads(context, Hook::Ray));
    accesses.extend(feature::reads(context, Hook::Sample));
    let mut draw = Draw::plain(&BOX_FRONT, "main_pass.frag", twin::main_pass::main_pass);
    draw.define(feature::defines(context, Hook::Ray));
    draw.specialize(feature::constants(context, Hook::Ray));
    draw.define(feature::defines(context, Hook::Sample));
    draw.blend = context.projection().blend;
    draw.specialize([constants::samples(context.scene), constants::projection(context)]);
    draw.specialize(feature::constants(context, Hook::Sample));
    if let Some((how, bound)) = culled {
        cull::cull_by_stored(&mut draw, &mut accesses, how, bound);
    }
    Step::drawn(format!("main_pass #{pass}"), Group::Main, pass, accesses, draw)
}
