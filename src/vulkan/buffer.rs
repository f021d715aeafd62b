//! Buffers.

use std::mem::ManuallyDrop;
use std::sync::{Arc, Mutex, PoisonError};

use ash::vk;
use gpu_allocator::MemoryLocation;
use gpu_allocator::vulkan::{Allocation, AllocationCreateDesc, AllocationScheme};

use super::device::{Device, mebibytes};
use super::failure::misuse;
use crate::error::{Error, Result};

/// Where a buffer lives and who reaches it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// The device only, even where its memory is the host's.
    Device,
    /// Written by the host, read by the device.
    Upload,
    /// Written by the device, read by the host.
    Readback,
}

/// What a buffer is made from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BufferInfo {
    pub name: String,
    /// Bytes.
    pub size: u64,
    pub usage: vk::BufferUsageFlags,
    pub place: Place,
}

/// A buffer with its memory. `Upload` and `Readback` memory is mapped for good and coherent. Copies are the same buffer.
#[derive(Clone)]
pub struct Buffer {
    pub info: BufferInfo,
    pub(super) inner: Arc<BufferInner>,
}

/// What lives as long as anything uses the buffer.
pub(super) struct BufferInner {
    device: Arc<Device>,
    handle: vk::Buffer,
    /// Locked while the host reads or writes.
    allocation: ManuallyDrop<Mutex<Allocation>>,
}

impl Buffer {
    /// # Errors
    /// A size of 0 or beyond the device's limits, too little memory.
    pub fn new(device: &Arc<Device>, info: BufferInfo) -> Result<Self> {
        check_limits(device, &info)?;
        let families = [device.graphics.family, device.compute.family];
        let create = vk::BufferCreateInfo::default().size(info.size).usage(info.usage);
        // Both queues use them, and none hands them over.
        let create = if families[0] == families[1] {
            create
        } else {
            create.sharing_mode(vk::SharingMode::CONCURRENT).queue_family_indices(&families)
        };
        // SAFETY: the limits were checked; on every error what was made so far is freed, unused.
        let inner = unsafe {
            let handle = device.check("vkCreateBuffer", &info.name, device.raw.create_buffer(&create, None))?;
            match bind(device, &info, handle) {
                Ok(allocation) => BufferInner {
                    device: device.clone(),
                    handle,
                    allocation: ManuallyDrop::new(Mutex::new(allocation)),
                },
                Err(error) => {
                    device.raw.destroy_buffer(handle, None);
                    return Err(error);
                }
            }
        };
        device.name(inner.handle, &info.name);
        Ok(Self { info, inner: Arc::new(inner) })
    }

    pub fn handle(&self) -> vk::Buffer {
        self.inner.handle
    }

    /// Bytes.
    pub fn bytes(&self) -> u64 {
        self.info.size
    }

    /// Copies `bytes` to `offset`. The device must not be using that part: what it reads is undefined until the
    /// write is done, and seen by submissions that follow.
    ///
    /// # Errors
    /// A buffer the host cannot reach, or a range beyond its end.
    pub fn write(&self, offset: u64, bytes: &[u8]) -> Result<()> {
        let end = offset.checked_add(bytes.len() as u64).filter(|&end| end <= self.info.size);
        let mut allocation = self.inner.allocation.lock().unwrap_or_else(PoisonError::into_inner);
        match (end, allocation.mapped_slice_mut().filter(|_| self.info.place != Place::Device)) {
            (Some(end), Some(mapped)) => {
                mapped[offset as usize..end as usize].copy_from_slice(bytes);
                Ok(())
            }
            (None, _) => {
                let problem = format!("{} bytes at {offset} do not fit into {}", bytes.len(), self.info.size);
                Err(misuse(&self.info.name, problem))
            }
            (_, None) => Err(self.unreachable()),
        }
    }

    /// All its bytes, as the submissions left them that were waited for.
    ///
    /// # Errors
    /// A buffer the host cannot reach.
    pub fn read(&self) -> Result<Vec<u8>> {
        let allocation = self.inner.allocation.lock().unwrap_or_else(PoisonError::into_inner);
        let mapped = allocation.mapped_slice().filter(|_| self.info.place != Place::Device);
        let mapped = mapped.ok_or_else(|| self.unreachable())?;
        Ok(mapped[..self.info.size as usize].to_vec())
    }

    fn unreachable(&self) -> Error {
        misuse(&self.info.name, format!("the host cannot reach a buffer in place {:?}", self.info.place))
    }
}

impl Drop for BufferInner {
    fn drop(&mut self) {
        // SAFETY: nothing uses the buffer any more; each part is freed once.
        unsafe {
            self.device.raw.destroy_buffer(self.handle, None);
            let allocation = ManuallyDrop::take(&mut self.allocation);
            self.device.free(allocation.into_inner().unwrap_or_else(PoisonError::into_inner));
        }
    }
}

/// Gives the buffer memory.
///
/// # Safety
/// `handle` is a buffer of `device` made from `info` and not bound yet.
unsafe fn bind(device: &Device, info: &BufferInfo, handle: vk::Buffer) -> Result<Allocation> {
    // SAFETY: promised by the caller.
    let requirements = unsafe { device.raw.get_buffer_memory_requirements(handle) };
    let allocation = device.allocate(&AllocationCreateDesc {
        name: &info.name,
        requirements,
        location: match info.place {
            Place::Device => MemoryLocation::GpuOnly,
            Place::Upload => MemoryLocation::CpuToGpu,
            Place::Readback => MemoryLocation::GpuToCpu,
        },
        linear: true,
        allocation_scheme: AllocationScheme::GpuAllocatorManaged,
    })?;
    // SAFETY: the memory is fresh and meets the requirements.
    let bound = unsafe { device.raw.bind_buffer_memory(handle, allocation.memory(), allocation.offset()) };
    match device.check("vkBindBufferMemory", &info.name, bound) {
        Ok(()) => Ok(allocation),
        Err(error) => {
            device.free(allocation);
            Err(error)
        }
    }
}

fn check_limits(device: &Device, info: &BufferInfo) -> Result<()> {
    let BufferInfo { name, size, usage, .. } = info;
    if *size == 0 || usage.is_empty() {
        return Err(misuse(name, format!("{size} bytes, usage {usage:?}: no such buffer")));
    }
    let uniform = u64::from(device.limits.max_uniform_buffer_range);
    for (kind, flag, limit) in [
        ("storage", vk::BufferUsageFlags::STORAGE_BUFFER, device.info.max_storage_buffer),
        ("uniform", vk::BufferUsageFlags::UNIFORM_BUFFER, uniform),
    ] {
        if usage.contains(flag) && *size > limit {
            let limit = mebibytes(limit);
            let problem = format!("{}, {} allows {limit} in a {kind} buffer", mebibytes(*size), device.info.name);
            return Err(Error::device(name, problem, "use smaller data, or a device with a higher limit"));
        }
    }
    Ok(())
}
