//! Recordings to queues.

use ash::vk;

use super::failure::misuse;
use super::queue::Queue;
use super::recorded::Recorded;
use super::submission::Submission;
use crate::error::Result;

impl Queue {
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
