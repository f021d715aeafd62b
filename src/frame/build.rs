//! Runs the compute steps of a structure's build on the compute queue, slice by slice: all at once, or a few between
//! frames. A slice is short, so that no watchdog ends it and no frame waits long for one.

use std::sync::Arc;

use ash::vk;

use super::pipelines::Pipelines;
use crate::error::Result;
use crate::part::access::Usage;
use crate::part::resource::Resource;
use crate::part::{Dispatch, Step, Work};
use crate::shared::Slice;
use crate::vulkan::{
    Bound, Buffer, Commands, ComputePipeline, CopyRegion, DescriptorSet, Device, Image, QueryKind, QueryPool, Recorded,
    Sampler, Scope, Submission,
};

/// Cells that the dispatches of a slice go through, some ten milliseconds on a slow device.
const SLICE_CELLS: u64 = 1 << 24;

/// Invocations of a work group, as in `glsl/shared/slice.glsl`.
const GROUP: u32 = 64;

/// Work groups of a dispatch that every device allows.
const GROUPS: u32 = 65_535;

const COMPUTE: Scope = Scope::new(
    vk::PipelineStageFlags2::COMPUTE_SHADER,
    vk::AccessFlags2::from_raw(vk::AccessFlags2::SHADER_READ.as_raw() | vk::AccessFlags2::SHADER_WRITE.as_raw()),
);
const COPY_READ: Scope = Scope::new(vk::PipelineStageFlags2::COPY, vk::AccessFlags2::TRANSFER_READ);
const COPY_WRITE: Scope = Scope::new(vk::PipelineStageFlags2::COPY, vk::AccessFlags2::TRANSFER_WRITE);
const SAMPLED: vk::ImageLayout = vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL;

/// What a resource of a build is on the device.
#[derive(Clone, Copy)]
pub enum Bindable<'a> {
    /// Read texel by texel.
    Image(&'a Image),
    Storage(&'a Buffer),
    Uniform(&'a Buffer),
}

/// Steps of a build, recorded; run as far as they were asked for.
pub struct Job {
    device: Arc<Device>,
    slices: Vec<Recorded>,
    next: usize,
    last: Option<Submission>,
    times: Option<QueryPool>,
}

/// Writes the slices one after another.
struct Recorder<'a> {
    device: &'a Arc<Device>,
    name: &'a str,
    commands: Option<Commands>,
    cells: u64,
    slices: Vec<Recorded>,
}

impl Job {
    /// Records `steps`, which find what they read and write by `given`.
    ///
    /// # Errors
    /// A resource that is not given, a shader that is not there, too little memory.
    pub fn new<'a>(
        device: &Arc<Device>,
        name: &str,
        steps: &[Step],
        pipelines: &mut Pipelines,
        given: &dyn Fn(Resource) -> Option<Bindable<'a>>,
    ) -> Result<Self> {
        pipelines.prepare(steps)?;
        let mut recorder = Recorder { device, name, commands: None, cells: 0, slices: Vec::new() };
        let sampler = Sampler::new(device, "nearest", false)?;
        let timed = device.compute.timestamp_valid_bits > 0 && device.info.timestamp_valid_bits > 0;
        let times = if timed { Some(QueryPool::new(device, name, QueryKind::Timestamp, 2)?) } else { None };
        if let Some(times) = &times {
            let commands = recorder.commands()?;
            commands.reset_queries(times, 0..2);
            commands.timestamp(times, 0);
        }
        for step in steps {
            match &step.work {
                Work::Dispatch(dispatch) => {
                    let pipeline = pipelines.compute(&dispatch.shader, &dispatch.constants, &step.name)?;
                    let bound: Vec<(&str, Bound)> = dispatch
                        .bound
                        .iter()
                        .filter_map(|(name, resource)| {
                            Some(match given(*resource)? {
                                Bindable::Image(image) => (*name, Bound::Sampled(image, &sampler, SAMPLED)),
                                Bindable::Storage(buffer) => (*name, Bound::Storage(buffer)),
                                Bindable::Uniform(buffer) => (*name, Bound::Uniform(buffer)),
                            })
                        })
                        .collect();
                    let set = DescriptorSet::new(device, &step.name, &pipeline.layout, &bound)?;
                    recorder.barriers(step, given)?;
                    recorder.dispatch(step, dispatch, &pipeline, &set)?;
                }
                Work::Unpack { from, to } => {
                    if let (Some(Bindable::Storage(bytes)), Some(Bindable::Image(image))) = (given(*from), given(*to)) {
                        recorder.unpack(step, bytes, image)?;
                    }
                }
                _ => {}
            }
        }
        if let Some(times) = &times {
            recorder.commands()?.timestamp(times, 1);
        }
        recorder.end_slice()?;
        Ok(Self { device: device.clone(), slices: recorder.slices, next: 0, last: None, times })
    }

    /// Slices in all.
    pub fn slices(&self) -> usize {
        self.slices.len()
    }

    /// Submits up to `count` further slices; the first of a job after `after`.
    ///
    /// # Errors
    /// What the driver reports.
    pub fn advance(&mut self, count: usize, after: &[&Submission]) -> Result<()> {
        let end = self.slices.len().min(self.next.saturating_add(count));
        for slice in &self.slices[self.next..end] {
            let waits = if self.last.is_none() { after } else { &[] };
            self.last = Some(self.device.compute.submit(slice, waits)?);
        }
        self.next = end;
        Ok(())
    }

    /// Whether all of it has run; waits for nothing.
    ///
    /// # Errors
    /// A lost device.
    pub fn finished(&self) -> Result<bool> {
        let all = self.next == self.slices.len();
        self.last.as_ref().map_or(Ok(true), Submission::reached).map(|reached| all && reached)
    }

    /// Runs what is left and waits for the end.
    ///
    /// # Errors
    /// What the driver reports.
    pub fn run(&mut self, after: &[&Submission]) -> Result<()> {
        self.advance(usize::MAX, after)?;
        self.last.as_ref().map_or(Ok(()), Submission::wait)
    }

    /// The end of what was submitted.
    pub fn last(&self) -> Option<&Submission> {
        self.last.as_ref()
    }

    /// Device time from the first step to the last, milliseconds, once finished; none without timestamps.
    ///
    /// # Errors
    /// What the driver reports.
    pub fn device_ms(&self) -> Result<Option<f64>> {
        let Some(times) = &self.times else { return Ok(None) };
        let ticks = times.read(0..2)?;
        Ok(Some(self.device.elapsed_ms(ticks[0], ticks[1])))
    }
}

