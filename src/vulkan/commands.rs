//! Recording: passes, draws, dispatches, queries.

use std::collections::HashMap;
use std::ops::Range;
use std::sync::Arc;

use ash::vk;

use super::buffer::Buffer;
use super::descriptor::DescriptorSet;
use super::device::{Device, c_text};
use super::failure::misuse;
use super::layout::Layout;
use super::owned::{Kept, Owned};
use super::pipeline::{ComputePipeline, GraphicsPipeline};
use super::query::{QueryKind, QueryPool};
use super::queue::Queue;
use super::recorded::Recorded;
use super::render_pass::{Framebuffer, RenderPass};
use crate::error::{Error, Result};

/// A command buffer that is being recorded. The first misuse ends in the error of [`Commands::finish`].
pub struct Commands {
    pub name: String,
    pub(super) device: Arc<Device>,
    pub(super) raw: vk::CommandBuffer,
    pub(super) family: u32,
    slot: u32,
    has_timestamps: bool,
    pub(super) pool: Arc<Owned<vk::CommandPool>>,
    /// What the commands use, by address.
    pub(super) kept: HashMap<usize, Kept>,
    fault: Option<Error>,
}

impl Commands {
    /// Begins a recording for queues of the family of `queue`.
    pub fn begin(device: &Arc<Device>, queue: &Queue, name: &str) -> Result<Self> {
        let create = vk::CommandPoolCreateInfo::default().queue_family_index(queue.family);
        // SAFETY: the family is one the device was made with.
        let pool = unsafe { device.raw.create_command_pool(&create, None) };
        let pool = device.check("vkCreateCommandPool", name, pool)?;
        device.name(pool, name);
        // SAFETY of the destroyer: called once, when no submission of the buffer is pending; it goes with its pool.
        let pool = Owned::new(device, pool, |device, raw| unsafe { device.destroy_command_pool(raw, None) });
        let allocate = vk::CommandBufferAllocateInfo::default().command_pool(pool.raw).command_buffer_count(1);
        // SAFETY: the pool is used by this thread only.
        let raw = unsafe { device.raw.allocate_command_buffers(&allocate) };
        let raw = device.check("vkAllocateCommandBuffers", name, raw)?[0];
        device.name(raw, name);
        // SAFETY: the buffer is new.
        let begun = unsafe { device.raw.begin_command_buffer(raw, &vk::CommandBufferBeginInfo::default()) };
        device.check("vkBeginCommandBuffer", name, begun)?;
        Ok(Self {
            name: name.into(),
            device: device.clone(),
            raw,
            family: queue.family,
            slot: queue.slot,
            has_timestamps: queue.timestamp_valid_bits > 0,
            pool,
            kept: HashMap::new(),
            fault: None,
        })
    }

    /// Ends the recording; the result can be submitted again and again. What it writes, the host sees once its
    /// submission has ended: a wait alone does not promise that.
    ///
    /// # Errors
    /// The first misuse that was recorded, or too little memory.
    pub fn finish(self) -> Result<Recorded> {
        if let Some(fault) = self.fault {
            return Err(fault);
        }
        let barrier = [vk::MemoryBarrier2::default()
            .src_stage_mask(vk::PipelineStageFlags2::ALL_COMMANDS)
            .src_access_mask(vk::AccessFlags2::MEMORY_WRITE)
            .dst_stage_mask(vk::PipelineStageFlags2::HOST)
            .dst_access_mask(vk::AccessFlags2::HOST_READ)];
        let dependency = vk::DependencyInfo::default().memory_barriers(&barrier);
        // SAFETY: the buffer is being recorded, by this thread only.
        let ended = unsafe {
            self.device.raw.cmd_pipeline_barrier2(self.raw, &dependency);
            self.device.raw.end_command_buffer(self.raw)
        };
        self.device.check("vkEndCommandBuffer", &self.name, ended)?;
        let Self { name, device, raw, family, pool, kept, .. } = self;
        Ok(Recorded::new(name, device, raw, family, kept.into_values().chain([pool as Kept])))
    }

