//! Twin of `glsl/near_neighbor.frag`: the intermediate pass of near-neighbor skipping [Thesis §5.3].

use super::section::{passes_skipped, section_depth};
use super::{DEAD, Effect, Pixel, Twin};
use crate::structure::grid::octant_of;

/// Marks the section in which the ray next has work, or death.
///
/// # Panics
/// When the frame has no distances; the plan of every `nn-*` method has them.
pub fn near_neighbor(twin: &Twin, pixel: &mut Pixel, pass: u32) -> Effect {
    let distance = twin.distance.expect("near-neighbor skipping is planned with distances");
    let (sampling, method) = (&twin.scene.settings.sampling, &twin.scene.settings.method);
    let (first, end) = twin.segment(pixel, pass);
    if twin.saturated(pixel) || first >= end {
        pixel.stored = DEAD;
        return Effect::Silent;
    }
    let octant = octant_of(pixel.direction);
    let free = f64::from(twin.at_cell(pixel, first, |cell| distance.at(cell, octant)));
    let segment = f64::from(sampling.samples_per_pass) * sampling.step;
    let way = if free > 0.0 { free + sampling.step } else { 0.0 };
    let next = pass + passes_skipped(way, segment);
    let left = method.exit_lookahead && next * sampling.samples_per_pass >= twin.sample_count(pixel);
    pixel.stored = if left || next >= twin.passes { DEAD } else { section_depth(next, twin.passes) };
    Effect::Silent
}
