//! Intermediate pass of near-neighbor skipping [Thesis §5.3].

use ash::vk;

use super::resource::{Resource, Usage};
use super::{Draw, Faces, Group, Step, Work, cull};
use crate::reference;
use crate::reference::section::section_end;
use crate::scene::Scene;
use crate::scene::settings::{Cull, Distance, Mark};

/// Runs before main pass `pass`, for rays whose stored section begins at or before it.
pub fn near_neighbor(scene: &Scene, pass: u32, passes: u32, form: cull::Form) -> Step {
    let mut accesses = vec![
        Usage::Vertices.of(Resource::Box),
        Usage::Sampled.of(Resource::Frame),
        Usage::Sampled.of(Resource::Entry),
        Usage::Sampled.of(Resource::Direction),
        Usage::Sampled.of(Resource::Accumulated),
        Usage::Sampled.of(Resource::NearestDistance),
    ];
    // Before the first pass nothing is marked yet, and every ray takes part.
    let culled = pass > 0 || form.mark != Mark::Copy;
    let variant = match form.mark {
        Mark::Copy if culled && form.cull == Cull::Discard => "copy+discard",
        _ => form.mark_variant(),
    };
    let shader = format!("near_neighbor.frag:{variant}");
    let mut draw = Draw::plain(Faces::Front, &shader, reference::near_neighbor::near_neighbor);
    draw.constants = vec![
        ("SAMPLES_PER_PASS", scene.settings.sampling.samples_per_pass),
        ("EXIT_LOOKAHEAD", u32::from(scene.settings.method.exit_lookahead)),
        ("CELL", scene.settings.method.cell),
        ("OCTANTS", u32::from(scene.settings.method.name.distance() == Some(Distance::Directional))),
    ];
    if culled {
        cull::cull_by_stored(&mut draw, &mut accesses, form.cull, section_end(pass, passes) as f32);
    }
    let compare = match form.mark {
        Mark::FragdepthAny => vk::CompareOp::GREATER,
        _ => vk::CompareOp::GREATER_OR_EQUAL,
    };
    cull::mark_into(&mut draw, &mut accesses, form.mark, compare);
    Step { name: format!("near_neighbor #{pass}"), group: Group::Intermediate, pass, accesses, work: Work::Draw(draw) }
}
