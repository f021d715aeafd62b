//! Runs a plan on the device: the heart of the program.
//!
//! A frame is recorded step by step; around each stand its label, its queries and its timestamps. Every few main
//! passes the rays left are counted, and when none is left the rest is not run: by conditional rendering where
//! the driver has it, by reading the count back between batches where not.

use std::ops::Range;
use std::sync::Arc;
use std::time::{Duration, Instant};

use ash::vk;
use cpu_time::{ProcessTime, ThreadTime};

use super::compile::{Compiled, CompiledStep, compile};
use super::object::DeviceObject;
use super::queries::{FrameQueries, FrameRun, Measure};
use super::resident::Resident;
use crate::error::Result;
use crate::part::resource::Resource;
use crate::part::{Draw, Group, TILE, Work};
use crate::plan::Plan;
use crate::resource;
use crate::scene::{Region, Scene};
use crate::shared;
use crate::vulkan::{Commands, CopyRegion, Device, Queue, Scope, Watch, texel_bytes};

/// How the rest of a frame is left out when no ray is left.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EarlyEnd {
    /// The device skips the draws itself.
    Conditional,
    /// The host reads the count between batches.
    ReadBack,
    /// Not at all: every pass runs, as in the papers, and rays are not counted.
    Never,
}

/// A plan, compiled for a device.
pub struct GpuFrame {
    device: Arc<Device>,
    compiled: Compiled,
    size: [u32; 2],
    early_end: EarlyEnd,
    /// Of an effect, which may never end.
    watch: Option<Watch>,
    queries: FrameQueries,
    step_names: Arc<[String]>,
    /// Where RES was left by the last run.
    accumulated_layout: vk::ImageLayout,
}

/// How long a frame may take whose effect may never end.
fn watch(scene: &Scene) -> Option<Watch> {
    let (effect, limit) = (scene.effect.as_ref()?, scene.settings.effects.limit);
    let remedy = format!(
        "look for a loop without an end in the effect {}, or raise effects.limit (--effect-limit) where its frames take longer than {limit} s",
        effect.name
    );
    Some(Watch { limit: Duration::from_secs_f64(limit), remedy })
}

/// Whether a step hangs on one that counted nothing, as far as that is known.
fn ended(step: &CompiledStep, counted: &[u64]) -> bool {
    step.step.guard.is_some_and(|guard| counted.get(guard as usize) == Some(&0))
}

impl GpuFrame {
    /// Compiles `plan`. `early_end` is the device's best unless given.
    ///
    /// # Errors
    /// See [`compile`].
    pub fn new(
        device: &Arc<Device>,
        scene: &Scene,
        plan: &Plan,
        resident: &mut Resident,
        early_end: Option<EarlyEnd>,
    ) -> Result<Self> {
        let best = if device.info.conditional_rendering { EarlyEnd::Conditional } else { EarlyEnd::ReadBack };
        let early_end = early_end.unwrap_or(best);
        let mut plan = plan.clone();
        plan.steps.retain(|step| step.group != Group::Alive || early_end != EarlyEnd::Never);
        let compiled = compile(device, scene, &plan, resident)?;
        let counting = compiled.steps.iter().filter(|s| s.step.group.counts()).count();
        let predicates = if early_end == EarlyEnd::Conditional { counting } else { 0 };
        Ok(Self {
            device: device.clone(),
            size: plan.view.size,
            early_end,
            watch: watch(scene),
            queries: FrameQueries::new(device, compiled.steps.len(), plan.passes, predicates)?,
            step_names: compiled.steps.iter().map(|s| s.step.name.clone()).collect(),
            accumulated_layout: vk::ImageLayout::UNDEFINED,
            compiled,
        })
    }

    /// Bytes of each target and buffer of the frame.
    pub fn bytes(&self) -> Vec<(Resource, u64)> {
        let targets = self.compiled.targets.iter().map(|(r, i)| (*r, i.bytes()));
        let buffer = self.compiled.marks_buffer.iter().map(|b| (resource::MARKS_BUFFER, b.bytes()));
        targets.chain(buffer).collect()
    }

