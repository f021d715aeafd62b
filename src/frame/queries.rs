//! What a frame measures on the device, and the counts of rays left by which the device leaves out the rest of it.

use std::sync::Arc;

use ash::vk;

use super::compile::CompiledStep;
use super::cpu::Counts;
use crate::error::Result;
use crate::part::{Group, TILE};
use crate::scene::Region;
use crate::vulkan::{Buffer, BufferInfo, Commands, Device, Place, QueryKind, QueryPool, Scope};

/// What a run measures, besides its wall and CPU time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    Nothing,
    /// GPU time of every step.
    Times,
    /// Fragments of every step, and invocations with `statistics`.
    Counts {
        statistics: bool,
    },
}

/// One run of a frame.
#[derive(Clone, Debug, Default)]
pub struct FrameRun {
    /// Wall time from the first command recorded to the last result there, milliseconds.
    pub frame_ms: f64,
    /// CPU time of the process meanwhile.
    pub cpu_ms: f64,
    /// CPU time of this thread for recording and submitting.
    pub record_ms: f64,
    /// GPU time from the first step's begin to the last one's end, and of each step that ran.
    pub gpu_total_ms: Option<f64>,
    pub step_ms: Vec<(Group, u32, f64)>,
    pub fragments: Option<Counts>,
    pub invocations: Option<Counts>,
}

/// The queries of a frame, one of each kind a step.
pub struct FrameQueries {
    device: Arc<Device>,
    steps: u32,
    /// N, main passes.
    passes: u32,
    occlusion: QueryPool,
    statistics: Option<QueryPool>,
    timestamps: Option<QueryPool>,
    /// One 32-bit count for every time the rays left are counted.
    predicates: Option<Buffer>,
}

impl FrameQueries {
    /// Queries for that many steps and main passes; the device itself acts on so many counts of rays left.
    ///
    /// # Errors
    /// What the driver reports.
    pub fn new(device: &Arc<Device>, steps: usize, passes: u32, predicates: usize) -> Result<Self> {
        let steps = steps.max(1) as u32;
        let pool = |name, kind, count| QueryPool::new(device, name, kind, count);
        let statistics = device.info.pipeline_statistics;
        let timed = device.graphics.timestamp_valid_bits > 0;
        let counts = BufferInfo {
            name: "rays_left".to_owned(),
            size: 4 * predicates as u64,
            usage: vk::BufferUsageFlags::CONDITIONAL_RENDERING_EXT | vk::BufferUsageFlags::TRANSFER_DST,
            place: Place::Device,
        };
        Ok(Self {
            device: device.clone(),
            steps,
            passes,
            occlusion: pool("fragments", QueryKind::Occlusion, steps)?,
            statistics: statistics.then(|| pool("invocations", QueryKind::Statistics, steps)).transpose()?,
            timestamps: timed.then(|| pool("times", QueryKind::Timestamp, 2 * steps)).transpose()?,
            predicates: (predicates > 0).then(|| Buffer::new(device, counts)).transpose()?,
        })
    }

    /// Before the first of them is begun.
    pub fn reset(&self, commands: &mut Commands) {
        let steps = self.steps;
        commands.reset_queries(&self.occlusion, 0..steps);
        if let Some(pool) = &self.statistics {
            commands.reset_queries(pool, 0..steps);
        }
        if let Some(pool) = &self.timestamps {
            commands.reset_queries(pool, 0..2 * steps);
        }
    }

    /// Timestamps, two a step, where the run takes them.
    pub fn times(&self, measure: Measure) -> Option<&QueryPool> {
        self.timestamps.as_ref().filter(|_| measure == Measure::Times)
    }

    /// Counts of shader invocations, where the run takes them.
    pub fn statistics(&self, measure: Measure) -> Option<&QueryPool> {
        self.statistics.as_ref().filter(|_| measure == Measure::Counts { statistics: true })
    }

    /// Counts of fragments.
    pub fn occlusion(&self) -> &QueryPool {
        &self.occlusion
    }

    /// Counts of rays left, where the device acts on them.
    pub fn predicates(&self) -> Option<&Buffer> {
        self.predicates.as_ref()
    }

    /// Fragments of step `i`.
    ///
    /// # Errors
    /// What the driver reports.
    pub fn fragments(&self, i: usize) -> Result<u64> {
        Ok(self.occlusion.read(i as u32..i as u32 + 1)?[0])
    }

    /// Hands the count of rays left to the draws that follow.
    pub fn record_rays_left(&self, commands: &mut Commands, i: usize, at: usize) {
        let Some(buffer) = &self.predicates else { return };
        commands.copy_query_results(&self.occlusion, i as u32, buffer, 4 * at as u64);
        commands.buffer_barrier(
            buffer,
            Scope::new(vk::PipelineStageFlags2::COPY, vk::AccessFlags2::TRANSFER_WRITE),
            Scope::new(
                vk::PipelineStageFlags2::CONDITIONAL_RENDERING_EXT,
                vk::AccessFlags2::CONDITIONAL_RENDERING_READ_EXT,
            ),
        );
    }

    /// Reads what was measured of the steps that ran, over the pixels of `region`.
    ///
    /// # Errors
    /// What the driver reports.
    pub fn collect(&self, measure: Measure, steps: &[CompiledStep], region: Region, run: &mut FrameRun) -> Result<()> {
        let done = steps.len();
        match measure {
            Measure::Nothing => {}
            Measure::Times => {
                let Some(pool) = &self.timestamps else { return Ok(()) };
                let ticks = pool.read(0..2 * done as u32)?;
                let ms = |a: usize, b: usize| self.device.elapsed_ms(ticks[a], ticks[b]);
                run.gpu_total_ms = Some(ms(0, 2 * done - 1));
                let each = |(i, s): (usize, &CompiledStep)| (s.step.group, s.step.pass, ms(2 * i, 2 * i + 1));
                run.step_ms = steps.iter().enumerate().map(each).collect();
            }
            Measure::Counts { statistics } => {
                run.fragments = Some(self.counts(&self.occlusion, steps, region.pixels())?);
                if let Some(pool) = self.statistics.as_ref().filter(|_| statistics) {
                    run.invocations = Some(self.counts(pool, steps, tiled(region))?);
                }
            }
        }
        Ok(())
    }

    /// What each step counted; of compute shaders, which no such query counts, what they were `dispatched` for.
    fn counts(&self, pool: &QueryPool, steps: &[CompiledStep], dispatched: u64) -> Result<Counts> {
        let mut counts = Counts::new(self.passes);
        let mut counted = Vec::new();
        for (i, compiled) in steps.iter().enumerate() {
            if compiled.step.group.counts() {
                counted.push(self.fragments(i)?);
            }
            let left_out = compiled.step.guard.is_some_and(|guard| counted.get(guard as usize) == Some(&0));
            let fragments = match compiled.step.group {
                _ if compiled.pixels.is_some() => {
                    if left_out {
                        0
                    } else {
                        dispatched
                    }
                }
                Group::Main | Group::Intermediate | Group::Light | Group::Blend => {
                    pool.read(i as u32..i as u32 + 1)?[0]
                }
                _ => 0,
            };
            counts.add(&compiled.step, fragments);
        }
        Ok(counts)
    }
}

/// Invocations of a compute shader over all pixels of a region, those of tiles that reach beyond it included.
fn tiled(region: Region) -> u64 {
    region.size().into_iter().map(|side| u64::from(side.next_multiple_of(TILE))).product()
}
