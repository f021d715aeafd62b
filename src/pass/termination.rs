//! Intermediate pass of `rc-ert`: the stopping criterion [KW03 §2.1].

use ash::vk;

use super::{constants, cull, rays};
use crate::feature::surface::gathered;
use crate::feature::{self, ADAPTIVE, APART, EARLY_ENDS, ISO_SURFACE};
use crate::geometry::segment_begins;
use crate::part::access::Usage;
use crate::part::form::Form;
use crate::part::rows::{Context, Hook};
use crate::part::{Draw, Group, Step};
use crate::resource;
use crate::scene::settings::Mark;
use crate::twin;

/// Decides who takes part in main pass `pass`; runs for every fragment, since it writes depth.
pub fn termination(context: &Context, pass: u32, form: Form) -> Step {
    let mut accesses = vec![Usage::Vertices.of(resource::BOX), Usage::Sampled.of(resource::FRAME)];
    let mut draw = Draw::plain(segment_begins(context.view), "termination.frag", twin::termination::termination);
    rays::find(context, &mut draw, &mut accesses);
    accesses.extend(context.has(&EARLY_ENDS).then_some(Usage::Sampled.of(gathered(context))));
    accesses.extend(context.has(&ADAPTIVE).then_some(Usage::Sampled.of(resource::REACHED)));
    accesses.extend(feature::reads(context, Hook::Ray));
    accesses.extend(feature::reads(context, Hook::RayEnd));
    draw.define(feature::defines(context, Hook::Ray));
    draw.define(feature::defines(context, Hook::RayEnd));
    draw.specialize(feature::constants(context, Hook::Ray));
    draw.define(EARLY_ENDS.define(context));
    draw.define(ADAPTIVE.define(context));
    draw.define(APART.define(context));
    draw.define(ISO_SURFACE.define(context));
    draw.specialize((APART.constants)(context));
    let scene = context.scene;
    draw.specialize([constants::samples(scene), constants::depth_bits(scene), constants::projection(context)]);
    if context.has(&ADAPTIVE) && form.mark != Mark::Copy {
        // The reason stands in the shader.
        accesses.push(Usage::Color.of(resource::REACHED.at(1)));
        draw.define(["BESIDE"]);
    }
    cull::mark_into(&mut draw, &mut accesses, form.mark, vk::CompareOp::ALWAYS);
    Step::drawn(format!("termination #{pass}"), Group::Intermediate, pass, accesses, draw)
}
