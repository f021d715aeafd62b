//! Finished recordings: what they use lives until their last submission has ended.

use std::sync::{Arc, Mutex, PoisonError};

use ash::vk;

use super::device::Device;
use super::owned::Kept;
use super::submission::Submission;
use crate::error::Result;

/// A finished recording, with all it uses.
pub struct Recorded {
    name: String,
    device: Arc<Device>,
    raw: vk::CommandBuffer,
    family: u32,
    last: Mutex<Option<Submission>>,
    kept: Vec<Kept>,
}

impl Recorded {
    /// Takes over the buffer `raw`, whose recording has ended, with all it uses.
    pub(super) fn new(
        name: String,
        device: Arc<Device>,
        raw: vk::CommandBuffer,
        family: u32,
        kept: impl IntoIterator<Item = Kept>,
    ) -> Self {
        Self { name, device, raw, family, last: Mutex::default(), kept: kept.into_iter().collect() }
    }

    pub fn name(&self) -> &str {
        &self.name
    }

    /// Waits until its last submission has ended.
    pub fn wait(&self) -> Result<()> {
        let last = self.last.lock().unwrap_or_else(PoisonError::into_inner).clone();
        last.map_or(Ok(()), |submission| submission.wait())
    }

    pub(super) fn device(&self) -> &Arc<Device> {
        &self.device
    }

    pub(super) fn raw(&self) -> vk::CommandBuffer {
        self.raw
    }

    pub(super) fn family(&self) -> u32 {
        self.family
    }

    pub(super) fn submitted(&self, submission: &Submission) {
        *self.last.lock().unwrap_or_else(PoisonError::into_inner) = Some(submission.clone());
    }
}

impl Drop for Recorded {
    fn drop(&mut self) {
        // What it uses may be freed when its last submission has ended; a lost device runs nothing any more.
        let _ = self.wait();
        if self.device.watched.has_given_up() {
            // It may run on, and with it the device.
            std::mem::forget(std::mem::take(&mut self.kept));
            std::mem::forget(self.device.clone());
        }
    }
}