    /// Runs the frame once and waits for it.
    ///
    /// # Errors
    /// What the driver reports; a lost device, or a frame that takes longer than an effect may, names the last step begun.
    pub fn run(&mut self, measure: Measure) -> Result<FrameRun> {
        self.device.watch(self.watch.clone());
        let run = self.run_batches(measure);
        self.device.watch(None);
        run
    }

    fn run_batches(&mut self, measure: Measure) -> Result<FrameRun> {
        let (wall, cpu) = (Instant::now(), ProcessTime::now());
        self.device.set_step_names(self.step_names.clone());
        let mut run = FrameRun::default();
        let mut done = 0;
        let mut counted = Vec::new();
        for batch in self.batches() {
            // Nothing of it nor of what follows has anything to do.
            if self.compiled.steps[batch.start..].iter().all(|s| ended(s, &counted)) {
                break;
            }
            done = batch.end;
            run.record_ms += self.run_batch(batch, measure, &counted)?;
            if self.early_end == EarlyEnd::ReadBack && self.compiled.steps[done - 1].step.group.counts() {
                counted.push(self.queries.fragments(done - 1)?);
            }
        }
        run.cpu_ms = cpu.elapsed().as_secs_f64() * 1e3;
        run.frame_ms = wall.elapsed().as_secs_f64() * 1e3;
        if let Some(last) = done.checked_sub(1) {
            self.accumulated_layout = self.compiled.steps[last].accumulated_layout.unwrap_or_default();
            self.queries.collect(measure, &self.compiled.steps[..done], self.compiled.region, &mut run)?;
        }
        Ok(run)
    }

    /// The queue that a step runs on: that of compute work for compute shaders, unless their steps could not be timed there.
    fn queue(&self, step: &CompiledStep) -> &Queue {
        let (graphics, compute) = (&self.device.graphics, &self.device.compute);
        let timed = compute.timestamp_valid_bits > 0 || graphics.timestamp_valid_bits == 0;
        if step.pixels.is_some() && timed { compute } else { graphics }
    }

    /// The steps that are submitted together: all of them, or up to each count of rays, and to each change of queues.
    fn batches(&self) -> Vec<Range<usize>> {
        let steps = &self.compiled.steps;
        let mut ends: Vec<usize> = match self.early_end {
            EarlyEnd::Conditional | EarlyEnd::Never => Vec::new(),
            EarlyEnd::ReadBack => {
                let counts = |(i, s): (usize, &CompiledStep)| s.step.group.counts().then_some(i + 1);
                steps.iter().enumerate().filter_map(counts).collect()
            }
        };
        if self.device.separate_compute() {
            let changes = |i: &usize| steps[*i - 1].pixels.is_some() != steps[*i].pixels.is_some();
            ends.extend((1..steps.len()).filter(changes));
        }
        ends.push(steps.len());
        ends.sort_unstable();
        ends.dedup();
        let begins = std::iter::once(0).chain(ends.iter().copied());
        begins.zip(ends.iter().copied()).map(|(a, b)| a..b).filter(|r| !r.is_empty()).collect()
    }

    /// Records and submits a batch and waits for it; the CPU time of recording and submitting, milliseconds. `counted`: what
    /// counting steps before it counted, where the host knows.
    fn run_batch(&mut self, batch: Range<usize>, measure: Measure, counted: &[u64]) -> Result<f64> {
        let begin = ThreadTime::now();
        let queue = self.queue(&self.compiled.steps[batch.start]);
        let mut commands = Commands::begin(&self.device, queue, "frame")?;
        if batch.start == 0 {
            self.queries.reset(&mut commands);
        }
        let steps = &self.compiled.steps;
        let mut counting = steps[..batch.start].iter().filter(|s| s.step.group.counts()).count();
        for i in batch {
            self.record(&mut commands, i, measure, ended(&steps[i], counted));
            if steps[i].step.group.counts() {
                self.queries.record_rays_left(&mut commands, i, counting);
                counting += 1;
            }
        }
        let recorded = commands.finish()?;
        let submitted = queue.submit(&recorded, &[])?;
        let ms = begin.elapsed().as_secs_f64() * 1e3;
        submitted.wait()?;
        Ok(ms)
    }

