//! Twin of `glsl/shared/adaptive.glsl`: steps as long as the importance volume allows (Weiler03 "Adaptive Sampling").

use super::{Effect, Pixel, Twin};
use crate::math::interpolate::trilinear;
use crate::truth::importance::Strides;

impl Twin<'_> {
    /// Joins up to `most` adaptive steps with what the pixel has already, until its ray needs no more of them where `ends`.
    pub(super) fn adaptive_steps(&self, pixel: &mut Pixel, most: Option<u32>, ends: bool) -> Effect {
        let (Some(importance), Some(medium)) = (self.importance, self.medium) else { return Effect::Silent };
        let lengths = self.scene.settings.step() / self.scene.transfer.reference;
        let steps = self.steps(pixel);
        let mut effect = Effect::Silent;
        let mut segment = [0.0; 4];
        let mut front = None;
        let mut taken = 0;
        let mut strides = Strides::new(&self.scene.settings.adaptive);
        while f64::from(pixel.reached) < steps && most.is_none_or(|most| taken < most) {
            if ends && self.saturated(pixel) {
                break;
            }
            let at = f64::from(pixel.reached);
            let begin = self.position_at(pixel, at);
            let (step, shows) = strides.next(|| self.at_cell_of(pixel, begin, |cell| importance.at(cell)));
            pixel.reached += step;
            taken += 1;
            if !shows {
                front = None;
                continue;
            }
            let end = f64::from(pixel.reached).min(steps);
            let from = front.unwrap_or_else(|| self.interpolated(pixel, at));
            let back = self.interpolated(pixel, end);
            let light = medium.ramp(from, back, (end - at) * lengths);
            if light[3] > 0.0 {
                effect = Effect::Contributed;
            }
            match ends {
                true => pixel.accumulated = self.projection.blend.apply(pixel.accumulated, light),
                false => segment = self.projection.blend.apply(segment, light),
            }
            front = Some(back);
        }
        if !ends {
            self.gather(pixel, segment);
        }
        effect
    }

    /// x so many of the shortest steps from the entry point.
    fn interpolated(&self, pixel: &Pixel, at: f64) -> f64 {
        let field = &self.scene.field;
        trilinear(&field.values, field.dims(), self.voxel(self.position_at(pixel, at)))
    }

    /// Whether the ray has come to where it leaves the volume.
    pub(super) fn has_left(&self, pixel: &Pixel) -> bool {
        f64::from(pixel.reached) >= self.steps(pixel)
    }
}
