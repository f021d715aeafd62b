//! Main pass: ray traversal [KW03 §2.1, Thesis §5.2.2].

use super::{constants, cull};
use crate::feature::surface::gathered;
use crate::feature::{self, ADAPTIVE, APART};
use crate::geometry::segment_begins;
use crate::part::access::{Access, Usage};
use crate::part::form::Form;
use crate::part::rows::{Context, Hook};
use crate::part::{Draw, Group, Step};
use crate::resource;
use crate::scene::settings::Cull;
use crate::twin;

/// Main pass `pass`, culled by `culled` = (how, greatest stored depth), or run for every fragment.
pub fn main_pass(context: &Context, pass: u32, culled: Option<(Cull, f32)>) -> Step {
    let (mut draw, mut accesses) = sampled(context, !context.has(&APART));
    if context.has(&ADAPTIVE) {
        // No ray has come anywhere before the first of them.
        accesses.push(if pass > 0 { Usage::ColorInput } else { Usage::Color }.of(resource::REACHED));
        draw.define((pass > 0).then_some("GOES_ON"));
    }
    if let Some((how, bound)) = culled {
        cull::cull_by_stored(&mut draw, &mut accesses, how, bound);
    }
    Step::drawn(format!("main_pass #{pass}"), Group::Main, pass, accesses, draw)
}

/// The main pass of all segments that end at a surface, behind the others [Thesis ch. 6 §7].
pub fn partial_pass(context: &Context, form: Form) -> Step {
    let (mut draw, mut accesses) = sampled(context, true);
    draw.define(["PARTIAL"]);
    draw.twin = Some(twin::main_pass::partial_pass);
    cull::cull_by_partial(&mut draw, &mut accesses, form.cull, context.section);
    Step::drawn("partial_pass".to_owned(), Group::Main, context.passes, accesses, draw)
}

/// What takes samples; whether it knows where surfaces end the ray.
fn sampled(context: &Context, ends: bool) -> (Draw, Vec<Access>) {
    let mut accesses = vec![
        Usage::Vertices.of(resource::BOX),
        Usage::Sampled.of(resource::FRAME),
        Usage::Sampled.of(resource::ENTRY),
        Usage::Sampled.of(resource::DIRECTION),
    ];
    accesses.extend(feature::values(context));
    accesses.push(Usage::Color.of(gathered(context)));
    let mut draw = Draw::plain(segment_begins(context.view), "main_pass.frag", twin::main_pass::main_pass);
    draw.specialize([constants::samples(context.scene), constants::projection(context)]);
    let hooks = [Some(Hook::Ray), ends.then_some(Hook::RayEnd), Some(Hook::Sample)];
    for hook in hooks.into_iter().flatten() {
        accesses.extend(feature::reads(context, hook));
        draw.define(feature::defines(context, hook));
        draw.specialize(feature::constants(context, hook));
    }
    draw.blend = context.projection().blend;
    (draw, accesses)
}
