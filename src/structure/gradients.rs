//! The texture of gradients as the host makes it: the twin of `glsl/structure/gradients.comp`. Both do the same to each number of
//! single precision, in the same order, so that texels are the same to the bit.

use half::f16;
use rayon::prelude::*;

use super::cells::Values;
use crate::scene::Field;
use crate::scene::gradients::{CODES, GradientCoding, TIE, ZERO_CODE};
use crate::scene::settings::{GradientOperator, GradientTexture};

/// The texels, x fastest: along the gradient, and the value beside it.
pub fn texels(field: &Field, values: &Values, operator: GradientOperator, coding: &GradientCoding) -> Vec<u8> {
    match values {
        Values::Unorm8(codes) => of_voxels(field.dims(), operator, coding, |i| f32::from(codes[i])),
        Values::Unorm16(codes) => of_voxels(field.dims(), operator, coding, |i| f32::from(codes[i])),
        Values::Float(values) => of_voxels(field.dims(), operator, coding, |i| values[i] * coding.scale),
    }
}

fn of_voxels(
    dims: [usize; 3],
    operator: GradientOperator,
    coding: &GradientCoding,
    number: impl Fn(usize) -> f32 + Sync,
) -> Vec<u8> {
    let [nx, ny, nz] = dims;
    let voxels = Numbers { dims, number };
    let texel_bytes = coding.texture.bytes();
    let mut bytes = vec![0; nx * ny * nz * texel_bytes];
    bytes.par_chunks_mut(nx * texel_bytes).enumerate().for_each(|(row, bytes)| {
        for (x, texel) in bytes.chunks_exact_mut(texel_bytes).enumerate() {
            let at = [x, row % ny, row / ny];
            let gradient = std::array::from_fn(|axis| voxels.component(at, axis, operator, coding));
            let value = voxels.at(at.map(|c| c as isize)) * coding.beside[0] + coding.beside[1];
            encode(gradient, value, coding.texture, texel);
        }
    });
    bytes
}

/// Voxels by their places; beyond the outermost ones they repeat.
struct Numbers<N> {
    dims: [usize; 3],
    number: N,
}

impl<N: Fn(usize) -> f32> Numbers<N> {
    fn at(&self, place: [isize; 3]) -> f32 {
        let [x, y, z]: [usize; 3] =
            std::array::from_fn(|axis| place[axis].clamp(0, self.dims[axis] as isize - 1) as usize);
        (self.number)((z * self.dims[1] + y) * self.dims[0] + x)
    }

    /// The difference of the neighbours of a voxel along an axis.
    fn difference(&self, place: [isize; 3], axis: usize) -> f32 {
        let beside = |by: isize| {
            let mut there = place;
            there[axis] = place[axis].clamp(0, self.dims[axis] as isize - 1) + by;
            self.at(there)
        };
        beside(1) - beside(-1)
    }

    fn component(&self, at: [usize; 3], axis: usize, operator: GradientOperator, coding: &GradientCoding) -> f32 {
        let place = at.map(|c| c as isize);
        let difference = match operator {
            GradientOperator::Central => self.difference(place, axis),
            GradientOperator::Sobel => {
                let (second, third) = ((axis + 1) % 3, (axis + 2) % 3);
                let mut sum = 0.0;
                for b in -1..=1 {
                    for a in -1..=1 {
                        let mut there = place;
                        (there[second], there[third]) = (place[second] + a, place[third] + b);
                        sum += ((2 - a.abs()) * (2 - b.abs())) as f32 * self.difference(there, axis);
                    }
                }
                sum * (1.0 / 16.0)
            }
        };
        let inside = at[axis] > 0 && at[axis] + 1 < self.dims[axis];
        let way = if inside { 0.5 } else { 1.0 };
        (difference * way * coding.factors[axis]).clamp(-1.0, 1.0)
    }
}

fn encode(gradient: [f32; 3], value: f32, texture: GradientTexture, texel: &mut [u8]) {
    let [x, y, z] = gradient;
    match texture {
        GradientTexture::Rgba8 => {
            let [r, g, b] = gradient.map(|c| (c * CODES + (ZERO_CODE + 0.5 + TIE)).floor() as u8);
            texel.copy_from_slice(&[r, g, b, (value * 255.0 + (0.5 + TIE)).floor() as u8]);
        }
        GradientTexture::Rgba16f => {
            texel.copy_from_slice(bytemuck::bytes_of(&[x, y, z, value].map(|c| f16::from_f32(c).to_bits())));
        }
        GradientTexture::Rgba32f => texel.copy_from_slice(bytemuck::bytes_of(&[x, y, z, value])),
    }
}

/// Texels as shaders read them.
#[derive(Clone, Debug, PartialEq)]
pub struct GradientTexels {
    pub coding: GradientCoding,
    /// x fastest.
    pub texels: Vec<[f32; 4]>,
}

impl GradientTexels {
    pub fn new(field: &Field, values: &Values, operator: GradientOperator, coding: GradientCoding) -> Self {
        let bytes = texels(field, values, operator, &coding);
        let each = |size: usize, of: fn(&[u8]) -> f32| -> Vec<[f32; 4]> {
            let texel = |texel: &[u8]| std::array::from_fn(|c| of(&texel[c * size..(c + 1) * size]));
            bytes.par_chunks_exact(4 * size).map(texel).collect()
        };
        let texels = match coding.texture {
            GradientTexture::Rgba8 => each(1, |b| f32::from(b[0]) / 255.0),
            GradientTexture::Rgba16f => each(2, |b| f16::from_le_bytes([b[0], b[1]]).to_f32()),
            GradientTexture::Rgba32f => each(4, |b| f32::from_le_bytes([b[0], b[1], b[2], b[3]])),
        };
        Self { coding, texels }
    }
}
