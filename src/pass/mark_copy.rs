//! Marks to the depth buffer: colour image -> buffer -> depth image, since Vulkan copies between the two kinds
//! only by way of a buffer.

use crate::part::resource::{Resource, Usage};
use crate::part::{Group, Step, Work};

/// Copies the marks that decide who takes part in main pass `pass`.
pub fn mark_copy(pass: u32) -> Step {
    Step {
        name: format!("mark_copy #{pass}"),
        group: Group::Copy,
        pass,
        accesses: vec![Usage::CopySource.of(Resource::Marks), Usage::CopyTarget.of(Resource::Stored)].into(),
        work: Work::Copy { from: Resource::Marks, by: Resource::MarksBuffer, to: Resource::Stored },
    }
}
