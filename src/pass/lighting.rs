//! The lighting pass of iso-surfaces, once for all rays [Thesis ch. 5 §3.2].

use super::constants;
use crate::feature::{self, lights, surface};
use crate::geometry::ray_begins;
use crate::math::blend::Blend;
use crate::part::access::Usage;
use crate::part::rows::{Context, Hook};
use crate::part::{Draw, Group, Step, Work};
use crate::resource;
use crate::twin;

/// Puts the lit colours of surfaces under what is in front of them, or their places or normals.
pub fn lighting(context: &Context) -> Step {
    let mut accesses = vec![
        Usage::Vertices.of(resource::BOX),
        Usage::Sampled.of(resource::FRAME),
        Usage::Sampled.of(resource::ENTRY),
        Usage::Sampled.of(resource::DIRECTION),
        Usage::Sampled.of(resource::VOLUME),
        Usage::Sampled.of(resource::SURFACE_HIT),
        Usage::Sampled.of(resource::SURFACE_LEVELS),
    ];
    accesses.extend(surface::is_lit(context).then(|| Usage::Sampled.of(lights::lights(context))));
    accesses.extend(feature::reads(context, Hook::Light));
    accesses.push(Usage::Color.of(resource::ACCUMULATED));
    let mut draw = Draw::plain(ray_begins(context.view), "lighting.frag", twin::lighting::lighting);
    draw.blend = Blend::Over;
    draw.define(surface::shows(context));
    draw.define(feature::defines(context, Hook::Light));
    draw.specialize(feature::constants(context, Hook::Light));
    draw.specialize([constants::samples(context.scene)]);
    let sampling = feature::constants(context, Hook::Sample);
    draw.specialize(sampling.into_iter().filter(|(name, _)| SAMPLING.contains(name)));
    draw.specialize([surface::refine(context)]);
    Step::drawn("lighting".to_owned(), Group::Light, 0, accesses, draw)
}

/// The lighting pass of a surface whose polygons tell where rays meet it.
pub fn of_polygons(context: &Context) -> Step {
    let mut step = lighting(context);
    if let Work::Draw(draw) = &mut step.work {
        draw.twin = Some(twin::shells::lighting);
    }
    step
}

/// Of the constants of samples, those that say what a value is, and what lights are.
const SAMPLING: [&str; 3] = ["FILTER", "EXTRA_FETCHES", "WHITE_LIGHTS"];
