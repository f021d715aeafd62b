//! Buffers that shaders read as rows of texels.

use std::sync::Arc;

use ash::vk;

use super::buffer::{Buffer, BufferInfo};
use super::device::Device;
use super::failure::misuse;
use super::format::texel_bytes;
use super::owned::Owned;
use crate::error::{Error, Result};

/// A buffer of texels in a row, which shaders read by their numbers. Copies are the same buffer.
#[derive(Clone)]
pub struct TexelBuffer {
    pub buffer: Buffer,
    pub(super) view: Arc<Owned<vk::BufferView>>,
}

impl TexelBuffer {
    /// A buffer for such texels; its usage is seen to.
    ///
    /// # Errors
    /// A size of 0 or of no whole number of texels, a format that the device does not read from buffers, more texels than it allows, too
    /// little memory.
    pub fn new(device: &Arc<Device>, info: BufferInfo, format: vk::Format) -> Result<Self> {
        let name = info.name.clone();
        let whole = texel_bytes(format).filter(|bytes| info.size.is_multiple_of(*bytes));
        let texels = whole.map(|bytes| info.size / bytes);
        let texels = texels.ok_or_else(|| misuse(&name, format!("{} bytes are no texels of {format:?}", info.size)))?;
        let limit = device.info.max_texel_buffer;
        if texels > limit.into() {
            let problem = format!("{texels} texels, {} allows {limit} in a buffer", device.info.name);
            return Err(Error::device(&name, problem, "use smaller data, or a device with a higher limit"));
        }
        if !device.reads_texels(format) {
            let problem = format!("cannot read {format:?} from buffers, as {name} has it");
            return Err(Error::device(&device.info.name, problem, "use another device"));
        }
        let usage = info.usage | vk::BufferUsageFlags::UNIFORM_TEXEL_BUFFER;
        let buffer = Buffer::new(device, BufferInfo { usage, ..info })?;
        let create = vk::BufferViewCreateInfo::default().buffer(buffer.handle()).format(format).range(vk::WHOLE_SIZE);
        // SAFETY: the buffer lives as long as the view, which is kept beside it; format, usage and number of texels were checked.
        let raw = unsafe { device.raw.create_buffer_view(&create, None) };
        let raw = device.check("vkCreateBufferView", &name, raw)?;
        device.name(raw, &name);
        // SAFETY of the destroyer: called once, when nothing uses the view any more.
        let view = Owned::new(device, raw, |device, raw| unsafe { device.destroy_buffer_view(raw, None) });
        Ok(Self { buffer, view })
    }
}
