//! Main pass of the fused forms of near-neighbor skipping: it samples and marks where the ray goes on [Thesis §5.7].

use super::cull::{self, Form};
use super::resource::{Resource, Usage};
use super::{Draw, Faces, Group, Needs, Step, constants};
use crate::reference;
use crate::reference::section::section_end;
use crate::scene::Scene;

/// Main pass `pass` of `passes`, for rays whose stored section begins at or before it. The last one has nothing left to
/// decide and marks nothing.
pub fn fused(scene: &Scene, needs: Needs, pass: u32, passes: u32, form: Form) -> Step {
    let mut accesses = vec![
        Usage::Vertices.of(Resource::Box),
        Usage::Sampled.of(Resource::Frame),
        Usage::Sampled.of(Resource::Entry),
        Usage::Sampled.of(Resource::Direction),
        Usage::Sampled.of(Resource::Volume),
    ];
    if needs.skips {
        accesses.push(Usage::Sampled.of(Resource::NearestDistance));
    }
    // Its own opacity is read where a ray may end.
    let drawn = if needs.ends { Usage::ColorInput } else { Usage::Color };
    accesses.push(drawn.of(Resource::Accumulated));
    let (classified, by) = constants::classification(scene, needs);
    accesses.extend(classified);
    let mut draw = Draw::plain(Faces::Front, "fused.frag", reference::fused::fused);
    draw.define(needs.defines().chain(by));
    draw.blend = true;
    draw.specialize([constants::samples(scene), constants::depth_bits(scene)]);
    draw.specialize(constants::segment(scene, needs));
    draw.specialize(constants::near_neighbor(scene));
    let rounding = reference::fused::blend_rounding(scene.settings.image.accumulate);
    draw.specialize([("BLEND_ROUNDING", rounding.to_bits())]);
    cull::cull_by_stored(&mut draw, &mut accesses, form.cull, section_end(pass, passes) as f32);
    if pass + 1 < passes {
        cull::mark_into(&mut draw, &mut accesses, form.mark, cull::rising(form.mark));
    } else {
        draw.define(["MARK_NONE"]);
    }
    Step::drawn(format!("fused #{pass}"), Group::Main, pass, accesses, draw)
}