    /// Step `i`; of one that has `ended` the attachments alone.
    fn record(&self, commands: &mut Commands, i: usize, measure: Measure, ended: bool) {
        let compiled = &self.compiled.steps[i];
        let step = &compiled.step;
        commands.label_begin(&step.name);
        commands.step(i as u32);
        let times = self.queries.times(measure);
        if let Some(pool) = times {
            commands.timestamp(pool, 2 * i as u32);
        }
        for barrier in &compiled.barriers {
            let image = &self.compiled.targets[&barrier.resource];
            commands.image_barrier(image, barrier.source, barrier.target, barrier.before, barrier.after);
        }
        match &step.work {
            Work::Draw(draw) => self.record_draw(commands, i, draw, measure, ended),
            Work::Copy { from, to, .. } => self.record_copy(commands, *from, *to, &compiled.parts),
            Work::Clear(resource) => {
                commands.clear_color(&self.compiled.targets[resource]);
            }
            Work::Pixels(_) => self.record_pixels(commands, i, ended),
            // They run before frames.
            Work::Dispatch(_) | Work::Unpack { .. } | Work::Host(_) => {}
        }
        if let Some(pool) = times {
            commands.timestamp(pool, 2 * i as u32 + 1);
        }
        commands.label_end();
    }

    fn record_draw(&self, commands: &mut Commands, i: usize, draw: &Draw, measure: Measure, ended: bool) {
        let compiled = &self.compiled.steps[i];
        let Some(objects) = &compiled.draw else { return };
        let area = self.area();
        let counting = matches!(measure, Measure::Counts { .. }) || compiled.step.group.counts();
        let statistics = self.queries.statistics(measure);
        commands.begin_render_pass(&objects.render_pass, &objects.framebuffer, area, &objects.clears);
        commands.bind_graphics(&objects.pipeline, &objects.set);
        // One depth for the whole box, to the bit, or the matrix of a shell.
        commands.viewport(self.full_area(), draw.depths);
        if draw.test.bounds {
            commands.depth_bounds(draw.least, draw.bound);
        }
        let push = shared::PushStep { bound: draw.bound, pass: compiled.step.pass };
        if objects.pipeline.layout.push_constants > 0 {
            commands.push(&objects.pipeline.layout, bytemuck::bytes_of(&push));
        }
        let own = self.compiled.own.get(&draw.vertices).and_then(DeviceObject::buffer);
        if let Some(vertices) = own.or_else(|| self.compiled.vertices.get(&draw.vertices)) {
            commands.vertices(vertices);
            if let Some(offset) = objects.numbers {
                commands.numbers(vertices, offset);
            }
        }
        if let Some(pool) = statistics {
            commands.begin_query(pool, i as u32);
        }
        if counting {
            commands.begin_query(self.queries.occlusion(), i as u32);
        }
        let conditional = self.queries.predicates().zip(compiled.step.guard);
        if let Some((buffer, at)) = conditional {
            commands.begin_conditional(buffer, 4 * u64::from(at));
        }
        let (first, count) = (objects.corners.start, objects.corners.len() as u32);
        for part in compiled.parts.iter().filter(|_| !ended) {
            commands.scissor(rectangle(*part));
            match objects.numbers {
                Some(_) => commands.draw_numbered(first, count),
                None => commands.draw(first, count),
            }
        }
        if conditional.is_some() {
            commands.end_conditional();
        }
        if counting {
            commands.end_query(self.queries.occlusion(), i as u32);
        }
        if let Some(pool) = statistics {
            commands.end_query(pool, i as u32);
        }
        commands.end_render_pass();
    }

