//! What a mark costs: `gl_FragDepth`, or a colour attachment that is copied into the depth buffer.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::case::{Case, CaseShader, Compare, Mechanism};
use super::measure::{ProbeClock, Timed, input};
use super::pattern::Pattern;
use super::rig::{ALL, Ask, FROM, Rig, TESTED, TO};
use crate::error::Result;
use crate::vulkan::{Buffer, BufferInfo, Commands, CopyRegion, Device, Place, vk};

/// Times of a pass that marks every pixel, milliseconds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MarkCost {
    /// Pixels of a side of the picture.
    pub side: u32,
    pub fragdepth_ms: Vec<f64>,
    pub copy_ms: Vec<f64>,
}

const fn case(shader: CaseShader) -> Case {
    Case { mechanism: Mechanism::DepthWrite, shader, compare: Compare::GreaterOrEqual }
}

/// Measures both, `rounds` times by turns.
///
/// # Errors
/// What the driver reports.
pub fn mark_cost(device: &Arc<Device>, clock: ProbeClock, side: u32, rounds: usize) -> Result<MarkCost> {
    let mut rig = Rig::new(device, vk::Format::D32_SFLOAT, side)?;
    let (fragdepth, early) = (case(CaseShader::DepthLess), case(CaseShader::Early));
    let draw = input(&rig, &fragdepth, Pattern::None, 1);
    let by_fragdepth = Timed::new(&mut rig, &fragdepth, &draw)?;

    let usage = vk::BufferUsageFlags::TRANSFER_SRC | vk::BufferUsageFlags::TRANSFER_DST;
    let size = 4 * u64::from(side) * u64::from(side);
    let info = BufferInfo { name: "probe marks".to_owned(), size, usage, place: Place::Device };
    let between = Buffer::new(device, info)?;
    let mut commands = Commands::begin(device, &device.graphics, "mark by copy")?;
    rig.record(&mut commands, &early, &draw, Ask::Time)?;
    commands.copy_image_to_buffer(&rig.color, &between, CopyRegion::whole(&rig.color));
    commands.buffer_barrier(&between, ALL, ALL);
    commands.image_barrier(&rig.depth, ALL, ALL, FROM, TO);
    commands.copy_buffer_to_image(&between, &rig.depth, CopyRegion::whole(&rig.depth));
    commands.image_barrier(&rig.depth, ALL, ALL, TO, TESTED);
    rig.stamp(&mut commands);
    let by_copy = Timed::of(commands.finish()?);

    let mut cost = MarkCost { side, fragdepth_ms: Vec::new(), copy_ms: Vec::new() };
    for round in 0..=rounds {
        let ms = [by_fragdepth.ms(&rig, clock)?, by_copy.ms(&rig, clock)?];
        // The first draw with a pipeline is slow.
        if round > 0 {
            cost.fragdepth_ms.push(ms[0]);
            cost.copy_ms.push(ms[1]);
        }
    }
    Ok(cost)
}
