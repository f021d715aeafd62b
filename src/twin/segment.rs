//! Twin of `glsl/shared/shade.glsl` and `glsl/shared/segment.glsl`: M samples of a ray, front to back [KW03 §2.1].

use glam::DVec3;

use super::lighting::LOOSE;
use super::samples::FACE_ROUNDING;
use super::{Effect, Pixel, Twin};
use crate::math::interpolate::{nearest, trilinear};
use crate::math::opacity::corrected_opacity;
use crate::projection::{Ends, OfValues, SampleWeight};
use crate::scene::Light;
use crate::scene::settings::{Alpha, Filter, Last};
use crate::truth::preintegrated::{PreintegratedTable, part_of};

/// Three interpolations of values about 1 round to a few units of 2^-24.
pub(super) const VALUE_ROUNDING: f64 = 3e-7;

impl Twin<'_> {
    /// Premultiplied colour of sample `i`.
    fn shade_sample(&self, pixel: &mut Pixel, i: u32) -> [f64; 4] {
        let steps = self.extent_of_sample(pixel, i);
        self.shade_steps(pixel, i, steps)
    }

    /// Premultiplied colour of sample `i`, that stands for so many steps.
    pub(super) fn shade_steps(&self, pixel: &mut Pixel, i: u32, steps: f64) -> [f64; 4] {
        let (transfer, sampling) = (&self.scene.transfer, &self.scene.settings.sampling);
        let voxel = self.voxel(self.sample_position(pixel, i));
        if self.in_hole(voxel) {
            return [0.0; 4];
        }
        // Beside surfaces, gradients are for these alone.
        let value = match self.gradients.filter(|_| self.scene.surface.is_none()) {
            Some(gradients) => self.value_beside(gradients, pixel, voxel),
            None => self.value(pixel, voxel),
        };
        let [r, g, b, a] = transfer.evaluate(value);
        let (lit, rounding) = if a > 0.0 { self.lit_sample(pixel, i, [r, g, b]) } else { ([r, g, b], 0.0) };
        let [r, g, b] = lit;
        let alpha = match sampling.alpha {
            Alpha::Exponential => corrected_opacity(a, steps * sampling.step / transfer.reference),
            Alpha::Paper => (a * steps).min(1.0),
        };
        pixel.rounding += rounding * alpha;
        pixel.undecided |= pixel.rounding > LOOSE;
        [r * alpha, g * alpha, b * alpha, alpha]
    }

    /// The colour of sample `i` in the lights of the scene, where it has some, and how far f32 may be from it.
    fn lit_sample(&self, pixel: &Pixel, i: u32, color: [f64; 3]) -> ([f64; 3], f64) {
        // Lights shine on surfaces, where there are some.
        if self.lights.is_empty() || self.scene.surface.is_some() {
            return (color, 0.0);
        }
        let shaded = self.shaded(pixel, self.steps_to(i), color, self.lights);
        let parts = |light: &Light| (0..3).map(|c| color[c] * light.diffuse[c] + light.specular[c]).fold(0.0, f64::max);
        let all: f64 = self.lights.iter().map(parts).sum();
        (shaded.color, if shaded.turns { all } else { shaded.rounding.min(all) })
    }

    /// Whether `voxel` lies in a cell that has no values.
    pub(super) fn in_hole(&self, voxel: DVec3) -> bool {
        let field = &self.scene.field;
        let ([nx, ny, _], [x, y, z]) = (field.cells(), field.cell_at(voxel));
        field.holes.as_ref().is_some_and(|holes| holes[(z * ny + y) * nx + x])
    }

    /// What a segment holds before its first sample.
    pub(super) fn no_sample(&self) -> [f64; 4] {
        let values = self.projection.values.as_ref();
        values.map_or([0.0; 4], |values| self.projection.grey((values.nothing)(&self.levels)))
    }

    /// What sample `i` brings to its ray, where values are shown.
    fn value_sample(&self, values: &OfValues, pixel: &mut Pixel, i: u32) -> [f64; 4] {
        let sampling = &self.scene.settings.sampling;
        let all = match sampling.last {
            Last::Partial => self.steps(pixel),
            Last::Full | Last::None => f64::from(self.sample_count(pixel)),
        };
        let lengths = sampling.step / self.scene.transfer.reference;
        self.value_with(values, pixel, i, &SampleWeight { steps: self.extent_of_sample(pixel, i), all, lengths })
    }

    /// What sample `i` brings to its ray with that weight, where values are shown.
    pub(super) fn value_with(&self, values: &OfValues, pixel: &mut Pixel, i: u32, weight: &SampleWeight) -> [f64; 4] {
        let voxel = self.voxel(self.sample_position(pixel, i));
        if self.in_hole(voxel) {
            return self.no_sample();
        }
        let value = self.value(pixel, voxel);
        self.projection.grey((values.part)(value, &self.levels, weight))
    }

    /// Steps that sample `i` stands for.
    fn extent_of_sample(&self, pixel: &Pixel, i: u32) -> f64 {
        let last = i + 1 == self.sample_count(pixel);
        let ([begin, end], step_end) = (self.part(pixel), if last { self.steps(pixel) } else { f64::from(i + 1) });
        match self.scene.settings.sampling.last {
            Last::Partial => step_end.min(end) - f64::from(i).max(begin),
            Last::Full | Last::None => 1.0,
        }
    }

    /// The scalar at `voxel`; undecided where f32 may see it on the other side of a jump.
    pub(super) fn value(&self, pixel: &mut Pixel, voxel: DVec3) -> f64 {
        let field = &self.scene.field;
        if self.scene.settings.sampling.filter == Filter::Nearest {
            return self.nearest_value(pixel, voxel);
        }
        let value = trilinear(&field.values, field.dims(), voxel);
        pixel.undecided |= self.jumps_near(|x| self.may_cross(x, value, voxel));
        value
    }

    /// Whether `near` holds for any value at which what is made of values, or whether a ray ends, changes at once.
    pub(super) fn jumps_near(&self, near: impl Fn(f64) -> bool) -> bool {
        match (self.projection.values.is_some(), self.projection.ends) {
            (false, _) => self.scene.transfer.jumps().any(near),
            (true, Ends::Reached) => near(self.levels.end),
            (true, _) => false,
        }
    }

    /// Whether f32 may take another voxel as the nearest, whose value is another one; places are off by `more` voxels besides.
    pub(super) fn nearest_undecided(&self, voxel: DVec3, value: f64, more: f64) -> bool {
        let field = &self.scene.field;
        let reach = FACE_ROUNDING + more;
        let beside = |n: usize| {
            let by = |axis: usize| if n >> axis & 1 == 0 { -reach } else { reach };
            voxel + DVec3::new(by(0), by(1), by(2))
        };
        (0..8).any(|n| nearest(&field.values, field.dims(), beside(n)) != value)
    }

    /// The value of the voxel nearest to `voxel`; undecided where f32 may take another, or see it on the other side of a
    /// jump.
    fn nearest_value(&self, pixel: &mut Pixel, voxel: DVec3) -> f64 {
        let field = &self.scene.field;
        let value = nearest(&field.values, field.dims(), voxel);
        pixel.undecided |= self.nearest_undecided(voxel, value, 0.0);
        let near = |x: f64| (value - x).abs() < VALUE_ROUNDING * value.abs();
        pixel.undecided |= self.jumps_near(near);
        value
    }

    /// Premultiplied colour of sample `i`, which stands for all values up to that of the next one or of the exit point.
    fn shade_span(&self, table: &PreintegratedTable, pixel: &mut Pixel, i: u32) -> [f64; 4] {
        let [front, back] = self.span(pixel, i).map(|steps| {
            let voxel = self.voxel(self.position_at(pixel, steps));
            table.node(self.value(pixel, voxel))
        });
        part_of(table.between(front, back), self.extent_of_sample(pixel, i), self.scene.settings.sampling.alpha)
    }

    /// Premultiplied colour of a part of the step after sample `i`, so many steps long, on which values go from the one to the other.
    pub(super) fn shade_part(&self, pixel: &mut Pixel, i: u32, steps: f64, values: [f64; 2]) -> [f64; 4] {
        match self.table {
            None => self.shade_steps(pixel, i, steps),
            Some(table) => {
                let [front, back] = values.map(|value| table.node(value));
                part_of(table.between(front, back), steps, self.scene.settings.sampling.alpha)
            }
        }
    }

    /// Whether f32 may have a `value` interpolated at `voxel` on the other side of a `jump`.
    fn may_cross(&self, jump: f64, value: f64, voxel: DVec3) -> bool {
        (value - jump).abs() < self.value_rounding(value, voxel, 0.0)
    }

    /// How far f32 may be from a `value` interpolated at `voxel`, where places are off by `more` voxels besides.
    pub(super) fn value_rounding(&self, value: f64, voxel: DVec3, more: f64) -> f64 {
        let field = &self.scene.field;
        let corners = field.corners(field.cell_at(voxel)).map(|c| f64::from(field.values[c]));
        let spread =
            corners.into_iter().fold(f64::NEG_INFINITY, f64::max) - corners.into_iter().fold(f64::INFINITY, f64::min);
        VALUE_ROUNDING * value.abs() + (self.place_rounding() + more) * spread
    }

    /// What sample `i` brings to its ray, whatever is shown.
    pub(super) fn sample(&self, pixel: &mut Pixel, i: u32) -> [f64; 4] {
        let sample = match (&self.projection.values, self.table) {
            (Some(values), _) => self.value_sample(values, pixel, i),
            (None, Some(table)) => self.shade_span(table, pixel, i),
            (None, None) => self.shade_sample(pixel, i),
        };
        // Of what shows nothing nobody can tell whether it is clipped.
        let shows = sample != self.no_sample();
        if shows && !self.is_kept(pixel, self.steps_to(i)) { self.no_sample() } else { sample }
    }

    /// What the ray's segment for main pass `pass` brings to the pixel, and whether it took a sample that shows.
    pub fn segment_color(&self, pixel: &mut Pixel, pass: u32) -> ([f64; 4], Effect) {
        if self.scene.surface.is_some() {
            return self.surface_segment(pixel, pass);
        }
        let (first, end) = self.segment(pixel, pass);
        let mut segment = self.no_sample();
        let mut effect = Effect::Silent;
        for i in first..end {
            let sample = self.sample(pixel, i);
            if !self.projection.shows_values() && sample[3] > 0.0 {
                effect = Effect::Contributed;
            }
            segment = self.projection.blend.apply(segment, sample);
        }
        let changes = || self.projection.blend.apply(pixel.accumulated, segment) != pixel.accumulated;
        if self.projection.shows_values() && changes() {
            effect = Effect::Contributed;
        }
        (segment, effect)
    }
}
