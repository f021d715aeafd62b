//! A volume's texels on the device, and where the scalar range lies in them.

use std::borrow::Cow;

use ash::vk;
use rayon::prelude::*;

use crate::projection::Shown;
use crate::scene::texture::{Coding, Stretch, TexelFormat, TextureChoice, TextureMap};
use crate::scene::volume::{VoxelType, Voxels};
use crate::scene::{Field, Scene, TransferFunction};
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
    /// The texels of a scene's volume, as [`TextureChoice`] keeps it.
    pub fn of(scene: &'a Scene) -> Self {
        Self::new(&scene.field, TextureChoice::of(scene).kept)
    }

    fn new(field: &'a Field, kept: Coding) -> Self {
        let values = match kept {
            Coding::Stretched => Self::stretched(field),
            Coding::Spread => Self::spread(field),
            Coding::Float => Self::floats(field),
            Coding::Stored | Coding::Widened => Self::coded(field, kept),
        };
        let TextureMap { scale, offset } = TextureMap::of(field, kept);
        Self { values, scale, offset }
    }

    fn floats(field: &'a Field) -> Values<'a> {
        Values::Float(field.values.as_slice().into())
    }

    /// Integers as stored: the texture's value is (voxel - least) / (most - least) of their type. Where x is 0 everywhere,
    /// so is the texture's value.
    fn coded(field: &'a Field, kept: Coding) -> Values<'a> {
        match (&field.volume.voxels, kept) {
            (Voxels::U8(v), Coding::Widened) => Values::Unorm16(codes(field, v, |v| u16::from(v) * WIDEN).into()),
            (Voxels::U8(v), _) => Values::Unorm8(borrowed_or(field, v, || codes(field, v, |v| v))),
            (Voxels::I8(v), Coding::Widened) => {
                Values::Unorm16(codes(field, v, |v| u16::from(from_i8(v)) * WIDEN).into())
            }
            (Voxels::I8(v), _) => Values::Unorm8(codes(field, v, from_i8).into()),
            (Voxels::U16(v), _) => Values::Unorm16(borrowed_or(field, v, || codes(field, v, |v| v))),
            (Voxels::I16(v), _) => Values::Unorm16(codes(field, v, |v| v.wrapping_sub(i16::MIN) as u16).into()),
            // Other types have no codes.
            _ => Self::floats(field),
        }
    }

    /// Whole numbers, times one that lets them fill 16 bits.
    fn stretched(field: &'a Field) -> Values<'a> {
        let Stretch { least, factor } = Stretch::of(field);
        let code = |value: f64| (value - least).clamp(0.0, f64::from(u16::MAX)) as u16 * factor;
        let values = match &field.volume.voxels {
            Voxels::U8(v) => codes(field, v, |v| code(f64::from(v))),
            Voxels::I8(v) => codes(field, v, |v| code(f64::from(v))),
            Voxels::U16(v) => codes(field, v, |v| code(f64::from(v))),
            Voxels::I16(v) => codes(field, v, |v| code(f64::from(v))),
            // Other types are not stretched.
            _ => return Self::floats(field),
        };
        Values::Unorm16(values.into())
    }

    /// 16 bits over the values there are.
    fn spread(field: &Field) -> Values<'static> {
        let [low, high] = field.extremes().map(f64::from);
        let span = if high > low { high - low } else { 1.0 };
        let code = |x: &f32| ((f64::from(*x) - low) / span * f64::from(u16::MAX)).round() as u16;
        let codes: Vec<u16> = field.values.par_iter().map(code).collect();
        Values::Unorm16(codes.into())
    }

    pub fn format(&self) -> vk::Format {
        match self.values {
            Values::Unorm8(_) => texel_format(TexelFormat::R8),
            Values::Unorm16(_) => texel_format(TexelFormat::R16),
            Values::Float(_) => texel_format(TexelFormat::R32f),
        }
    }

    pub fn bytes(&self) -> &[u8] {
        match &self.values {
            Values::Unorm8(codes) => codes,
            Values::Unorm16(codes) => bytemuck::cast_slice(codes),
            Values::Float(values) => bytemuck::cast_slice(values),
        }
    }

    /// What shows of a scene, among the texture's values.
    pub fn shown(&self, scene: &Scene) -> Shown {
        Shown::of(scene, TextureMap { scale: self.scale, offset: self.offset })
    }

    /// The transfer function over the texture's values.
    pub fn transfer(&self, transfer: &TransferFunction) -> TransferFunction {
        transfer.mapped(|x| self.scale * x + self.offset)
    }
}

/// A level, in x, among the values of a texture that keeps a field so: voxels whose x is not below it are those whose texels are not below
/// this. Of codes it lies in the middle between two, so that it does not matter how a device rounds them.
pub fn threshold(field: &Field, kept: Coding, level: f32) -> f32 {
    let map = TextureMap::of(field, kept);
    if kept == Coding::Float || texel_type(field).is_none() || field.has_empty_range() {
        return map.value(level.into()) as f32;
    }
    // The least whole number whose x is not below the level; numbers of the types that have codes have 16 bits at the most.
    let (mut below, mut not_below) = (i32::from(i16::MIN) - 1, i32::from(u16::MAX) + 1);
    while not_below - below > 1 {
        let middle = (below + not_below) / 2;
        match field.x(f64::from(middle)) < level {
            true => below = middle,
            false => not_below = middle,
        }
    }
    let [low, high] = field.range;
    map.value((f64::from(not_below) - 0.5 - low) / (high - low)) as f32
}

/// The type of a field's voxels, where textures may hold their codes.
fn texel_type(field: &Field) -> Option<VoxelType> {
    let of = field.volume.voxels.voxel_type();
    matches!(of, VoxelType::U8 | VoxelType::I8 | VoxelType::U16 | VoxelType::I16).then_some(of)
}

/// A code of 8 bits times this is the code of 16 bits for the same number: 65535 / 255.
const WIDEN: u16 = 257;

fn from_i8(value: i8) -> u8 {
    value.wrapping_sub(i8::MIN) as u8
}

/// The code of every voxel. A missing voxel has that of the range's low end, and all have that of 0 where x is 0.
fn codes<T: Copy + Coded, C: Copy + Default + Send + Sync>(
    field: &Field,
    voxels: &[T],
    code: impl Fn(T) -> C + Sync,
) -> Vec<C> {
    if field.has_empty_range() {
        return vec![C::default(); voxels.len()];
    }
    let low = code(T::of(field.range[0]));
    let of = |(i, voxel): (usize, &T)| if field.missing > 0 && field.is_missing(i) { low } else { code(*voxel) };
    voxels.par_iter().enumerate().map(of).collect()
}

/// The voxels themselves, where they are the codes.
fn borrowed_or<'a, T: Clone>(field: &Field, voxels: &'a [T], codes: impl FnOnce() -> Vec<T>) -> Cow<'a, [T]> {
    let as_they_are = field.missing == 0 && !field.has_empty_range();
    if as_they_are { Cow::Borrowed(voxels) } else { Cow::Owned(codes()) }
}

/// Types of voxels that textures hold as they are.
trait Coded: Send + Sync {
    /// A whole number of the type's range.
    fn of(value: f64) -> Self;
}

macro_rules! coded {
    ($($type:ty),*) => { $(impl Coded for $type { fn of(value: f64) -> Self { value as Self } })* };
}
coded!(u8, i8, u16, i16);

/// The Vulkan format of texels.
pub fn texel_format(format: TexelFormat) -> vk::Format {
    match format {
        TexelFormat::R8 => vk::Format::R8_UNORM,
        TexelFormat::R16 => vk::Format::R16_UNORM,
        TexelFormat::R32f => vk::Format::R32_SFLOAT,
    }
}
