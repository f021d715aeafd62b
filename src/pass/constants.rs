//! Specialization constants that several passes set, by the shader header that declares them.

use super::Needs;
use super::resource::{Access, Resource, Usage};
use crate::scene::Scene;
use crate::scene::settings::{Alpha, Distance, Filter, Last};

/// A constant's name and the bits of its value.
pub type Constant = (&'static str, u32);

/// M, of `frame.glsl`.
pub fn samples(scene: &Scene) -> Constant {
    ("SAMPLES_PER_PASS", scene.settings.sampling.samples_per_pass)
}

/// Of `volume.glsl`, `transfer.glsl` and `segment.glsl`: what taking samples leaves out for this scene.
pub fn segment(scene: &Scene, needs: Needs) -> [Constant; 7] {
    let sampling = &scene.settings.sampling;
    // Axes go on beyond the first knot and the last.
    let pieces = scene.transfer.knots().len() as u32 + u32::from(sampling.spans());
    // A table has them for its step.
    let other_step = sampling.step != scene.transfer.reference && !sampling.spans();
    let corrected = sampling.alpha == Alpha::Exponential && (sampling.last == Last::Partial || other_step);
    [
        (
            "FILTER",
            match sampling.filter {
                Filter::Hardware => 0,
                Filter::Exact => 1,
                Filter::Nearest => 2,
            },
        ),
        ("PIECES", pieces),
        ("SEARCH", pieces.next_power_of_two() / 2),
        ("CORRECT_OPACITY", u32::from(corrected)),
        ("EXTRA_FETCHES", sampling.extra_fetches),
        ("GREY", u32::from(!needs.colors)),
        ("LAST_PARTIAL", u32::from(sampling.last == Last::Partial)),
    ]
}

/// Of `near_neighbor.glsl`: how distances are looked up.
pub fn near_neighbor(scene: &Scene) -> [Constant; 5] {
    let method = &scene.settings.method;
    [
        ("EXIT_LOOKAHEAD", u32::from(method.exit_lookahead)),
        ("CELL", method.cell),
        ("LOOKUPS", method.lookups),
        spans(scene),
        ("OCTANTS", u32::from(method.name.distance() == Some(Distance::Directional))),
    ]
}

/// Of `mark.glsl`: how marks that are copied are written.
pub fn depth_bits(scene: &Scene) -> Constant {
    ("DEPTH_BITS", scene.settings.method.depth.bits())
}

/// Of passes that look ahead: a sample stands for all values up to the next one.
pub fn spans(scene: &Scene) -> Constant {
    ("SPANS", u32::from(scene.settings.sampling.spans()))
}

/// What classifies samples: the resources, and the define of the shader that reads them.
pub fn classification(scene: &Scene, needs: Needs) -> (Vec<Access>, Option<&'static str>) {
    let transfer = if needs.colors { Resource::Transfer } else { Resource::GreyTransfer };
    let sampled = |resources: &[Resource]| resources.iter().map(|r| Usage::Sampled.of(*r)).collect();
    if scene.settings.sampling.spans() {
        return (sampled(&[Resource::Preintegrated, Resource::Axis]), Some("PREINTEGRATED"));
    }
    if scene.field.holes.is_some() {
        return (sampled(&[transfer, Resource::Holes]), Some("HOLES"));
    }
    (sampled(&[transfer]), None)
}