impl Recorder<'_> {
    fn commands(&mut self) -> Result<&mut Commands> {
        let commands = match self.commands.take() {
            Some(commands) => commands,
            None => Commands::begin(self.device, &self.device.compute, self.name)?,
        };
        Ok(self.commands.insert(commands))
    }

    fn end_slice(&mut self) -> Result<()> {
        if let Some(commands) = self.commands.take() {
            self.slices.push(commands.finish()?);
        }
        self.cells = 0;
        Ok(())
    }

    /// What the step reads was written by the steps before it, and what it writes was read there.
    fn barriers<'a>(&mut self, step: &Step, given: &dyn Fn(Resource) -> Option<Bindable<'a>>) -> Result<()> {
        let commands = self.commands()?;
        let mut seen = Vec::new();
        for access in step.accesses.iter().filter(|a| matches!(a.usage, Usage::ComputeRead | Usage::ComputeWrite)) {
            if let Some(Bindable::Storage(buffer)) = given(access.resource)
                && !seen.contains(&access.resource)
            {
                commands.buffer_barrier(buffer, COMPUTE, COMPUTE);
                seen.push(access.resource);
            }
        }
        Ok(())
    }

    fn dispatch(
        &mut self,
        step: &Step,
        dispatch: &Dispatch,
        pipeline: &ComputePipeline,
        set: &DescriptorSet,
    ) -> Result<()> {
        let end = dispatch.slice.end;
        let each = u64::from(dispatch.cells.max(1));
        let most = (SLICE_CELLS / each).clamp(u64::from(GROUP), u64::from(GROUPS * GROUP)) as u32 / GROUP * GROUP;
        let mut first = 0;
        while first < end {
            let here = Slice { first, end: end.min(first.saturating_add(most)), ..dispatch.slice };
            let commands = self.commands()?;
            commands.label_begin(&step.name);
            commands.bind_compute(pipeline, set);
            commands.push(&pipeline.layout, bytemuck::bytes_of(&here));
            commands.dispatch([(here.end - first).div_ceil(GROUP), 1, 1]);
            commands.label_end();
            self.cells += u64::from(here.end - first) * each;
            if self.cells >= SLICE_CELLS {
                self.end_slice()?;
            }
            first = here.end;
        }
        Ok(())
    }

    /// Packed distances to the texture, which then goes to the graphics queue.
    fn unpack(&mut self, step: &Step, bytes: &Buffer, image: &Image) -> Result<()> {
        let graphics = &self.device.graphics;
        let row = if image.info.format == vk::Format::R8_UINT { image.info.extent[0].next_multiple_of(4) } else { 0 };
        let target = vk::ImageLayout::TRANSFER_DST_OPTIMAL;
        let commands = self.commands()?;
        commands.label_begin(&step.name);
        commands.buffer_barrier(bytes, COMPUTE, COPY_READ);
        commands.image_barrier(image, Scope::NONE, COPY_WRITE, vk::ImageLayout::UNDEFINED, target);
        commands.copy_buffer_to_image(bytes, image, CopyRegion { row, ..CopyRegion::whole(image) });
        commands.image_release(image, COPY_WRITE, target, SAMPLED, graphics);
        commands.label_end();
        Ok(())
    }
}

/// Takes an image that a job has released, for the graphics queue's frames.
///
/// # Errors
/// What the driver reports.
pub fn acquire(device: &Arc<Device>, image: &Image, built: &Submission) -> Result<()> {
    let (stages, access) = Usage::Sampled.scope();
    let mut commands = Commands::begin(device, &device.graphics, "structure to graphics")?;
    commands.image_acquire(
        image,
        Scope { stages, access },
        vk::ImageLayout::TRANSFER_DST_OPTIMAL,
        SAMPLED,
        &device.compute,
    );
    device.graphics.submit(&commands.finish()?, &[built])?.wait()
}
