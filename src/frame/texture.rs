//! How a volume is kept on the device: the texture's format, its texels, and where the scalar range lies in it.

use ash::vk;
use rayon::prelude::*;

use crate::scene::settings::VolumeTexture;
use crate::scene::volume::Voxels;
use crate::scene::{Field, TransferFunction};
use crate::structure::cells::Values;

/// Texels of a volume, and the map from x (0..1 over the scalar range) to the texture's own value:
/// `texture = scale * x + offset`.
#[derive(Clone, Debug)]
pub struct Texels<'a> {
    pub values: Values<'a>,
    pub scale: f64,
    pub offset: f64,
}

impl<'a> Texels<'a> {
    pub fn new(field: &'a Field, texture: VolumeTexture) -> Self {
        match (texture, &field.volume.voxels) {
            (VolumeTexture::Native, Voxels::U8(v)) => Self::unorm(field, Values::Unorm8(v.into()), 0.0, 255.0),
            (VolumeTexture::Native, Voxels::I8(v)) => {
                let codes: Vec<u8> = v.iter().map(|&i| i.wrapping_sub(i8::MIN) as u8).collect();
                Self::unorm(field, Values::Unorm8(codes.into()), -128.0, 255.0)
            }
            (VolumeTexture::Native, Voxels::U16(v)) => Self::unorm(field, Values::Unorm16(v.into()), 0.0, 65535.0),
            (VolumeTexture::Native, Voxels::I16(v)) => {
                let codes: Vec<u16> = v.iter().map(|&i| i.wrapping_sub(i16::MIN) as u16).collect();
                Self::unorm(field, Values::Unorm16(codes.into()), -32768.0, 65535.0)
            }
            (VolumeTexture::R16, _) => Self::quantised(field),
            (VolumeTexture::Native | VolumeTexture::R32f, _) => {
                Self { values: Values::Float(field.values.as_slice().into()), scale: 1.0, offset: 0.0 }
            }
        }
    }

    /// Integers as stored: the texture's value is (voxel - lowest) / span.
    fn unorm(field: &Field, values: Values<'a>, lowest: f64, span: f64) -> Self {
        let [low, high] = field.range;
        Self { values, scale: (high - low) / span, offset: (low - lowest) / span }
    }

    /// 16 bits over the values there are.
    fn quantised(field: &Field) -> Self {
        let [low, high] = field.extremes().map(f64::from);
        let span = if high > low { high - low } else { 1.0 };
        let code = |x: &f32| ((f64::from(*x) - low) / span * 65535.0).round() as u16;
        let codes: Vec<u16> = field.values.par_iter().map(code).collect();
        Self { values: Values::Unorm16(codes.into()), scale: 1.0 / span, offset: -low / span }
    }

    pub fn format(&self) -> vk::Format {
        match self.values {
            Values::Unorm8(_) => vk::Format::R8_UNORM,
            Values::Unorm16(_) => vk::Format::R16_UNORM,
            Values::Float(_) => vk::Format::R32_SFLOAT,
        }
    }

    pub fn bytes(&self) -> &[u8] {
        match &self.values {
            Values::Unorm8(codes) => codes,
            Values::Unorm16(codes) => bytemuck::cast_slice(codes),
            Values::Float(values) => bytemuck::cast_slice(values),
        }
    }

    /// The transfer function over the texture's values.
    pub fn transfer(&self, transfer: &TransferFunction) -> TransferFunction {
        transfer.mapped(|x| self.scale * x + self.offset)
    }
}
