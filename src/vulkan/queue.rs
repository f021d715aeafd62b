//! Queues and the points on their timelines that submissions reach.
//!
//! Every queue has one timeline semaphore that counts its submissions; a submission waits for points on it, the
//! host too. There are no semaphores besides: they would have to outlive a driver's own use of them, and Mesa 22.3
//! looks at the semaphores a submission waited for after it has signalled the submission's end.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use ash::vk;

use super::device::Device;
use super::failure::{failed, misuse};
use super::recorded::Recorded;
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
    raw: vk::Queue,
    /// Counts the submissions that have ended.
    timeline: vk::Semaphore,
    submitted: u64,
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

    /// Runs the recording after all of `after` are reached. One that is still running from an earlier submission is
    /// waited for first.
    ///
    /// # Errors
    /// A recording made for another queue family, or a failing driver; a lost device names its last step.
    pub fn submit(&self, recorded: &Recorded, after: &[&Submission]) -> Result<Submission> {
        let (device, name) = (recorded.device(), recorded.name());
        if recorded.family() != self.family {
            return Err(misuse(name, format!("was recorded for queue family {}", recorded.family())));
        }
        recorded.wait()?;
        let commands = [vk::CommandBufferSubmitInfo::default().command_buffer(recorded.raw())];
        let at = |semaphore, value| {
            vk::SemaphoreSubmitInfo::default()
                .semaphore(semaphore)
                .value(value)
                .stage_mask(vk::PipelineStageFlags2::ALL_COMMANDS)
        };
        let waits: Vec<_> = after.iter().map(|one| at(one.timeline, one.value)).collect();

        let mut state = self.lock();
        let value = state.submitted + 1;
        let signals = [at(state.timeline, value)];
        let submit = vk::SubmitInfo2::default()
            .command_buffer_infos(&commands)
            .wait_semaphore_infos(&waits)
            .signal_semaphore_infos(&signals);
        // SAFETY: the queue is locked; all handles are of this device, and the recording keeps what it uses alive
        // until the timeline has reached `value`.
        let result = unsafe { device.raw.queue_submit2(state.raw, &[submit], vk::Fence::null()) };
        device.check("vkQueueSubmit2", name, result)?;
        state.submitted = value;
        let submission = Submission { name: name.into(), device: device.clone(), timeline: state.timeline, value };
        drop(state);
        recorded.submitted(&submission);
        Ok(submission)
    }
}

/// A point on a queue's timeline: reached when a submission and all before it on that queue have ended.
#[derive(Clone)]
pub struct Submission {
    name: Arc<str>,
    /// Holds the queue's timeline, which goes with the device.
    device: Arc<Device>,
    timeline: vk::Semaphore,
    value: u64,
}

impl Submission {
    /// Waits on the host until it is reached.
    ///
    /// # Errors
    /// A lost device, with the last step begun.
    pub fn wait(&self) -> Result<()> {
        let (semaphores, values) = ([self.timeline], [self.value]);
        let info = vk::SemaphoreWaitInfo::default().semaphores(&semaphores).values(&values);
        // SAFETY: the semaphore is alive and a timeline.
        let waited = unsafe { self.device.raw.wait_semaphores(&info, u64::MAX) };
        self.device.check("vkWaitSemaphores", &self.name, waited)
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

fn create_timeline(raw: &ash::Device) -> Result<vk::Semaphore, vk::Result> {
    let mut kind = vk::SemaphoreTypeCreateInfo::default().semaphore_type(vk::SemaphoreType::TIMELINE);
    let info = vk::SemaphoreCreateInfo::default().push_next(&mut kind);
    // SAFETY: the device is alive and was made with timeline semaphores.
    unsafe { raw.create_semaphore(&info, None) }
}
