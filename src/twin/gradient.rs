//! Twin of `glsl/shared/gradient.glsl`: the gradient by central differences.

use glam::DVec3;

use super::Twin;
use crate::math::interpolate::{nearest, trilinear};
use crate::scene::settings::Filter;

impl Twin<'_> {
    /// A vector along the gradient at `voxel` (voxel space), in volume space: differences of x a voxel to each side over the way
    /// between the two, over the finest spacing; and how far each component may be off in f32.
    pub fn gradient_at(&self, voxel: DVec3) -> (DVec3, DVec3) {
        let field = &self.scene.field;
        let value = |voxel: DVec3| match self.scene.settings.sampling.filter {
            Filter::Nearest => nearest(&field.values, field.dims(), voxel),
            Filter::Hardware | Filter::Exact => trilinear(&field.values, field.dims(), voxel),
        };
        let (mut gradient, mut rounding) = (DVec3::ZERO, DVec3::ZERO);
        for axis in 0..3 {
            let last = field.dims()[axis] as f64 - 0.5;
            let beside = |by: f64| {
                let mut there = voxel;
                there[axis] = (voxel[axis] + by).clamp(0.5, last);
                there
            };
            let (up, down) = (beside(1.0), beside(-1.0));
            let way = up[axis] - down[axis];
            if way > 0.0 {
                let scale = field.finest() / field.voxel()[axis] / way;
                let (high, low) = (value(up), value(down));
                gradient[axis] = (high - low) * scale;
                rounding[axis] = (self.value_rounding(high, up, 0.0) + self.value_rounding(low, down, 0.0)) * scale;
            }
        }
        (gradient, rounding)
    }
}
