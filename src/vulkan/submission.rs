//! Points on the timelines of queues, which submissions reach.

use std::sync::Arc;

use ash::vk;

use super::device::Device;
use crate::error::Result;

/// A point on a queue's timeline: reached when a submission and all before it on that queue have ended.
#[derive(Clone)]
pub struct Submission {
    pub(super) name: Arc<str>,
    /// Holds the queue's timeline, which goes with the device.
    pub(super) device: Arc<Device>,
    pub(super) timeline: vk::Semaphore,
    pub(super) value: u64,
}

impl Submission {
    /// Waits on the host until it is reached, but not longer than the device's watch has it.
    ///
    /// # Errors
    /// A lost device, or work that was given up, with the last step begun.
    pub fn wait(&self) -> Result<()> {
        let watched = &self.device.watched;
        let given_up = || watched.give_up(&self.name, &self.device.marks.last_step());
        if watched.has_given_up() {
            return Err(given_up());
        }
        let (semaphores, values) = ([self.timeline], [self.value]);
        let info = vk::SemaphoreWaitInfo::default().semaphores(&semaphores).values(&values);
        // SAFETY: the semaphore is alive and a timeline.
        match unsafe { self.device.raw.wait_semaphores(&info, watched.nanoseconds()) } {
            Err(vk::Result::TIMEOUT) => Err(given_up()),
            waited => self.device.check("vkWaitSemaphores", &self.name, waited),
        }
    }

    /// Whether it is reached.
    ///
    /// # Errors
    /// A lost device, with the last step begun.
    pub fn reached(&self) -> Result<bool> {
        // SAFETY: the semaphore is alive and a timeline.
        let value = unsafe { self.device.raw.get_semaphore_counter_value(self.timeline) };
        Ok(self.device.check("vkGetSemaphoreCounterValue", &self.name, value)? >= self.value)
    }
}
