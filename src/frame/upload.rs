//! Data to the device and back.

use std::sync::Arc;

use ash::vk;
use cpu_time::ProcessTime;

use crate::error::Result;
use crate::glsl;
use crate::pass::resource::{Resource, Usage};
use crate::pass::{Work, block_range};
use crate::scene::Field;
use crate::vulkan::{
    Buffer, BufferInfo, Commands, ComputePipeline, DescriptorSet, Device, Image, Place, Region, Resource as Bound,
    Sampler, Scope, Shader,
};

const COPY_READ: Scope = Scope::new(vk::PipelineStageFlags2::COPY, vk::AccessFlags2::TRANSFER_READ);
const COPY_WRITE: Scope = Scope::new(vk::PipelineStageFlags2::COPY, vk::AccessFlags2::TRANSFER_WRITE);

fn scope(usage: Usage) -> Scope {
    let (stages, access) = usage.scope();
    Scope { stages, access }
}

/// Fills an image and leaves it to be read by shaders.
///
/// # Errors
/// When memory is short.
pub fn image(device: &Arc<Device>, image: &Image, texels: &[u8]) -> Result<()> {
    let staging = Buffer::new(
        device,
        BufferInfo {
            name: format!("{} upload", image.info.name),
            size: texels.len() as u64,
            usage: vk::BufferUsageFlags::TRANSFER_SRC,
            place: Place::Upload,
        },
    )?;
    staging.write(0, texels)?;
    let mut commands = Commands::begin(device, &device.graphics, "upload")?;
    let (empty, target) = (vk::ImageLayout::UNDEFINED, vk::ImageLayout::TRANSFER_DST_OPTIMAL);
    commands.image_barrier(image, Scope::NONE, COPY_WRITE, empty, target);
    commands.copy_buffer_to_image(&staging, image, Region::whole(image));
    let read = vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL;
    commands.image_barrier(image, COPY_WRITE, scope(Usage::Sampled), target, read);
    finish(device, commands)
}

fn finish(device: &Arc<Device>, commands: Commands) -> Result<()> {
    device.graphics.submit(&commands.finish()?, &[])?.wait()
}

/// Minimum and maximum of every block, by the compute queue: the graphics queue hands the volume over and takes
/// it back where the two are of different families. The CPU time it took, milliseconds.
///
/// # Errors
/// What the driver reports.
pub fn build_block_range(device: &Arc<Device>, field: &Field, volume: &Image, ranges: &Buffer) -> Result<f64> {
    let step = block_range::block_range(field);
    let Work::Dispatch { shader: name, groups } = step.work else { return Ok(0.0) };
    let shader = Shader::new(name, &glsl::module(name)?)?;
    let pipeline = ComputePipeline::new(device, &step.name, &shader, &[])?;
    let sampler = Sampler::new(device, "nearest", false)?;
    let read = vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL;
    let bound = [
        (Resource::Volume.name(), Bound::Sampled(volume, &sampler, read)),
        (Resource::BlockRange.name(), Bound::Storage(ranges)),
    ];
    let set = DescriptorSet::new(device, &step.name, &pipeline.layout, &bound)?;
    let begin = ProcessTime::now();
    let (graphics, compute) = (&device.graphics, &device.compute);

    let mut give = Commands::begin(device, graphics, "volume to compute")?;
    give.image_release(volume, scope(Usage::Sampled), read, read, compute);
    let give = give.finish()?;
    let given = graphics.submit(&give, &[])?;

    let mut build = Commands::begin(device, compute, &step.name)?;
    build.label_begin(&step.name);
    build.image_acquire(volume, scope(Usage::ComputeRead), read, read, graphics);
    build.bind_compute(&pipeline, &set);
    build.dispatch(groups);
    build.image_release(volume, scope(Usage::ComputeRead), read, read, graphics);
    build.buffer_release(ranges, scope(Usage::ComputeWrite), graphics);
    build.label_end();
    let build = build.finish()?;
    let built = compute.submit(&build, &[&given])?;

    let mut take = Commands::begin(device, graphics, "block_range to graphics")?;
    take.image_acquire(volume, scope(Usage::Sampled), read, read, compute);
    take.buffer_acquire(ranges, scope(Usage::Sampled), compute);
    let take = take.finish()?;
    graphics.submit(&take, &[&built])?.wait()?;
    Ok(begin.elapsed().as_secs_f64() * 1e3)
}

/// The texels of `area` of an image that is in `layout`, rows tightly packed; it is left as a copy's source.
///
/// # Errors
/// When memory is short.
pub fn read_back(
    device: &Arc<Device>,
    image: &Image,
    area: Region,
    layout: vk::ImageLayout,
) -> Result<(Vec<u8>, vk::Format)> {
    let [width, height, _] = image.info.extent;
    let texel = image.bytes() / (u64::from(width) * u64::from(height));
    let buffer = Buffer::new(
        device,
        BufferInfo {
            name: format!("{} read back", image.info.name),
            size: u64::from(area.extent[0]) * u64::from(area.extent[1]) * texel,
            usage: vk::BufferUsageFlags::TRANSFER_DST,
            place: Place::Readback,
        },
    )?;
    let mut commands = Commands::begin(device, &device.graphics, "read back")?;
    // Everything that ran before has been waited for; what is left is the layout.
    commands.image_barrier(image, COPY_WRITE, COPY_READ, layout, vk::ImageLayout::TRANSFER_SRC_OPTIMAL);
    commands.copy_image_to_buffer(image, &buffer, area);
    finish(device, commands)?;
    Ok((buffer.read()?, image.info.format))
}

/// Texels of an accumulation format as f32.
pub fn decode_rgba(texels: &[u8], format: vk::Format) -> Vec<[f32; 4]> {
    let four = |texel: &[u8], decode: &dyn Fn(&[u8]) -> f32| -> [f32; 4] {
        let size = texel.len() / 4;
        std::array::from_fn(|c| decode(&texel[c * size..(c + 1) * size]))
    };
    let each =
        |size: usize, decode: &dyn Fn(&[u8]) -> f32| texels.chunks_exact(size).map(|t| four(t, decode)).collect();
    match format {
        vk::Format::R8G8B8A8_UNORM => each(4, &|b| f32::from(b[0]) / 255.0),
        vk::Format::R16G16B16A16_SFLOAT => each(8, &|b| half::f16::from_le_bytes([b[0], b[1]]).to_f32()),
        _ => each(16, &|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]])),
    }
}
