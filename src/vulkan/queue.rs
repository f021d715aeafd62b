//! Queues and the timelines they signal.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use ash::vk;

use super::commands::Recorded;
use super::device::Device;
use super::failure::{failed, misuse};
use super::owned::Owned;
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
    done: vk::Semaphore,
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
        let done = create_timeline(raw).map_err(|code| failed("vkCreateSemaphore", "queue", code))?;
        // SAFETY: the device was made with this queue.
        let queue = unsafe { raw.get_device_queue(family, index) };
        let state = Arc::new(Mutex::new(State { raw: queue, done, submitted: 0 }));
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

    pub(super) fn destroy(&self, raw: &ash::Device) {
        // SAFETY: called when the device is idle, just before it goes.
        unsafe { raw.destroy_semaphore(self.lock().done, None) };
    }

    /// Runs the recordings in order, after all `wait` values are reached; reaches the `signal` values when all of
    /// it has ended. A recording that is still running from an earlier submission is waited for first.
    ///
    /// # Errors
    /// A recording made for another queue family, or a failing driver; a lost device names its last step.
    pub fn submit(&self, recorded: &[&Recorded], wait: &[(&Timeline, u64)], signal: &[(&Timeline, u64)]) -> Result<()> {
        let timeline = wait.iter().chain(signal).map(|(timeline, _)| timeline.device());
        let Some(device) = recorded.iter().map(|one| one.device()).chain(timeline).next().cloned() else {
            return Ok(());
        };
        let name = recorded.first().map_or("empty submission", |one| one.name());
        for one in recorded {
            if one.family() != self.family {
                return Err(misuse(one.name(), format!("was recorded for queue family {}", one.family())));
            }
            one.wait()?;
        }
        let commands: Vec<_> =
            recorded.iter().map(|one| vk::CommandBufferSubmitInfo::default().command_buffer(one.raw())).collect();
        let at = |semaphore, value| {
            vk::SemaphoreSubmitInfo::default()
                .semaphore(semaphore)
                .value(value)
                .stage_mask(vk::PipelineStageFlags2::ALL_COMMANDS)
        };
        let waits: Vec<_> = wait.iter().map(|(timeline, value)| at(timeline.owned.raw, *value)).collect();
        let mut signals: Vec<_> = signal.iter().map(|(timeline, value)| at(timeline.owned.raw, *value)).collect();

        let mut state = self.lock();
        let ended = state.submitted + 1;
        signals.push(at(state.done, ended));
        let submit = vk::SubmitInfo2::default()
            .command_buffer_infos(&commands)
            .wait_semaphore_infos(&waits)
            .signal_semaphore_infos(&signals);
        // SAFETY: the queue is locked; all handles are of this device, and the recordings keep what they use alive
        // until `done` has reached `ended`.
        let result = unsafe { device.raw.queue_submit2(state.raw, &[submit], vk::Fence::null()) };
        device.check("vkQueueSubmit2", name, result)?;
        state.submitted = ended;
        for one in recorded {
            one.submitted(state.done, ended);
        }
        drop(state);
        // A timeline of the caller may be dropped at once; the queue still has to reach it.
        for (timeline, _) in wait.iter().chain(signal) {
            timeline.used_by(self.lock().done, ended);
        }
        Ok(())
    }
}

/// A semaphore that counts up; values are chosen by the caller and never go down.
pub struct Timeline {
    pub name: String,
    owned: Arc<Owned<vk::Semaphore>>,
    /// The queues' own semaphores and what they reach when the last submissions that use this one have ended.
    users: Mutex<Vec<(vk::Semaphore, u64)>>,
}

impl Timeline {
    /// A timeline at 0.
    pub fn new(device: &Arc<Device>, name: &str) -> Result<Self> {
        let raw = device.check("vkCreateSemaphore", name, create_timeline(&device.raw))?;
        device.name(raw, name);
        // SAFETY of the destroyer: `users` was waited for when the timeline was dropped.
        let owned = Owned::new(device, raw, |device, raw| unsafe { device.destroy_semaphore(raw, None) });
        Ok(Self { name: name.into(), owned, users: Mutex::default() })
    }

    /// Waits on the host until the timeline has reached `value`.
    pub fn wait(&self, value: u64) -> Result<()> {
        wait(self.device(), &self.name, self.owned.raw, value)
    }

    /// The value reached so far.
    pub fn value(&self) -> Result<u64> {
        let device = self.device();
        // SAFETY: the semaphore is alive and a timeline.
        let value = unsafe { device.raw.get_semaphore_counter_value(self.owned.raw) };
        device.check("vkGetSemaphoreCounterValue", &self.name, value)
    }

    fn device(&self) -> &Arc<Device> {
        &self.owned.device
    }

    fn used_by(&self, done: vk::Semaphore, value: u64) {
        let mut users = self.users.lock().unwrap_or_else(PoisonError::into_inner);
        users.retain(|(semaphore, _)| *semaphore != done);
        users.push((done, value));
    }
}

impl Drop for Timeline {
    fn drop(&mut self) {
        let users = self.users.lock().unwrap_or_else(PoisonError::into_inner);
        for &(done, value) in users.iter() {
            // A lost device has nothing left to wait for.
            let _ = wait(self.device(), &self.name, done, value);
        }
    }
}

pub(super) fn wait(device: &Device, name: &str, semaphore: vk::Semaphore, value: u64) -> Result<()> {
    let (semaphores, values) = ([semaphore], [value]);
    let info = vk::SemaphoreWaitInfo::default().semaphores(&semaphores).values(&values);
    // SAFETY: the semaphore is alive and a timeline.
    device.check("vkWaitSemaphores", name, unsafe { device.raw.wait_semaphores(&info, u64::MAX) })
}

fn create_timeline(raw: &ash::Device) -> Result<vk::Semaphore, vk::Result> {
    let mut kind = vk::SemaphoreTypeCreateInfo::default().semaphore_type(vk::SemaphoreType::TIMELINE);
    let info = vk::SemaphoreCreateInfo::default().push_next(&mut kind);
    // SAFETY: the device is alive and was made with timeline semaphores.
    unsafe { raw.create_semaphore(&info, None) }
}
