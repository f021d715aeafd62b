//! What the tests of the Vulkan layer share.

use std::sync::Arc;

use depthleap::vulkan::{Buffer, BufferInfo, Commands, Device, Place, Scope, vk};

pub const COPY_READ: Scope = Scope::new(vk::PipelineStageFlags2::COPY, vk::AccessFlags2::TRANSFER_READ);
pub const COPY_WRITE: Scope = Scope::new(vk::PipelineStageFlags2::COPY, vk::AccessFlags2::TRANSFER_WRITE);
/// Filling a buffer: a copy to older validation layers, a clear to newer ones.
pub const FILL: Scope = Scope::new(vk::PipelineStageFlags2::ALL_TRANSFER, vk::AccessFlags2::TRANSFER_WRITE);
pub const COMPUTE: Scope = Scope::new(
    vk::PipelineStageFlags2::COMPUTE_SHADER,
    vk::AccessFlags2::from_raw(vk::AccessFlags2::SHADER_READ.as_raw() | vk::AccessFlags2::SHADER_WRITE.as_raw()),
);

/// A buffer that shaders and copies read and write.
pub fn buffer(device: &Arc<Device>, name: &str, bytes: u64, place: Place) -> Buffer {
    let usage =
        vk::BufferUsageFlags::STORAGE_BUFFER | vk::BufferUsageFlags::TRANSFER_SRC | vk::BufferUsageFlags::TRANSFER_DST;
    Buffer::new(device, BufferInfo { name: name.to_owned(), size: bytes, usage, place }).unwrap()
}

/// A buffer that holds `bytes`.
pub fn uploaded(device: &Arc<Device>, name: &str, bytes: &[u8]) -> Buffer {
    let buffer = buffer(device, name, bytes.len() as u64, Place::Upload);
    buffer.write(0, bytes).unwrap();
    buffer
}

/// Records, runs on the graphics queue and waits.
pub fn run(device: &Arc<Device>, name: &str, record: impl FnOnce(&mut Commands)) {
    let mut commands = Commands::begin(device, &device.graphics, name).unwrap();
    record(&mut commands);
    let recorded = commands.finish().unwrap();
    device.graphics.submit(&recorded, &[]).unwrap().wait().unwrap();
}

/// What a recording of that misuse is refused with.
pub fn misuse(device: &Arc<Device>, record: impl FnOnce(&mut Commands)) -> depthleap::Result<()> {
    let mut commands = Commands::begin(device, &device.graphics, "misuse").unwrap();
    record(&mut commands);
    commands.finish().map(drop)
}

/// Fails unless the result is an error whose text holds all `parts`.
#[track_caller]
pub fn refused<T>(result: depthleap::Result<T>, parts: &[&str]) {
    let text = result.err().expect("an error was promised").to_string();
    for part in parts {
        assert!(text.contains(part), "{part:?} is missing in: {text}");
    }
}

pub fn words(bytes: &[u8]) -> Vec<u32> {
    bytes.chunks_exact(4).map(|word| u32::from_ne_bytes([word[0], word[1], word[2], word[3]])).collect()
}
