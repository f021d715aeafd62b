//! Minimum and maximum of every block, on the compute queue [KW03 §2.3].

use super::resource::{Resource, Usage};
use super::{Group, Step, Work};
use crate::scene::Field;
use crate::structure::blocks::BLOCK;

/// Invocations along each side of a work group, as in the shader.
const GROUP: usize = 4;

pub fn block_range(field: &Field) -> Step {
    Step {
        name: "block_range".to_owned(),
        group: Group::Structure,
        pass: 0,
        accesses: vec![Usage::ComputeRead.of(Resource::Volume), Usage::ComputeWrite.of(Resource::BlockRange)],
        work: Work::Dispatch {
            shader: "structure/block_range.comp",
            groups: field.cells().map(|n| n.div_ceil(BLOCK).div_ceil(GROUP) as u32),
        },
    }
}
