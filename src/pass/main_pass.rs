//! Main pass: ray traversal [KW03 §2.1, Thesis §5.2.2].

use super::resource::{Resource, Usage};
use super::{Draw, Faces, Group, Needs, Step, constants, cull};
use crate::reference;
use crate::scene::Scene;
use crate::scene::settings::Cull;

/// Main pass `pass`, culled by `cull` = (how, greatest stored depth), or run for every fragment.
pub fn main_pass(scene: &Scene, needs: Needs, pass: u32, culled: Option<(Cull, f32)>) -> Step {
    let mut accesses = vec![
        Usage::Vertices.of(Resource::Box),
        Usage::Sampled.of(Resource::Frame),
        Usage::Sampled.of(Resource::Entry),
        Usage::Sampled.of(Resource::Direction),
        Usage::Sampled.of(Resource::Volume),
        Usage::Color.of(Resource::Accumulated),
    ];
    let (classified, by) = constants::classification(scene, needs);
    accesses.extend(classified);
    let mut draw = Draw::plain(Faces::Front, "main_pass.frag", reference::main_pass::main_pass);
    draw.define(by);
    draw.blend = true;
    draw.specialize([constants::samples(scene)]);
    draw.specialize(constants::segment(scene, needs));
    if let Some((how, bound)) = culled {
        cull::cull_by_stored(&mut draw, &mut accesses, how, bound);
    }
    Step::drawn(format!("main_pass #{pass}"), Group::Main, pass, accesses, draw)
}
