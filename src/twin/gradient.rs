//! Twin of `glsl/shared/gradient.glsl`: the gradient by central differences, or interpolated from a texture that has the value
//! beside it.

use glam::DVec3;

use super::samples::FACE_ROUNDING;
use super::segment::VALUE_ROUNDING;
use super::{Pixel, Twin};
use crate::math::interpolate::{bracket, mix, nearest, trilinear};
use crate::scene::gradients::{NO_GRADIENT, ZERO_CODE};
use crate::scene::settings::{Filter, GradientTexture};
use crate::structure::gradients::GradientTexels;

/// A number of a texel between voxels, and how far one that is found in f32 may be from it.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Channel {
    value: f64,
    off: f64,
}

impl Twin<'_> {
    /// A vector along the gradient at `voxel` (voxel space), in volume space, and how far each component may be off in f32.
    pub fn gradient_at(&self, voxel: DVec3) -> (DVec3, DVec3) {
        match self.gradients {
            Some(gradients) => self.interpolated_gradient(gradients, voxel),
            None => self.central_differences(voxel),
        }
    }

    /// Differences of x a voxel to each side over the way between the two, over the finest spacing.
    pub(super) fn central_differences(&self, voxel: DVec3) -> (DVec3, DVec3) {
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

    /// That of a texture, in parts of the steepest there may be or in codes.
    fn interpolated_gradient(&self, gradients: &GradientTexels, voxel: DVec3) -> (DVec3, DVec3) {
        let [x, y, z, _] = self.texel_at(gradients, voxel);
        let (gradient, off) = (DVec3::new(x.value, y.value, z.value), DVec3::new(x.off, y.off, z.off));
        if gradients.coding.texture != GradientTexture::Rgba8 {
            return (gradient, off);
        }
        let codes = 255.0 * gradient - f64::from(ZERO_CODE);
        let off = 255.0 * off;
        let (longest, most_off) = (codes.abs().max_element(), off.max_element());
        match longest {
            longest if longest + most_off < NO_GRADIENT => (DVec3::ZERO, DVec3::ZERO),
            // Some devices find none.
            longest if longest - most_off < NO_GRADIENT => (codes, DVec3::INFINITY),
            _ => (codes, off),
        }
    }

    /// The value beside the gradient at `voxel`, as x; undecided where f32 may see it on the other side of a jump.
    pub(super) fn value_beside(&self, gradients: &GradientTexels, pixel: &mut Pixel, voxel: DVec3) -> f64 {
        let [.., beside] = self.texel_at(gradients, voxel);
        let [times, plus] = gradients.coding.to_x;
        let x = times * beside.value + plus;
        let off = (times * beside.off).abs() + VALUE_ROUNDING * x.abs();
        pixel.undecided |= self.jumps_near(|jump| (x - jump).abs() < off);
        x
    }

    /// The texel at `voxel`, interpolated as values are.
    fn texel_at(&self, gradients: &GradientTexels, voxel: DVec3) -> [Channel; 4] {
        let dims = self.scene.field.dims();
        let texel = |x: usize, y: usize, z: usize| gradients.texels[(z * dims[1] + y) * dims[0] + x].map(f64::from);
        if self.scene.settings.sampling.filter == Filter::Nearest {
            let at = |voxel: DVec3| {
                let [x, y, z] = [0, 1, 2].map(|axis| voxel[axis].floor().clamp(0.0, dims[axis] as f64 - 1.0) as usize);
                texel(x, y, z)
            };
            let by = |n: usize, axis: usize| if n >> axis & 1 == 0 { -FACE_ROUNDING } else { FACE_ROUNDING };
            let beside = |n: usize| DVec3::from_array([0, 1, 2].map(|axis| by(n, axis)));
            let (found, others) = (at(voxel), (0..8).map(|n| at(voxel + beside(n))));
            let unsure =
                others.fold([false; 4], |unsure, other| std::array::from_fn(|c| unsure[c] || other[c] != found[c]));
            return std::array::from_fn(|c| Channel {
                value: found[c],
                off: if unsure[c] { f64::INFINITY } else { VALUE_ROUNDING * found[c].abs() },
            });
        }
        let [x, y, z] = [0, 1, 2].map(|axis| bracket(voxel[axis], dims[axis]));
        let corner = |n: usize| {
            let one =
                |axis: usize, (below, above, _): (usize, usize, f64)| if n >> axis & 1 == 0 { below } else { above };
            texel(one(0, x), one(1, y), one(2, z))
        };
        let corners: [[f64; 4]; 8] = std::array::from_fn(corner);
        std::array::from_fn(|c| {
            let along_x = |n: usize| mix(corners[n][c], corners[n + 1][c], x.2);
            let along_y = |n: usize| mix(along_x(n), along_x(n + 2), y.2);
            let value = mix(along_y(0), along_y(4), z.2);
            let all = || corners.iter().map(|corner| corner[c]);
            let spread = all().fold(f64::NEG_INFINITY, f64::max) - all().fold(f64::INFINITY, f64::min);
            let largest = all().fold(0.0, |largest: f64, value| largest.max(value.abs()));
            Channel { value, off: VALUE_ROUNDING * largest + self.place_rounding() * spread }
        })
    }
}
