//! Intermediate pass of `rc-block`: stopping criterion and empty blocks [KW03 §2.3].

use ash::vk;

use super::resource::{Resource, Usage};
use super::{Draw, Faces, Group, Needs, Step, constants, cull};
use crate::reference;
use crate::scene::Scene;

/// Decides who takes part in main pass `pass`; runs for every fragment, since it writes depth.
pub fn block_skip(scene: &Scene, needs: Needs, pass: u32, form: cull::Form) -> Step {
    let mut accesses = vec![
        Usage::Vertices.of(Resource::Box),
        Usage::Sampled.of(Resource::Frame),
        Usage::Sampled.of(Resource::Entry),
        Usage::Sampled.of(Resource::Direction),
        Usage::Sampled.of(Resource::CellRange),
        Usage::Sampled.of(Resource::BlockTable),
    ];
    accesses.extend(needs.ends.then_some(Usage::Sampled.of(Resource::Accumulated)));
    let mut draw = Draw::plain(Faces::Front, "block_skip.frag", reference::block_skip::block_skip);
    draw.define((!needs.ends).then_some("ENDLESS"));
    draw.specialize([constants::samples(scene), constants::depth_bits(scene), constants::spans(scene)]);
    cull::mark_into(&mut draw, &mut accesses, form.mark, vk::CompareOp::ALWAYS);
    Step::drawn(format!("block_skip #{pass}"), Group::Intermediate, pass, accesses, draw)
}
