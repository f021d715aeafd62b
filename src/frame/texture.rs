//! How a volume is kept on the device: the texture's format, its texels, and where the scalar range lies in it.

use ash::vk;
use rayon::prelude::*;

use crate::scene::settings::VolumeTexture;
use crate::scene::volume::Voxels;
use crate::scene::{Field, TransferFunction};

/// Texels of a volume, and the map from x (0..1 over the scalar range) to the texture's own value:
/// `texture = scale * x + offset`.
#[derive(Clone, Debug)]
pub struct Texels {
    pub format: vk::Format,
    pub bytes: Vec<u8>,
    pub scale: f64,
    pub offset: f64,
}

impl Texels {
    pub fn new(field: &Field, texture: VolumeTexture) -> Self {
        match (texture, &field.volume.voxels) {
            (VolumeTexture::Native, Voxels::U8(v)) => Self::unorm(field, vk::Format::R8_UNORM, v.clone(), 0.0, 255.0),
            (VolumeTexture::Native, Voxels::I8(v)) => {
                let bytes = v.iter().map(|&i| i.wrapping_sub(i8::MIN) as u8).collect();
                Self::unorm(field, vk::Format::R8_UNORM, bytes, -128.0, 255.0)
            }
            (VolumeTexture::Native, Voxels::U16(v)) => {
                Self::unorm(field, vk::Format::R16_UNORM, bytemuck::cast_slice(v).to_vec(), 0.0, 65535.0)
            }
            (VolumeTexture::Native, Voxels::I16(v)) => {
                let words: Vec<u16> = v.iter().map(|&i| i.wrapping_sub(i16::MIN) as u16).collect();
                Self::unorm(field, vk::Format::R16_UNORM, bytemuck::cast_slice(&words).to_vec(), -32768.0, 65535.0)
            }
            (VolumeTexture::R16, _) => Self::quantised(field),
            (VolumeTexture::Native | VolumeTexture::R32f, _) => Self {
                format: vk::Format::R32_SFLOAT,
                bytes: bytemuck::cast_slice(&field.values).to_vec(),
                scale: 1.0,
                offset: 0.0,
            },
        }
    }

    /// Integers as stored: the texture's value is (voxel - lowest) / span.
    fn unorm(field: &Field, format: vk::Format, bytes: Vec<u8>, lowest: f64, span: f64) -> Self {
        let [low, high] = field.range;
        Self { format, bytes, scale: (high - low) / span, offset: (low - lowest) / span }
    }

    /// 16 bits over the values there are.
    fn quantised(field: &Field) -> Self {
        let (low, high) = field
            .values
            .par_iter()
            .fold(|| (f32::INFINITY, f32::NEG_INFINITY), |(l, h), &v| (l.min(v), h.max(v)))
            .reduce(|| (f32::INFINITY, f32::NEG_INFINITY), |a, b| (a.0.min(b.0), a.1.max(b.1)));
        let (low, high) = (f64::from(low), f64::from(high));
        let span = if high > low { high - low } else { 1.0 };
        let code = |x: &f32| ((f64::from(*x) - low) / span * 65535.0).round() as u16;
        let words: Vec<u16> = field.values.par_iter().map(code).collect();
        Self {
            format: vk::Format::R16_UNORM,
            bytes: bytemuck::cast_slice(&words).to_vec(),
            scale: 1.0 / span,
            offset: -low / span,
        }
    }

    /// The transfer function over the texture's values.
    pub fn transfer(&self, transfer: &TransferFunction) -> TransferFunction {
        transfer.mapped(|x| self.scale * x + self.offset)
    }
}
