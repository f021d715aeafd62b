//! Measures what a device's texture unit makes of each format of texels: random ones of every contrast, interpolated at
//! random places and held against f64. A driver states how many bits its weights have, not what it rounds on the way.

use std::sync::Arc;

use ash::vk;
use glam::DVec3;

use super::pipelines::Pipelines;
use super::upload;
use crate::error::Result;
use crate::glsl;
use crate::math::interpolate::trilinear;
use crate::math::random::Random;
use crate::resource::texels::texel_format;
use crate::scene::TextureUnit;
use crate::scene::texture::{FilterError, TexelFormat};
use crate::vulkan::{
    Bound, Buffer, BufferInfo, Commands, DescriptorSet, Device, Image, ImageInfo, ImageShape, Place, Sampler,
};

/// Texels along a side of the measured texture.
const SIDE: usize = 16;

/// Places of each measurement, some four a texel: a multiple of the shader's work group.
const PLACES: usize = 1 << 14;

/// Invocations of a work group, as in `glsl/texture_unit.comp`.
const GROUP: u32 = 64;

/// Contrasts that are measured, in codes of 8 bits: 255 is from 0 to 1.
const CONTRASTS: [u8; 9] = [1, 2, 4, 8, 16, 32, 64, 128, 255];

/// Contrasts up to this one tell what is rounded where neighbours hardly differ.
const SLIGHT: u8 = 16;

/// What places that were not measured may have more than the worst of those that were.
const UNSEEN: f64 = 1.5;

/// Measures every format that the device can interpolate.
///
/// # Errors
/// What the driver reports.
pub fn measure(device: &Arc<Device>, pipelines: &mut Pipelines) -> Result<TextureUnit> {
    let mut unit = TextureUnit { errors: [None; 3], measured: true };
    let mut random = Random(1);
    for format in TexelFormat::ALL {
        let linear = vk::FormatFeatureFlags::SAMPLED_IMAGE_FILTER_LINEAR;
        if device.format_supports(texel_format(format), linear) {
            let errors = CONTRASTS.map(|contrast| largest_error(device, pipelines, format, contrast, &mut random));
            let errors = errors.into_iter().collect::<Result<Vec<f64>>>()?;
            unit.errors[format as usize] = Some(bound(&errors));
        }
    }
    Ok(unit)
}

/// A bound of the errors measured at [`CONTRASTS`], and what comes to them beyond.
fn bound(errors: &[f64]) -> FilterError {
    let measured = CONTRASTS.iter().zip(errors);
    let slight = measured.clone().filter(|(contrast, _)| **contrast <= SLIGHT).map(|(_, error)| *error);
    let rounding = slight.fold(0.0, f64::max);
    let steepness = measured.map(|(contrast, error)| (error - rounding) * 255.0 / f64::from(*contrast));
    FilterError { rounding: UNSEEN * rounding, weight: UNSEEN * steepness.fold(0.0, f64::max) }
}

/// The largest error over [`PLACES`], of texels that differ by at most `contrast` codes of 8 bits.
fn largest_error(
    device: &Arc<Device>,
    pipelines: &mut Pipelines,
    format: TexelFormat,
    contrast: u8,
    random: &mut Random,
) -> Result<f64> {
    // Two values only, so that neighbours differ by all of it in every way that eight can.
    let base = random.below(256 - u32::from(contrast)) as u8;
    let codes: Vec<u8> = (0..SIDE.pow(3)).map(|_| base + contrast * random.below(2) as u8).collect();
    let values: Vec<f32> = codes.iter().map(|code| f32::from(*code) / 255.0).collect();
    let texels: Vec<u8> = match format {
        TexelFormat::R8 => codes.clone(),
        // c / 255 is 257 c / 65535.
        TexelFormat::R16 => codes.iter().flat_map(|code| [*code, *code]).collect(),
        TexelFormat::R32f => bytemuck::cast_slice(&values).to_vec(),
    };
    let places: Vec<[f32; 4]> = (0..PLACES).map(|_| [random.unit(), random.unit(), random.unit(), 0.0]).collect();
    let found = interpolated(device, pipelines, format, &texels, &places)?;
    let dims = [SIDE; 3];
    let error = |(place, found): (&[f32; 4], &f32)| {
        let voxel = DVec3::new(place[0].into(), place[1].into(), place[2].into()) * SIDE as f64;
        (f64::from(*found) - trilinear(&values, dims, voxel)).abs()
    };
    Ok(places.iter().zip(&found).map(error).fold(0.0, f64::max))
}

/// What the texture unit makes of `texels` at `places`.
fn interpolated(
    device: &Arc<Device>,
    pipelines: &mut Pipelines,
    format: TexelFormat,
    texels: &[u8],
    places: &[[f32; 4]],
) -> Result<Vec<f32>> {
    const NAME: &str = "texture_unit";
    let image = Image::new(
        device,
        ImageInfo {
            name: NAME.to_owned(),
            extent: [SIDE as u32; 3],
            format: texel_format(format),
            usage: vk::ImageUsageFlags::SAMPLED | vk::ImageUsageFlags::TRANSFER_DST,
            shape: ImageShape::Volume,
            shared: false,
        },
    )?;
    upload::image(device, &image, texels)?;
    let buffer = |name: &str, size: usize, place: Place| {
        let usage = vk::BufferUsageFlags::STORAGE_BUFFER;
        Buffer::new(device, BufferInfo { name: name.to_owned(), size: size as u64, usage, place })
    };
    let from = buffer("places", size_of_val(places), Place::Upload)?;
    from.write(0, bytemuck::cast_slice(places))?;
    let to = buffer("found", size_of::<f32>() * places.len(), Place::Readback)?;
    let pipeline = pipelines.compute(&Arc::new(shader()), &[], NAME)?;
    let sampler = Sampler::new(device, "trilinear", true)?;
    let bound = [
        ("volume", Bound::Sampled(&image, &sampler, vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL)),
        ("places", Bound::Storage(&from)),
        ("found", Bound::Storage(&to)),
    ];
    let set = Arc::new(DescriptorSet::new(device, NAME, &pipeline.layout, &bound)?);
    let mut commands = Commands::begin(device, &device.graphics, NAME)?;
    commands.bind_compute(&pipeline, &set);
    commands.dispatch([places.len() as u32 / GROUP, 1, 1]);
    device.graphics.submit(&commands.finish()?, &[])?.wait()?;
    Ok(bytemuck::pod_collect_to_vec(&to.read()?))
}

/// What measures.
pub fn shader() -> glsl::Shader {
    glsl::Shader::new("texture_unit.comp", [])
}