    /// `clears`: one for each attachment, up to the last one that is cleared.
    pub fn begin_render_pass(
        &mut self,
        pass: &RenderPass,
        framebuffer: &Framebuffer,
        area: vk::Rect2D,
        clears: &[vk::ClearValue],
    ) {
        let cleared = |one: &super::Attachment| one.load == vk::AttachmentLoadOp::CLEAR;
        let needed = pass.info.attachments.iter().rposition(cleared).map_or(0, |last| last + 1);
        if clears.len() < needed {
            self.misused(&pass.info.name, format!("{} clear values, {needed} are needed", clears.len()));
            return;
        }
        let inside = |offset: i32, side: u32, limit: u32| {
            u32::try_from(offset).ok().and_then(|offset| offset.checked_add(side)).is_some_and(|end| end <= limit)
        };
        let [width, height] = framebuffer.extent;
        if !inside(area.offset.x, area.extent.width, width) || !inside(area.offset.y, area.extent.height, height) {
            self.misused(&pass.info.name, format!("area {area:?} of {width} x {height} pixels"));
            return;
        }
        self.keep(&pass.owned);
        self.keep(&framebuffer.owned);
        framebuffer.images.iter().for_each(|image| self.keep_any(image.clone()));
        let begin = vk::RenderPassBeginInfo::default()
            .render_pass(pass.owned.raw)
            .framebuffer(framebuffer.owned.raw)
            .render_area(area)
            .clear_values(clears);
        let contents = vk::SubpassBeginInfo::default().contents(vk::SubpassContents::INLINE);
        // SAFETY, here and in all commands: the buffer is being recorded by this thread only (`&mut self`), and
        // what the command uses is kept alive until the last submission has ended.
        unsafe { self.device.raw.cmd_begin_render_pass2(self.raw, &begin, &contents) };
    }

    pub fn end_render_pass(&mut self) {
        // SAFETY: as in `begin_render_pass`.
        unsafe { self.device.raw.cmd_end_render_pass2(self.raw, &vk::SubpassEndInfo::default()) };
    }

    pub fn bind_graphics(&mut self, pipeline: &GraphicsPipeline, set: &DescriptorSet) {
        self.bind(vk::PipelineBindPoint::GRAPHICS, &pipeline.owned, &pipeline.layout, set);
    }

    pub fn bind_compute(&mut self, pipeline: &ComputePipeline, set: &DescriptorSet) {
        self.bind(vk::PipelineBindPoint::COMPUTE, &pipeline.owned, &pipeline.layout, set);
    }

    fn bind(
        &mut self,
        point: vk::PipelineBindPoint,
        pipeline: &Arc<Owned<vk::Pipeline>>,
        layout: &Layout,
        set: &DescriptorSet,
    ) {
        if !set.fits(layout) {
            self.misused(&layout.name, format!("descriptor set {} was made for another layout", set.name));
            return;
        }
        self.keep(pipeline);
        self.keep(&layout.owned);
        // SAFETY: as in `begin_render_pass`.
        unsafe { self.device.raw.cmd_bind_pipeline(self.raw, point, pipeline.raw) };
        if let Some((raw, pool)) = &set.set {
            self.keep(pool);
            set.resources.iter().for_each(|resource| self.keep_any(resource.clone()));
            // SAFETY: as above; the set fits the layout.
            unsafe { self.device.raw.cmd_bind_descriptor_sets(self.raw, point, layout.owned.raw, 0, &[*raw], &[]) };
        }
    }

    /// `depth`: what 0 and 1 in clip space become.
    pub fn viewport(&mut self, area: vk::Rect2D, depth: [f32; 2]) {
        let viewport = vk::Viewport {
            x: area.offset.x as f32,
            y: area.offset.y as f32,
            width: area.extent.width as f32,
            height: area.extent.height as f32,
            min_depth: depth[0],
            max_depth: depth[1],
        };
        // SAFETY: as in `begin_render_pass`.
        unsafe { self.device.raw.cmd_set_viewport(self.raw, 0, &[viewport]) };
    }

    pub fn scissor(&mut self, area: vk::Rect2D) {
        // SAFETY: as in `begin_render_pass`.
        unsafe { self.device.raw.cmd_set_scissor(self.raw, 0, &[area]) };
    }

    /// The range of stored depths whose fragments pass, both ends included.
    pub fn depth_bounds(&mut self, min: f32, max: f32) {
        if !(0.0 <= min && min <= max && max <= 1.0) {
            self.misused(&self.name.clone(), format!("depth bounds {min}..{max}"));
            return;
        }
        // SAFETY: as in `begin_render_pass`; the bounds are in order and in range.
        unsafe { self.device.raw.cmd_set_depth_bounds(self.raw, min, max) };
    }

