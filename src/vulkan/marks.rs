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

    /// See [`told`].
    pub fn last_step(&self) -> String {
        let allocation = self.allocation.lock().unwrap_or_else(PoisonError::into_inner);
        let names = self.names.lock().unwrap_or_else(PoisonError::into_inner);
        let words = allocation.mapped_slice().unwrap_or_default().chunks_exact(4).take(WORDS);
        let words: Vec<_> = words.map(|word| u32::from_ne_bytes([word[0], word[1], word[2], word[3]])).collect();
        told(&words, &names)
    }

    pub fn free(self, raw: &ash::Device, allocator: &mut Allocator) {
        let allocation = self.allocation.into_inner().unwrap_or_else(PoisonError::into_inner);
        // SAFETY: called when the device is idle, just before it goes.
        unsafe { raw.destroy_buffer(self.buffer, None) };
        // An error here means that the allocator has lost count; the device goes next and takes the memory with it.
        let _ = allocator.free(allocation);
    }
}

/// "the last step begun was 12 (main_pass #3)", for each queue that began one.
fn told(words: &[u32], names: &[String]) -> String {
    let step = |&number: &u32| match names.get(number as usize) {
        Some(name) => format!("{number} ({name})"),
        None => number.to_string(),
    };
    let begun: Vec<_> = words.iter().filter(|&&number| number != NONE).map(step).collect();
    match begun.is_empty() {
        true => "no step had begun".into(),
        false => format!("the last step begun was {}", begun.join(", on the compute queue ")),
    }
}

#[cfg(test)]
mod tests {
    use super::super::failure::lost;
    use super::{NONE, told};

    fn names() -> Vec<String> {
        ["entry", "direction", "main_pass #0"].map(str::to_owned).to_vec()
    }

    #[test]
    fn last_step_of_each_queue_is_told_by_number_and_name() {
        assert_eq!(told(&[2, NONE], &names()), "the last step begun was 2 (main_pass #0)");
        assert_eq!(told(&[2, 0], &names()), "the last step begun was 2 (main_pass #0), on the compute queue 0 (entry)");
    }

    #[test]
    fn step_without_a_name_is_told_by_its_number() {
        assert_eq!(told(&[7, NONE], &names()), "the last step begun was 7");
    }

    #[test]
    fn no_step_is_told_as_such() {
        assert_eq!(told(&[NONE, NONE], &names()), "no step had begun");
    }

    #[test]
    fn lost_device_names_call_object_code_and_step() {
        let text = lost("vkQueueSubmit2", "frame", &told(&[1, NONE], &names())).to_string();
        assert_eq!(
            text,
            "frame: vkQueueSubmit2 failed with VK_ERROR_DEVICE_LOST; the last step begun was 1 (direction); split the \
             work into shorter passes (a watchdog may have ended it), or update the driver"
        );
    }
}
