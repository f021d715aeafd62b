//! Specialization constants that several passes set, by the shader header that declares them.

use crate::scene::Scene;
use crate::scene::settings::{Alpha, Distance, Filter, Last};

/// A constant's name and the bits of its value.
pub type Constant = (&'static str, u32);

/// M, of `frame.glsl`.
pub fn samples(scene: &Scene) -> Constant {
    ("SAMPLES_PER_PASS", scene.settings.sampling.samples_per_pass)
}

/// Of `volume.glsl`, `transfer.glsl` and `segment.glsl`: what taking samples leaves out for this scene.
pub fn segment(scene: &Scene) -> [Constant; 6] {
    let sampling = &scene.settings.sampling;
    let pieces = scene.transfer.knots().len() as u32;
    let corrected = sampling.alpha == Alpha::Exponential
        && (sampling.last == Last::Partial || sampling.step != scene.transfer.reference);
    [
        ("FILTER_EXACT", u32::from(sampling.filter == Filter::Exact)),
        ("PIECES", pieces),
        ("SEARCH", pieces.next_power_of_two() / 2),
        ("CORRECT_OPACITY", u32::from(corrected)),
        ("EXTRA_FETCHES", sampling.extra_fetches),
        ("LAST_PARTIAL", u32::from(sampling.last == Last::Partial)),
    ]
}

/// Of `near_neighbor.glsl`: how distances are looked up.
pub fn near_neighbor(scene: &Scene) -> [Constant; 4] {
    let method = &scene.settings.method;
    [
        ("EXIT_LOOKAHEAD", u32::from(method.exit_lookahead)),
        ("CELL", method.cell),
        ("LOOKUPS", method.lookups),
        ("OCTANTS", u32::from(method.name.distance() == Some(Distance::Directional))),
    ]
}
