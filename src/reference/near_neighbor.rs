//! Near-neighbor skipping [Thesis §5.3]: where along a ray there is work next, as in `glsl/shared/near_neighbor.glsl`,
//! and the twin of `glsl/near_neighbor.frag`.

use super::section::{passes_skipped, section_depth};
use super::{DEAD, Effect, Pixel, Twin};
use crate::structure::grid::octant_of;

impl Twin<'_> {
    /// The section in which a ray that arrives at `section` next has work; N, which is none, when it is gone.
    ///
    /// # Panics
    /// When the frame has no distances; the plan of every `nn-*` method has them.
    pub fn next_section(&self, pixel: &mut Pixel, section: u32) -> u32 {
        let distance = self.distance.expect("near-neighbor skipping is planned with distances");
        let (sampling, method) = (&self.scene.settings.sampling, &self.scene.settings.method);
        let (first, end) = self.segment(pixel, section);
        if first >= end {
            return self.passes;
        }
        let octant = octant_of(pixel.direction);
        let free = f64::from(self.at_cell(pixel, first, |cell| distance.at(cell, octant)));
        let segment = f64::from(sampling.samples_per_pass) * sampling.step;
        let way = if free > 0.0 { free + sampling.step } else { 0.0 };
        let next = section + passes_skipped(way, segment);
        let gone = method.exit_lookahead && next * sampling.samples_per_pass >= self.sample_count(pixel);
        if gone { self.passes } else { next.min(self.passes) }
    }

    /// The depth that says so.
    pub fn decision_depth(&self, next: u32) -> f64 {
        if next < self.passes { section_depth(next, self.passes) } else { DEAD }
    }
}

/// Marks the section in which the ray next has work, or death.
pub fn near_neighbor(twin: &Twin, pixel: &mut Pixel, pass: u32) -> Effect {
    let next = if twin.saturated(pixel) { twin.passes } else { twin.next_section(pixel, pass) };
    pixel.stored = twin.decision_depth(next);
    Effect::Silent
}
