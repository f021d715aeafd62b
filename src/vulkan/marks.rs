//! The number of the step that last began on each queue, in memory the host can read after a device is lost.

use std::sync::{Arc, Mutex, PoisonError};

use ash::vk;
use gpu_allocator::MemoryLocation;
use gpu_allocator::vulkan::{Allocation, AllocationCreateDesc, AllocationScheme, Allocator};

use super::failure::failed;
use crate::error::{Error, Result};

/// Words of the buffer: one for the graphics queue, one for the compute queue.
const WORDS: usize = 2;

/// What stands in a word before any step began.
const NONE: u32 = u32::MAX;

pub(super) struct Marks {
    pub buffer: vk::Buffer,
    allocation: Mutex<Allocation>,
    names: Mutex<Arc<[String]>>,
}

impl Marks {
    pub fn new(raw: &ash::Device, allocator: &mut Allocator) -> Result<Self> {
        let name = "step marks";
        let info = vk::BufferCreateInfo::default().size((WORDS * 4) as u64).usage(vk::BufferUsageFlags::TRANSFER_DST);
        // SAFETY: the device is alive; on every error the buffer is destroyed before it is returned.
        unsafe {
            let buffer = raw.create_buffer(&info, None).map_err(|code| failed("vkCreateBuffer", name, code))?;
            let bound = allocator
                .allocate(&AllocationCreateDesc {
                    name,
                    requirements: raw.get_buffer_memory_requirements(buffer),
                    location: MemoryLocation::GpuToCpu,
                    linear: true,
                    allocation_scheme: AllocationScheme::GpuAllocatorManaged,
                })
                .map_err(|error| Error::device(name, error, "free memory of the device"))
                .and_then(|mut allocation| {
                    if let Some(bytes) = allocation.mapped_slice_mut() {
                        bytes[..WORDS * 4].fill(NONE as u8);
                    }
                    match raw.bind_buffer_memory(buffer, allocation.memory(), allocation.offset()) {
                        Ok(()) => Ok(allocation),
                        Err(code) => Err(failed("vkBindBufferMemory", name, code)),
                    }
                });
            match bound {
                Ok(allocation) => {
                    Ok(Self { buffer, allocation: Mutex::new(allocation), names: Mutex::new(Arc::new([])) })
                }
                Err(error) => {
                    raw.destroy_buffer(buffer, None);
                    Err(error)
                }
            }
        }
    }

    pub fn set_names(&self, names: Arc<[String]>) {
        *self.names.lock().unwrap_or_else(PoisonError::into_inner) = names;
    }

    /// "the last step begun was 12 (main_pass #3)", for each queue that began one.
    pub fn last_step(&self) -> String {
        let allocation = self.allocation.lock().unwrap_or_else(PoisonError::into_inner);
        let names = self.names.lock().unwrap_or_else(PoisonError::into_inner);
        let words = allocation.mapped_slice().unwrap_or_default().chunks_exact(4).take(WORDS);
        let begun: Vec<_> = words
            .map(|word| u32::from_ne_bytes([word[0], word[1], word[2], word[3]]))
            .filter(|&number| number != NONE)
            .map(|number| match names.get(number as usize) {
                Some(name) => format!("{number} ({name})"),
                None => number.to_string(),
            })
            .collect();
        match begun.is_empty() {
            true => "no step had begun".into(),
            false => format!("the last step begun was {}", begun.join(", on the compute queue ")),
        }
    }

    pub fn free(self, raw: &ash::Device, allocator: &mut Allocator) {
        let allocation = self.allocation.into_inner().unwrap_or_else(PoisonError::into_inner);
        // SAFETY: called when the device is idle, just before it goes.
        unsafe { raw.destroy_buffer(self.buffer, None) };
        // An error here means that the allocator has lost count; the device goes next and takes the memory with it.
        let _ = allocator.free(allocation);
    }
}
