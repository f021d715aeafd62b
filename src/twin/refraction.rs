//! Twin of `glsl/shared/refraction.glsl`: rays that bend where the index of refraction changes [Stegmaier05 §6].

use glam::DVec3;

use super::lighting::LOOSE;
use super::samples::PLACE_ROUNDING;
use super::{Effect, Pixel, Twin};
use crate::math::interpolate::trilinear;
use crate::scene::RefractiveIndex;

/// What f32 may take at each bend from a direction, relative, and from a place, in voxels.
const BEND_ROUNDING: f64 = 2.5e-7;

/// How many times the difference between a ray and two others is stated as its rounding. In f32 a ray bends by values, gradients and
/// places that are rounded, and every later bend magnifies what was lost; the two others lose so much at each bend, in opposite ways,
/// and tell how much that becomes.
const MARGIN: f64 = 4.0;

/// How a ray loses digits: by which sign.
#[derive(Clone, Copy)]
struct Loss(f64);

impl Loss {
    const NONE: Self = Self(0.0);

    fn of_place(self) -> DVec3 {
        DVec3::new(1.0, -1.0, 1.0) * (self.0 * BEND_ROUNDING)
    }

    fn of_direction(self) -> DVec3 {
        DVec3::ONE + DVec3::new(1.0, -1.0, -1.0) * (self.0 * BEND_ROUNDING)
    }
}

/// A ray where it leaves the volume.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LeavingRay {
    /// Where it does, volume space.
    pub point: DVec3,
    /// A vector of length 1.
    pub direction: DVec3,
}

impl Twin<'_> {
    /// Joins all samples of a ray that bends with what the pixel has, and what is behind the volume.
    pub(super) fn bending_ray(&self, pixel: &mut Pixel, index: &RefractiveIndex) -> Effect {
        let before = pixel.clone();
        let effect = self.follow(pixel, index, Loss::NONE);
        for sign in [1.0, -1.0] {
            let mut other = before.clone();
            self.follow(&mut other, index, Loss(sign));
            let apart = |c: usize| (other.accumulated[c] - pixel.accumulated[c]).abs();
            let off = MARGIN * (0..4).map(apart).fold(0.0, f64::max);
            pixel.rounding += off;
            pixel.undecided |= off > LOOSE || other.bent != pixel.bent;
        }
        let end = self.position_at(pixel, self.steps(pixel));
        let leaves = LeavingRay { point: (end - 0.5) * self.scene.field.extent(), direction: pixel.direction };
        pixel.leaves = pixel.bent.then_some(leaves);
        effect
    }

    fn follow(&self, pixel: &mut Pixel, index: &RefractiveIndex, loss: Loss) -> Effect {
        let begin = self.voxel(pixel.entry);
        let field = &self.scene.field;
        pixel.momentum = index.at(trilinear(&field.values, field.dims(), begin)) * pixel.direction;
        let mut effect = Effect::Silent;
        let mut i = 0;
        while i < self.sample_count(pixel) && !self.saturated(pixel) {
            self.bend(pixel, i, index, loss);
            let sample = self.sample(pixel, i);
            if sample[3] > 0.0 {
                effect = Effect::Contributed;
            }
            pixel.accumulated = self.projection.blend.apply(pixel.accumulated, sample);
            i += 1;
        }
        self.show_backdrop(pixel);
        effect
    }

    /// Bends the ray at sample `i`, by what the index changes around it.
    fn bend(&self, pixel: &mut Pixel, i: u32, index: &RefractiveIndex, loss: Loss) {
        let (field, sampling) = (&self.scene.field, &self.scene.settings.sampling);
        let voxel = self.voxel(self.sample_position(pixel, i));
        if self.in_hole(voxel) {
            return;
        }
        let value = trilinear(&field.values, field.dims(), voxel);
        // It may be on the other side of a point of the index.
        let off = loss.0 * self.value_rounding(value, voxel, PLACE_ROUNDING * f64::from(i));
        let slope = index.piece_at(value + off).slope;
        if slope == 0.0 {
            return;
        }
        let steps = self.steps_to(i);
        let around = (steps + 0.5).min(self.steps(pixel)) - (steps - 0.5).max(0.0);
        let (gradient, _) = self.central_differences(voxel);
        let momentum = pixel.momentum + around * sampling.step * slope * gradient;
        if momentum == pixel.momentum || momentum == DVec3::ZERO {
            return;
        }
        pixel.momentum = momentum * loss.of_direction();
        pixel.direction = pixel.momentum.normalize();
        pixel.entry = (voxel + loss.of_place()) / DVec3::from_array(field.dims().map(|n| n as f64));
        (pixel.anchor, pixel.bent) = (steps, true);
        let point = (pixel.entry - 0.5) * field.extent();
        let left = self.scene.way_out(point, pixel.direction, f64::INFINITY).max(0.0);
        let longest = self.scene.longest_way().max(pixel.anchor);
        pixel.length = (left + pixel.anchor * self.step_length()).min(longest * self.step_length());
    }
}
