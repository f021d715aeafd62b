//! Marks to the depth buffer: colour image -> buffer -> depth image, since Vulkan copies between the two kinds
//! only by way of a buffer.

use crate::part::access::Usage;
use crate::part::{Group, Step, Work};
use crate::resource;

/// Copies the marks that decide who takes part in main pass `pass`: those in the tiles of main pass `marked`, or all.
pub fn mark_copy(pass: u32, marked: Option<u32>) -> Step {
    Step::new(
        format!("mark_copy #{pass}"),
        Group::Copy,
        pass,
        vec![Usage::CopySource.of(resource::MARKS), Usage::CopyTarget.of(resource::STORED)],
        Work::Copy { from: resource::MARKS, by: resource::MARKS_BUFFER, to: resource::STORED, of: marked },
    )
}
