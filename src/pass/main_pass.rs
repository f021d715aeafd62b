//! Main pass: ray traversal [KW03 §2.1, Thesis §5.2.2].

use super::resource::{Resource, Usage};
use super::{Draw, Faces, Group, Step, Work, cull};
use crate::reference;
use crate::scene::Scene;
use crate::scene::settings::{Alpha, Cull, Filter, Last};

/// Main pass `pass`, culled by `cull` = (how, greatest stored depth), or run for every fragment.
pub fn main_pass(scene: &Scene, pass: u32, culled: Option<(Cull, f32)>) -> Step {
    let mut accesses = vec![
        Usage::Vertices.of(Resource::Box),
        Usage::Sampled.of(Resource::Frame),
        Usage::Sampled.of(Resource::Entry),
        Usage::Sampled.of(Resource::Direction),
        Usage::Sampled.of(Resource::Volume),
        Usage::Sampled.of(Resource::Transfer),
        Usage::Color.of(Resource::Accumulated),
    ];
    let discard = matches!(culled, Some((Cull::Discard, _)));
    if scene.field.holes.is_some() {
        accesses.push(Usage::Sampled.of(Resource::Holes));
    }
    let variant = match (discard, scene.field.holes.is_some()) {
        (false, false) => "plain",
        (false, true) => "holes",
        (true, false) => "discard",
        (true, true) => "discard+holes",
    };
    let mut draw = Draw::plain(Faces::Front, &format!("main_pass.frag:{variant}"), reference::main_pass::main_pass);
    draw.blend = true;
    draw.constants = constants(scene);
    if let Some((how, bound)) = culled {
        cull::cull_by_stored(&mut draw, &mut accesses, how, bound);
    }
    Step { name: format!("main_pass #{pass}"), group: Group::Main, pass, accesses, work: Work::Draw(draw) }
}

/// What the shader leaves out for this scene.
fn constants(scene: &Scene) -> Vec<(&'static str, u32)> {
    let sampling = &scene.settings.sampling;
    let pieces = scene.transfer.knots().len() as u32;
    let corrected = sampling.alpha == Alpha::Exponential
        && (sampling.last == Last::Partial || sampling.step != scene.transfer.reference);
    vec![
        ("SAMPLES_PER_PASS", sampling.samples_per_pass),
        ("FILTER_EXACT", u32::from(sampling.filter == Filter::Exact)),
        ("PIECES", pieces),
        ("SEARCH", pieces.next_power_of_two() / 2),
        ("CORRECT_OPACITY", u32::from(corrected)),
        ("LAST_PARTIAL", u32::from(sampling.last == Last::Partial)),
    ]
}
