//! Intermediate pass of near-neighbor skipping [Thesis §5.3].

use super::resource::{Resource, Usage};
use super::{Draw, Faces, Group, Needs, Step, constants, cull};
use crate::reference;
use crate::reference::section::section_end;
use crate::scene::Scene;
use crate::scene::settings::Mark;

/// Runs before main pass `pass`, for rays whose stored section begins at or before it.
pub fn near_neighbor(scene: &Scene, needs: Needs, pass: u32, passes: u32, form: cull::Form) -> Step {
    let mut accesses = vec![
        Usage::Vertices.of(Resource::Box),
        Usage::Sampled.of(Resource::Frame),
        Usage::Sampled.of(Resource::Entry),
        Usage::Sampled.of(Resource::Direction),
    ];
    accesses.extend(needs.ends.then_some(Usage::Sampled.of(Resource::Accumulated)));
    accesses.extend(needs.skips.then_some(Usage::Sampled.of(Resource::NearestDistance)));
    // Before the first pass nothing is marked yet, and every ray takes part.
    let culled = pass > 0 || form.mark != Mark::Copy;
    let mut draw = Draw::plain(Faces::Front, "near_neighbor.frag", reference::near_neighbor::near_neighbor);
    draw.define(needs.defines());
    draw.specialize([constants::samples(scene), constants::depth_bits(scene)]);
    draw.specialize(constants::near_neighbor(scene));
    if culled {
        cull::cull_by_stored(&mut draw, &mut accesses, form.cull, section_end(pass, passes) as f32);
    }
    cull::mark_into(&mut draw, &mut accesses, form.mark, cull::rising(form.mark));
    Step::drawn(format!("near_neighbor #{pass}"), Group::Intermediate, pass, accesses, draw)
}
