//! Twin of `glsl/shared/surface.glsl` and of what `glsl/shared/segment.glsl` does with SURFACE: where a ray meets an iso-surface
//! first [KW03 §2.2, Thesis ch. 5 §3.2].

use super::{Effect, Pixel, Twin};
use crate::math::blend::Blend;
use crate::math::interpolate::{nearest, trilinear};
use crate::projection::on_surface;
use crate::scene::settings::Filter;

impl Twin<'_> {
    /// What a ray has gathered, of which it depends whether it goes on.
    pub fn gathered(&self, pixel: &Pixel) -> [f64; 4] {
        if self.scene.ends_at_surfaces() { pixel.hit } else { pixel.accumulated }
    }

    /// Joins a segment with what the ray has gathered.
    pub fn gather(&self, pixel: &mut Pixel, segment: [f64; 4]) {
        match self.scene.ends_at_surfaces() {
            true => pixel.hit = Blend::Over.apply(pixel.hit, segment),
            false => pixel.accumulated = self.projection.blend.apply(pixel.accumulated, segment),
        }
    }

    /// Where the segment of main pass `pass` is on a surface first, as the shader writes it, and whether it is the first of its ray.
    pub(super) fn surface_segment(&self, pixel: &mut Pixel, pass: u32) -> ([f64; 4], Effect) {
        let (first, end) = self.segment(pixel, pass);
        self.surface_between(pixel, first, end)
    }

    /// Where the steps after the samples from `first` to one before `end` are on a surface first, as [`Twin::surface_segment`] has it.
    pub(super) fn surface_between(&self, pixel: &mut Pixel, first: u32, end: u32) -> ([f64; 4], Effect) {
        let met = |[front, back]: [f64; 2]| {
            let stretch = [front, back].map(|steps| f64::from(steps as f32));
            [stretch[0], stretch[1], 0.0, 1.0]
        };
        let begins = first < end && first == self.samples_of_part(pixel).0;
        let begin = begins.then(|| self.stretch_after(pixel, first)[0]);
        let mut hit = None;
        if let Some(begin) = begin.filter(|begin| self.is_kept(pixel, *begin) && self.is_on_surface(pixel, *begin)) {
            hit = Some([begin, begin]);
        }
        for i in first..end {
            if hit.is_some() {
                break;
            }
            let stretch = self.stretch_after(pixel, i);
            hit = self.hit_in_step(pixel, stretch);
        }
        match hit {
            Some(stretch) if pixel.hit[3] == 0.0 => (met(stretch), Effect::Contributed),
            Some(stretch) => (met(stretch), Effect::Silent),
            None => ([0.0; 4], Effect::Silent),
        }
    }

    /// The part of the step after sample `i` that is on the part of the ray that is drawn, in steps.
    pub(super) fn stretch_after(&self, pixel: &Pixel, i: u32) -> [f64; 2] {
        let [begin, end] = self.part(pixel);
        let last = i + 1 == self.sample_count(pixel);
        let to = if last { self.steps(pixel) } else { f64::from(i + 1) };
        [begin.max(f64::from(i)), end.min(to)]
    }

    /// Whether the ray is on a surface `steps` from the entry point; undecided where f32 may find another thing there.
    pub(super) fn is_on_surface(&self, pixel: &mut Pixel, steps: f64) -> bool {
        let sample = self.value_at(pixel, steps);
        pixel.undecided |= self.near_surface(sample);
        on_surface(self.surface_values, sample.value).is_some()
    }

    /// Whether a value is so near to one at which a surface begins or ends that f32 may find it beyond.
    pub(super) fn near_surface(&self, sample: RoundedValue) -> bool {
        self.surface_values.iter().flatten().any(|bound| (sample.value - bound).abs() < sample.rounding)
    }

    /// The value `steps` from the entry point, and how far f32 may be off.
    pub(super) fn value_at(&self, pixel: &Pixel, steps: f64) -> RoundedValue {
        let voxel = self.voxel(self.position_at(pixel, steps));
        // A place between samples is that of a surface, or of the exit point.
        let place = if steps.fract() == 0.0 { 0.0 } else { self.cut_rounding(pixel) };
        let field = &self.scene.field;
        if self.scene.settings.sampling.filter == Filter::Nearest {
            let value = nearest(&field.values, field.dims(), voxel);
            let unsure = self.nearest_undecided(voxel, value, place);
            return RoundedValue {
                value,
                rounding: if unsure { f64::INFINITY } else { self.value_rounding(value, voxel, 0.0) },
            };
        }
        let value = trilinear(&field.values, field.dims(), voxel);
        RoundedValue { value, rounding: self.value_rounding(value, voxel, place) }
    }
}

/// A value and how far one that is found in f32 may be from it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoundedValue {
    pub value: f64,
    pub rounding: f64,
}
