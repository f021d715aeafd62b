//! Queues, each with its timeline.
//!
//! Every queue has one timeline semaphore that counts its submissions; a submission waits for points on it, the
//! host too. There are no semaphores besides: they would have to outlive a driver's own use of them, and Mesa 22.3
//! looks at the semaphores a submission waited for after it has signalled the submission's end.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use ash::vk;

use super::failure::failed;
use crate::error::Result;

/// A queue of a device. Submissions from several threads are taken one by one.
pub struct Queue {
    pub family: u32,
    pub index: u32,
    /// 0: no timestamps on this queue.
    pub timestamp_valid_bits: u32,
    /// Its word among the step marks.
    pub(super) slot: u32,
    state: Arc<Mutex<State>>,
}

pub(super) struct State {
    pub raw: vk::Queue,
    /// Counts the submissions that have ended.
    pub timeline: vk::Semaphore,
    pub submitted: u64,
}

impl Queue {
    pub(super) fn new(
        raw: &ash::Device,
        family: u32,
        index: u32,
        timestamp_valid_bits: u32,
        slot: u32,
    ) -> Result<Self> {
        let timeline = create_timeline(raw).map_err(|code| failed("vkCreateSemaphore", "queue", code))?;
        // SAFETY: the device was made with this queue.
        let queue = unsafe { raw.get_device_queue(family, index) };
        let state = Arc::new(Mutex::new(State { raw: queue, timeline, submitted: 0 }));
        Ok(Self { family, index, timestamp_valid_bits, slot, state })
    }

    /// The same queue under a second name.
    pub(super) fn share(&self) -> Self {
        let Self { family, index, timestamp_valid_bits, slot, .. } = *self;
        Self { family, index, timestamp_valid_bits, slot, state: self.state.clone() }
    }

    pub(super) fn shares(&self, other: &Queue) -> bool {
        Arc::ptr_eq(&self.state, &other.state)
    }

    pub(super) fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    pub(super) fn raw(&self) -> vk::Queue {
        self.lock().raw
    }

    pub(super) fn timeline(&self) -> vk::Semaphore {
        self.lock().timeline
    }

    pub(super) fn destroy(&self, raw: &ash::Device) {
        // SAFETY: called when the device is idle, just before it goes.
        unsafe { raw.destroy_semaphore(self.lock().timeline, None) };
    }
}

fn create_timeline(raw: &ash::Device) -> Result<vk::Semaphore, vk::Result> {
    let mut kind = vk::SemaphoreTypeCreateInfo::default().semaphore_type(vk::SemaphoreType::TIMELINE);
    let info = vk::SemaphoreCreateInfo::default().push_next(&mut kind);
    // SAFETY: the device is alive and was made with timeline semaphores.
    unsafe { raw.create_semaphore(&info, None) }
}