    /// Sets the push constants; bytes beyond the shaders' block (padding of a Rust struct) are left out.
    pub fn push(&mut self, layout: &Layout, bytes: &[u8]) {
        let size = layout.push_constants as usize;
        let Some(bytes) = bytes.get(..size).filter(|bytes| !bytes.is_empty()) else {
            self.misused(&layout.name, format!("{} bytes of push constants, the shaders take {size}", bytes.len()));
            return;
        };
        self.keep(&layout.owned);
        // SAFETY: as in `begin_render_pass`; the bytes are exactly the layout's only range.
        unsafe { self.device.raw.cmd_push_constants(self.raw, layout.owned.raw, layout.stages, 0, bytes) };
    }

    pub fn vertices(&mut self, buffer: &Buffer) {
        self.keep(&buffer.inner);
        // SAFETY: as in `begin_render_pass`.
        unsafe { self.device.raw.cmd_bind_vertex_buffers(self.raw, 0, &[buffer.handle()], &[0]) };
    }

    /// The numbers of vertices that [`Commands::draw_numbered`] draws, from the byte `offset` of the buffer on.
    pub fn numbers(&mut self, buffer: &Buffer, offset: u64) {
        self.keep(&buffer.inner);
        // SAFETY: as in `begin_render_pass`.
        unsafe { self.device.raw.cmd_bind_index_buffer(self.raw, buffer.handle(), offset, vk::IndexType::UINT32) };
    }

    /// Draws vertices by so many numbers.
    pub fn draw_numbered(&mut self, first: u32, count: u32) {
        // SAFETY: as in `begin_render_pass`.
        unsafe { self.device.raw.cmd_draw_indexed(self.raw, count, 1, first, 0, 0) };
    }

    pub fn draw(&mut self, first: u32, count: u32) {
        // SAFETY: as in `begin_render_pass`.
        unsafe { self.device.raw.cmd_draw(self.raw, count, 1, first, 0) };
    }

    /// `groups`: work groups in x, y and z.
    pub fn dispatch(&mut self, groups: [u32; 3]) {
        let limit = self.device.limits.max_compute_work_group_count;
        if groups.iter().zip(limit).any(|(&groups, limit)| groups > limit) {
            self.misused(&self.name.clone(), format!("{groups:?} work groups, {limit:?} are allowed"));
            return;
        }
        // SAFETY: as in `begin_render_pass`; the counts are within the limits.
        unsafe { self.device.raw.cmd_dispatch(self.raw, groups[0], groups[1], groups[2]) };
    }

    /// Queries have to be reset before each use, outside of render passes.
    pub fn reset_queries(&mut self, pool: &QueryPool, range: Range<u32>) {
        if !self.keep_queries(pool, &range) || range.is_empty() {
            return;
        }
        let count = range.end - range.start;
        // SAFETY: as in `begin_render_pass`; the range is inside the pool.
        unsafe { self.device.raw.cmd_reset_query_pool(self.raw, pool.owned.raw, range.start, count) };
    }

    /// Begins to count, exactly where the device can.
    pub fn begin_query(&mut self, pool: &QueryPool, index: u32) {
        if !self.keep_queries(pool, &(index..index.saturating_add(1))) {
            return;
        }
        let flags = match pool.kind == QueryKind::Occlusion && self.device.info.occlusion_precise {
            true => vk::QueryControlFlags::PRECISE,
            false => vk::QueryControlFlags::empty(),
        };
        // SAFETY: as in `begin_render_pass`; the query is inside the pool, the feature is on.
        unsafe { self.device.raw.cmd_begin_query(self.raw, pool.owned.raw, index, flags) };
    }

    pub fn end_query(&mut self, pool: &QueryPool, index: u32) {
        if self.keep_queries(pool, &(index..index.saturating_add(1))) {
            // SAFETY: as in `begin_query`.
            unsafe { self.device.raw.cmd_end_query(self.raw, pool.owned.raw, index) };
        }
    }

    /// The time when all commands before it have ended.
    pub fn timestamp(&mut self, pool: &QueryPool, index: u32) {
        if !self.has_timestamps {
            self.misused(&pool.name, "the queue has no timestamps");
        } else if self.keep_queries(pool, &(index..index.saturating_add(1))) {
            let stage = vk::PipelineStageFlags2::ALL_COMMANDS;
            // SAFETY: as in `begin_query`; the queue has timestamps.
            unsafe { self.device.raw.cmd_write_timestamp2(self.raw, stage, pool.owned.raw, index) };
        }
    }

