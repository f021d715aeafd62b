//! Data to the device and back.

use std::sync::Arc;

use ash::vk;

use crate::error::Result;
use crate::part::access::Usage;
use crate::vulkan::{Buffer, BufferInfo, Commands, CopyRegion, Device, Image, Place, Scope};

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
    commands.copy_buffer_to_image(&staging, image, CopyRegion::whole(image));
    let read = vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL;
    commands.image_barrier(image, COPY_WRITE, scope(Usage::Sampled), target, read);
    finish(device, commands)
}

fn finish(device: &Arc<Device>, commands: Commands) -> Result<()> {
    device.graphics.submit(&commands.finish()?, &[])?.wait()
}

/// The texels of `area` of an image that is in `layout`, rows tightly packed; it is left as a copy's source.
///
/// # Errors
/// When memory is short.
pub fn read_back(
    device: &Arc<Device>,
    image: &Image,
    area: CopyRegion,
    layout: vk::ImageLayout,
) -> Result<(Vec<u8>, vk::Format)> {
    let count = |extent: [u32; 3]| extent.into_iter().map(u64::from).product::<u64>();
    let texel = image.bytes() / count(image.info.extent);
    let buffer = Buffer::new(
        device,
        BufferInfo {
            name: format!("{} read back", image.info.name),
            size: count(area.extent) * texel,
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

/// All texels of an image that shaders read, and go on to read.
///
/// # Errors
/// When memory is short.
pub fn read_sampled(device: &Arc<Device>, image: &Image) -> Result<Vec<u8>> {
    let sampled = Usage::Sampled.layout();
    let (texels, _) = read_back(device, image, CopyRegion::whole(image), sampled)?;
    let mut commands = Commands::begin(device, &device.graphics, "read back")?;
    commands.image_barrier(image, COPY_READ, scope(Usage::Sampled), vk::ImageLayout::TRANSFER_SRC_OPTIMAL, sampled);
    finish(device, commands)?;
    Ok(texels)
}

/// All bytes of a buffer.
///
/// # Errors
/// When memory is short.
pub fn read_buffer(device: &Arc<Device>, buffer: &Buffer) -> Result<Vec<u8>> {
    if buffer.info.place != Place::Device {
        return buffer.read();
    }
    let copy = Buffer::new(
        device,
        BufferInfo {
            name: format!("{} read back", buffer.info.name),
            size: buffer.bytes(),
            usage: vk::BufferUsageFlags::TRANSFER_DST,
            place: Place::Readback,
        },
    )?;
    let mut commands = Commands::begin(device, &device.graphics, "read back")?;
    commands.copy_buffer(buffer, 0, &copy, 0, buffer.bytes());
    finish(device, commands)?;
    copy.read()
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