    /// A compute shader over the pixels of the targets.
    fn record_pixels(&self, commands: &mut Commands, i: usize, ended: bool) {
        let compiled = &self.compiled.steps[i];
        let Some(objects) = compiled.pixels.as_ref().filter(|_| !ended) else { return };
        commands.bind_compute(&objects.pipeline, &objects.set);
        let conditional = self.queries.predicates().zip(compiled.step.guard);
        if let Some((buffer, at)) = conditional {
            commands.begin_conditional(buffer, 4 * u64::from(at));
        }
        let [x, y] = self.compiled.region.size().map(|side| side.div_ceil(TILE));
        commands.dispatch([x, y, 1]);
        if conditional.is_some() {
            commands.end_conditional();
        }
    }

    /// Rectangles of colour to depth, by way of the buffer.
    fn record_copy(&self, commands: &mut Commands, from: Resource, to: Resource, parts: &[Region]) {
        let Some(buffer) = self.compiled.marks_buffer.as_ref().and_then(DeviceObject::buffer) else { return };
        let write = Scope::new(vk::PipelineStageFlags2::COPY, vk::AccessFlags2::TRANSFER_WRITE);
        let read = Scope::new(vk::PipelineStageFlags2::COPY, vk::AccessFlags2::TRANSFER_READ);
        let (from, to) = (&self.compiled.targets[&from], &self.compiled.targets[&to]);
        let width = self.compiled.region.width;
        let texel = texel_bytes(from.info.format).unwrap_or_default();
        let texels = |part: &Region| CopyRegion {
            buffer_offset: texel * (u64::from(part.y) * u64::from(width) + u64::from(part.x)),
            image_offset: [part.x, part.y, 0],
            extent: [part.width, part.height, 1],
            row: width,
        };
        commands.buffer_barrier(buffer, read, write);
        parts.iter().for_each(|part| commands.copy_image_to_buffer(from, buffer, texels(part)));
        commands.buffer_barrier(buffer, write, read);
        parts.iter().for_each(|part| commands.copy_buffer_to_image(buffer, to, texels(part)));
    }

    /// RES as the last run left it: premultiplied RGBA, row 0 on top, transparent where the box is not.
    ///
    /// # Errors
    /// What the driver reports.
    pub fn picture(&mut self) -> Result<Vec<[f32; 4]>> {
        let [width, height] = self.size.map(|n| n as usize);
        let mut pixels = vec![[0.0f32; 4]; width * height];
        let Some(image) = self.compiled.targets.get(&resource::ACCUMULATED) else { return Ok(pixels) };
        let (texels, format) =
            super::upload::read_back(&self.device, image, CopyRegion::whole(image), self.accumulated_layout)?;
        self.accumulated_layout = vk::ImageLayout::TRANSFER_SRC_OPTIMAL;
        let region = self.compiled.region;
        let decoded = super::upload::decode_rgba(&texels, format);
        for (row, line) in decoded.chunks_exact(region.width as usize).enumerate() {
            let begin = (region.y as usize + row) * width + region.x as usize;
            pixels[begin..begin + line.len()].copy_from_slice(line);
        }
        Ok(pixels)
    }

    fn area(&self) -> vk::Rect2D {
        rectangle(self.whole())
    }

    /// The targets, from their first pixel.
    fn whole(&self) -> Region {
        Region { x: 0, y: 0, ..self.compiled.region }
    }

    /// The whole picture, of which the targets are a part.
    fn full_area(&self) -> vk::Rect2D {
        let ([width, height], region) = (self.size, self.compiled.region);
        // Sides are checked against the device's limits, far below 2^31.
        let offset = vk::Offset2D { x: -(region.x as i32), y: -(region.y as i32) };
        vk::Rect2D { offset, extent: vk::Extent2D { width, height } }
    }
}

fn rectangle(Region { x, y, width, height }: Region) -> vk::Rect2D {
    // Sides are checked against the device's limits, far below 2^31.
    vk::Rect2D { offset: vk::Offset2D { x: x as i32, y: y as i32 }, extent: vk::Extent2D { width, height } }
}