    /// Copies one result as 32 bits, when it is there; a predicate for [`Commands::begin_conditional`].
    pub fn copy_query_results(&mut self, pool: &QueryPool, index: u32, buffer: &Buffer, offset: u64) {
        if !self.keep_queries(pool, &(index..index.saturating_add(1))) || !self.fits(buffer, offset, 4) {
            return;
        }
        let (raw, handle) = (pool.owned.raw, buffer.handle());
        // SAFETY: as in `begin_query`; the four bytes are inside the buffer.
        unsafe {
            let flags = vk::QueryResultFlags::WAIT;
            self.device.raw.cmd_copy_query_pool_results(self.raw, raw, index, 1, handle, offset, 4, flags);
        }
    }

    /// Draws and dispatches that follow are left out when the 32-bit word at `offset` is 0.
    pub fn begin_conditional(&mut self, buffer: &Buffer, offset: u64) {
        if !self.fits(buffer, offset, 4) {
            return;
        }
        let Some(extension) = self.device.conditional.clone() else {
            self.misused(&buffer.info.name, format!("{} has no conditional rendering", self.device.info.name));
            return;
        };
        let begin = vk::ConditionalRenderingBeginInfoEXT::default().buffer(buffer.handle()).offset(offset);
        // SAFETY: as in `begin_render_pass`; the extension is on, the word is inside the buffer.
        unsafe { (extension.fp().cmd_begin_conditional_rendering_ext)(self.raw, &begin) };
    }

    pub fn end_conditional(&mut self) {
        if let Some(extension) = &self.device.conditional {
            // SAFETY: as in `begin_conditional`.
            unsafe { (extension.fp().cmd_end_conditional_rendering_ext)(self.raw) };
        }
    }

    /// Groups the commands up to [`Commands::label_end`] under a name, in debuggers and traces ([`Device::begin_trace`]).
    pub fn label_begin(&mut self, name: &str) {
        self.device.trace(name);
        if let Some(debug) = &self.device.debug {
            let name = c_text(name);
            let label = vk::DebugUtilsLabelEXT::default().label_name(&name);
            // SAFETY: as in `begin_render_pass`; the extension is on.
            unsafe { debug.cmd_begin_debug_utils_label(self.raw, &label) };
        }
    }

    pub fn label_end(&mut self) {
        if let Some(debug) = &self.device.debug {
            // SAFETY: as in `label_begin`.
            unsafe { debug.cmd_end_debug_utils_label(self.raw) };
        }
    }

    /// Notes, when all commands before it have ended, that step `number` begins, for the error of a lost device.
    /// Outside of render passes. It keeps steps from overlapping on the device.
    pub fn step(&mut self, number: u32) {
        let barrier = [vk::MemoryBarrier2::default()
            .src_stage_mask(vk::PipelineStageFlags2::ALL_COMMANDS)
            .src_access_mask(vk::AccessFlags2::TRANSFER_WRITE)
            .dst_stage_mask(vk::PipelineStageFlags2::ALL_TRANSFER)
            .dst_access_mask(vk::AccessFlags2::TRANSFER_WRITE)];
        let dependency = vk::DependencyInfo::default().memory_barriers(&barrier);
        let (buffer, offset) = (self.device.marks.buffer, u64::from(self.slot) * 4);
        // SAFETY: as in `begin_render_pass`; the word is inside the device's own buffer.
        unsafe {
            self.device.raw.cmd_pipeline_barrier2(self.raw, &dependency);
            self.device.raw.cmd_fill_buffer(self.raw, buffer, offset, 4, number);
        }
    }

    pub(super) fn keep<T: Send + Sync + 'static>(&mut self, object: &Arc<T>) {
        self.keep_any(object.clone());
    }

    fn keep_any(&mut self, object: Kept) {
        self.kept.insert(Arc::as_ptr(&object).cast::<()>() as usize, object);
    }

    fn keep_queries(&mut self, pool: &QueryPool, range: &Range<u32>) -> bool {
        self.keep(&pool.owned);
        let checked = pool.check(range);
        let inside = checked.is_ok();
        if let Err(fault) = checked {
            self.fault.get_or_insert(fault);
        }
        inside
    }

    /// Keeps the buffer and says whether `size` bytes at `offset` are inside it.
    pub(super) fn fits(&mut self, buffer: &Buffer, offset: u64, size: u64) -> bool {
        self.keep(&buffer.inner);
        let inside = offset.checked_add(size).is_some_and(|end| end <= buffer.info.size);
        if !inside {
            self.misused(&buffer.info.name, format!("{size} bytes at {offset} of {}", buffer.info.size));
        }
        inside
    }

    pub(super) fn misused(&mut self, object: &str, problem: impl ToString) {
        self.fault.get_or_insert_with(|| misuse(object, problem));
    }
}
