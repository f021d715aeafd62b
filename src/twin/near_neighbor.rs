//! Near-neighbor skipping [Thesis §5.3]: where along a ray there is work next, as in `glsl/shared/near_neighbor.glsl`,
//! and the twin of `glsl/near_neighbor.frag`.

use super::section::{free_samples, partial_depth, section_depth};
use super::{DEAD, Effect, Pixel, Twin};
use crate::structure::blocks::BLOCK;
use crate::structure::grid::{FAR, octant_of};

/// What f32 may take from a way or add to it, relative: a product, a sum and a quotient. Less than what makes up for the
/// quotient of a whole number.
const WAY_ROUNDING: f64 = 1.0 / (1 << 22) as f64;

/// As in `glsl/shared/visible_block.glsl`, in steps.
const BOUNDARY: f64 = 1e-3;

impl Twin<'_> {
    /// The section in which a ray that arrives at `section` next has work; N, which is none, when it is gone.
    pub fn next_section(&self, pixel: &mut Pixel, section: u32) -> u32 {
        let (sampling, method) = (&self.scene.settings.sampling, &self.scene.settings.method);
        let (first, samples) = self.samples_of_part(pixel);
        let m = sampling.samples_per_pass;
        let mut i = (section * m).max(first);
        let end = ((i / m + 1) * m).min(samples);
        if i >= end {
            return self.passes;
        }
        let gone = |i: u32| method.exit_lookahead && i >= samples;
        let next = |i: u32| if gone(i) { self.passes } else { (i / sampling.samples_per_pass).min(self.passes) };
        let mut looked = 0;
        while looked < method.lookups && i < end {
            looked += 1;
            let ray = pixel.clone();
            // Where it is the section alone that matters, f32 may be on another sample.
            let matters = |i: u32| if looked == method.lookups { next(i) } else { i };
            let ([free, _], [least, most]) = self.at_cell(pixel, i, |cell| {
                let free = self.free_from(&ray, i, cell);
                (free, free.map(|free| matters(i + free)))
            });
            pixel.undecided |= least != most;
            if free == 0 {
                break;
            }
            i += free;
        }
        next(i)
    }

    /// Samples from `i` on that show nothing by what the loop of a single pass leaps with; 0 where it takes the sample.
    pub(super) fn free_samples_from(&self, pixel: &Pixel, i: u32) -> u32 {
        let cell = self.scene.field.cell_at(self.voxel(self.sample_position(pixel, i)));
        match self.blocks {
            None => self.free_from(pixel, i, cell)[0],
            Some(blocks) if blocks.visible(cell) => 0,
            Some(_) => {
                let [least, _] = self.steps_inside(pixel, i, cell, BLOCK);
                let others = (least - BOUNDARY).floor().max(0.0).min(f64::from(self.sample_count(pixel))) as u32;
                // What lies between the last of them and the next sample need not be free.
                others + u32::from(!self.scene.spans())
            }
        }
    }

    /// Samples from `i` on, which lies in `cell`, that show nothing: the least and the most that f32 may find.
    fn free_from(&self, pixel: &Pixel, i: u32, cell: [usize; 3]) -> [u32; 2] {
        // Where every cell is interesting no distances are planned.
        let Some(distance) = self.distance else { return [0; 2] };
        let Some(bound) = distance.free(cell, octant_of(pixel.direction)) else { return [0; 2] };
        let [least, most] = self.steps_inside(pixel, i, cell, distance.grid.cell);
        let step = self.scene.settings.sampling.step;
        let stride = step * self.stride_of(pixel);
        // What lies between the last free sample and the next one need not be free.
        let not_free = u32::from(self.scene.spans());
        [(least, 1.0 - WAY_ROUNDING), (most, 1.0 + WAY_ROUNDING)].map(|(steps, rounded)| {
            let inside = (steps * step).min(f64::from(FAR));
            free_samples((inside + f64::from(bound)) * rounded, stride) - not_free
        })
    }

    /// The depth that says so. Where it is that of a segment that ends at a surface and is drawn apart, it is so `ahead` of it too.
    pub fn decision_depth(&self, pixel: &Pixel, next: u32, ahead: bool) -> f64 {
        match () {
            () if next >= self.passes => DEAD,
            () if ahead && self.only_partial(pixel, next).is_some() => partial_depth(pixel.section),
            () => section_depth(next, self.passes),
        }
    }
}

/// Marks the section in which the ray next has work, or death.
pub fn near_neighbor(twin: &Twin, pixel: &mut Pixel, pass: u32) -> Effect {
    let next = if twin.saturated(pixel) { twin.passes } else { twin.next_section(pixel, pass) };
    pixel.stored = twin.decision_depth(pixel, next, twin.fused || next == pass);
    Effect::Silent
}

/// Marks rays before the first pass behind a layer: one that has no such part keeps its mark.
pub fn anew(twin: &Twin, pixel: &mut Pixel, pass: u32) -> Effect {
    let before = pixel.section.checked_sub(1).and_then(|layer| pixel.layers.get(layer as usize));
    if before.is_some_and(|surface| surface.kept) { near_neighbor(twin, pixel, pass) } else { Effect::Discarded }
}
