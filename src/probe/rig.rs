//! What a case is drawn with on a device: a square picture with its depths, and what is left in it.

use std::sync::Arc;

use ash::vk;

use super::case::{Case, History};
use super::depth::Precision;
use super::pipelines::CasePipelines;
use super::rule::Setup;
use crate::error::Result;
use crate::vulkan::{
    Attachment, Bound, Buffer, BufferInfo, Commands, CopyRegion, Dependency, DescriptorSet, Device, Framebuffer,
    GraphicsPipeline, Image, ImageInfo, ImageShape, Place, QueryKind, QueryPool, RenderPass, RenderPassInfo, Role,
    Sampler, Scope, has_stencil,
};

const COLOR: vk::Format = vk::Format::R32_SFLOAT;
pub(super) const TO: vk::ImageLayout = vk::ImageLayout::TRANSFER_DST_OPTIMAL;
pub(super) const FROM: vk::ImageLayout = vk::ImageLayout::TRANSFER_SRC_OPTIMAL;
const DRAWN: vk::ImageLayout = vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL;
pub(super) const TESTED: vk::ImageLayout = vk::ImageLayout::DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
const READ: vk::ImageLayout = vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL;

/// Everything before and everything after: a probe times whole draws, never what overlaps.
pub(super) const ALL: Scope = Scope::new(
    vk::PipelineStageFlags2::ALL_COMMANDS,
    vk::AccessFlags2::from_raw(vk::AccessFlags2::MEMORY_READ.as_raw() | vk::AccessFlags2::MEMORY_WRITE.as_raw()),
);

/// The same of a render pass.
const GRAPHICS: Scope = Scope::new(vk::PipelineStageFlags2::ALL_GRAPHICS, ALL.access);

/// What a draw begins with: one entry a pixel, row by row.
#[derive(Clone, Debug)]
pub struct Input {
    pub setup: Setup,
    /// Depths that the format can keep.
    pub stored: Vec<f32>,
    /// What the shader writes.
    pub written: Vec<f32>,
    pub stencil: Vec<u8>,
    /// Of [`History::Clear`] the first pixel's depth and stencil are every pixel's.
    pub history: History,
    /// Rounds of work in the shader.
    pub work: u32,
    /// Draws, one over the other.
    pub draws: u32,
}

/// What a draw leaves.
#[derive(Clone, Debug)]
pub struct Left {
    pub color: Vec<f32>,
    /// As the format keeps them, see [`Precision::code`].
    pub depth: Vec<u32>,
    /// Samples the occlusion query counted.
    pub samples: u64,
    /// Pixels whose storage image was written; of a shader that writes one.
    pub touched: Option<Vec<bool>>,
    /// The storage buffer's counter; of a shader that counts.
    pub counted: Option<u32>,
}

/// Images of one format and size, and the pipelines that draw into them.
pub struct Rig {
    device: Arc<Device>,
    pub format: vk::Format,
    pub precision: Precision,
    /// Pixels of a side.
    pub side: u32,
    pub(super) color: Image,
    pub(super) depth: Image,
    stored: Image,
    written: Image,
    touched: Image,
    counter: Buffer,
    upload: Buffer,
    read: Buffer,
    passes: [(RenderPass, Framebuffer); 2],
    sampler: Sampler,
    occlusion: QueryPool,
    pub(super) statistics: Option<QueryPool>,
    pub(super) timestamps: Option<QueryPool>,
    pipelines: Arc<CasePipelines>,
}

/// Where in the upload buffer things stand, in bytes of a pixel: depth, stored, written (4 each), stencil.
const PARTS: u64 = 13;

/// What is asked while a draw is recorded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ask {
    Samples,
    Invocations,
    Time,
}

impl Rig {
    /// Whether a device has all that a rig of that format takes.
    pub fn possible(device: &Device, format: vk::Format) -> bool {
        let needed = vk::FormatFeatureFlags::DEPTH_STENCIL_ATTACHMENT
            | vk::FormatFeatureFlags::TRANSFER_SRC
            | vk::FormatFeatureFlags::TRANSFER_DST;
        device.format_supports(format, needed)
    }

    /// # Errors
    /// What the driver reports.
    pub fn new(device: &Arc<Device>, format: vk::Format, side: u32) -> Result<Self> {
        use vk::ImageUsageFlags as U;
        let image = |name: &str, format, usage| {
            let info = ImageInfo {
                name: format!("probe {name}"),
                extent: [side, side, 1],
                format,
                usage,
                shape: ImageShape::Flat,
                shared: false,
            };
            Image::new(device, info)
        };
        let buffer = |name: &str, size: u64, usage, place| {
            Buffer::new(device, BufferInfo { name: format!("probe {name}"), size, usage, place })
        };
        let pixels = u64::from(side) * u64::from(side);
        let color = image("color", COLOR, U::COLOR_ATTACHMENT | U::TRANSFER_SRC)?;
        let depth = image("depth", format, U::DEPTH_STENCIL_ATTACHMENT | U::TRANSFER_SRC | U::TRANSFER_DST)?;
        let (copied, stored) = (vk::BufferUsageFlags::TRANSFER_DST, vk::BufferUsageFlags::STORAGE_BUFFER);
        let pass = |load| -> Result<(RenderPass, Framebuffer)> {
            let pass = RenderPass::new(device, render_pass(format, load))?;
            let framebuffer = Framebuffer::new(device, "probe", &pass, &[&color, &depth], [side; 2])?;
            Ok((pass, framebuffer))
        };
        let passes = [pass(vk::AttachmentLoadOp::LOAD)?, pass(vk::AttachmentLoadOp::CLEAR)?];
        let query = |kind, count| QueryPool::new(device, "probe", kind, count);
        let (has_statistics, has_time) = (device.info.pipeline_statistics, device.info.timestamp_valid_bits > 0);
        Ok(Self {
            device: device.clone(),
            format,
            precision: Precision::of(format),
            side,
            stored: image("stored", COLOR, U::SAMPLED | U::TRANSFER_DST)?,
            written: image("written", COLOR, U::SAMPLED | U::TRANSFER_DST)?,
            touched: image("touched", vk::Format::R32_UINT, U::STORAGE | U::TRANSFER_SRC | U::TRANSFER_DST)?,
            counter: buffer("counter", 4, stored | copied | vk::BufferUsageFlags::TRANSFER_SRC, Place::Device)?,
            upload: buffer("upload", PARTS * pixels, vk::BufferUsageFlags::TRANSFER_SRC, Place::Upload)?,
            read: buffer("read", 12 * pixels + 4, copied, Place::Readback)?,
            color,
            depth,
            passes,
            sampler: Sampler::new(device, "probe", false)?,
            occlusion: query(QueryKind::Occlusion, 1)?,
            statistics: has_statistics.then(|| query(QueryKind::Statistics, 1)).transpose()?,
            timestamps: has_time.then(|| query(QueryKind::Timestamp, 2)).transpose()?,
            pipelines: Arc::new(CasePipelines::new(device)?),
        })
    }

    /// Another picture of the same format, which shares the pipelines: drivers take long for one.
    ///
    /// # Errors
    /// What the driver reports.
    pub fn beside(&self, side: u32) -> Result<Self> {
        Ok(Self { pipelines: self.pipelines.clone(), ..Self::new(&self.device, self.format, side)? })
    }

    pub fn device(&self) -> &Arc<Device> {
        &self.device
    }

    fn pixels(&self) -> u64 {
        u64::from(self.side) * u64::from(self.side)
    }

    /// Draws once and reads all that is left.
    ///
    /// # Errors
    /// What the driver reports.
    pub fn draw(&mut self, case: &Case, input: &Input) -> Result<Left> {
        self.load(input)?;
        let device = self.device.clone();
        let mut commands = Commands::begin(&device, &device.graphics, &case.name())?;
        self.record(&mut commands, case, input, Ask::Samples)?;
        let pixels = self.pixels();
        let region = |image: &Image, at: u64| CopyRegion { buffer_offset: at * pixels, ..CopyRegion::whole(image) };
        commands.copy_image_to_buffer(&self.color, &self.read, region(&self.color, 0));
        commands.copy_image_to_buffer(&self.depth, &self.read, region(&self.depth, 4));
        commands.image_barrier(&self.touched, ALL, ALL, vk::ImageLayout::GENERAL, FROM);
        commands.copy_image_to_buffer(&self.touched, &self.read, region(&self.touched, 8));
        commands.buffer_barrier(&self.counter, ALL, ALL);
        commands.copy_buffer(&self.counter, 0, &self.read, 12 * pixels, 4);
        self.device.graphics.submit(&commands.finish()?, &[])?.wait()?;
        let bytes = self.read.read()?;
        let (pixels, words) = (pixels as usize, |bytes: &[u8]| bytemuck::pod_collect_to_vec::<u8, u32>(bytes));
        let depth_bytes = pixels * if self.precision == Precision::Unorm(16) { 2 } else { 4 };
        let touched = || words(&bytes[8 * pixels..12 * pixels]).into_iter().map(|word| word != 0).collect();
        Ok(Left {
            color: words(&bytes[..4 * pixels]).into_iter().map(f32::from_bits).collect(),
            depth: self.precision.codes(&bytes[4 * pixels..][..depth_bytes]),
            samples: self.occlusion.read(0..1)?[0],
            touched: case.shader.touches().then(touched),
            counted: case.shader.counts().then(|| words(&bytes[12 * pixels..12 * pixels + 4])[0]),
        })
    }

    /// Brings what the draw begins with to the device.
    pub(super) fn load(&mut self, input: &Input) -> Result<()> {
        let pixels = self.pixels();
        self.upload.write(0, &self.precision.bytes(&input.stored))?;
        self.upload.write(4 * pixels, bytemuck::cast_slice(&input.stored))?;
        self.upload.write(8 * pixels, bytemuck::cast_slice(&input.written))?;
        self.upload.write(12 * pixels, &input.stencil)?;
        let mut commands = Commands::begin(&self.device, &self.device.graphics, "probe input")?;
        for (image, at) in [(&self.stored, 4), (&self.written, 8)] {
            commands.image_barrier(image, ALL, ALL, vk::ImageLayout::UNDEFINED, TO);
            let region = CopyRegion { buffer_offset: at * pixels, ..CopyRegion::whole(image) };
            commands.copy_buffer_to_image(&self.upload, image, region);
            commands.image_barrier(image, ALL, ALL, TO, READ);
        }
        self.device.graphics.submit(&commands.finish()?, &[])?.wait()
    }

    /// Writes a draw, from the stored depths to what is left, and what is asked about it.
    pub(super) fn record(&mut self, commands: &mut Commands, case: &Case, input: &Input, ask: Ask) -> Result<()> {
        // Passes of a rig differ in what they begin with alone.
        let pipeline = self.pipelines.of(Some(case), &self.passes[0].0)?;
        let fill = (input.history == History::Draw).then(|| self.pipelines.of(None, &self.passes[0].0)).transpose()?;
        self.restore(commands, input);
        let pool = match ask {
            Ask::Samples => Some(&self.occlusion),
            Ask::Invocations => self.statistics.as_ref(),
            Ask::Time => self.timestamps.as_ref(),
        };
        if let Some(pool) = pool {
            commands.reset_queries(pool, 0..pool.count);
        }
        let (counted, timed) = match ask {
            Ask::Time => (None, pool),
            _ => (pool, None),
        };
        if let Some(pool) = timed {
            commands.timestamp(pool, 0);
        }
        let area = vk::Rect2D { extent: vk::Extent2D { width: self.side, height: self.side }, ..Default::default() };
        let (pass, framebuffer) = &self.passes[usize::from(input.history != History::Copy)];
        let cleared = if input.history == History::Clear { (input.stored[0], input.stencil[0]) } else { (0.0, 0) };
        let depth = vk::ClearDepthStencilValue { depth: cleared.0, stencil: cleared.1.into() };
        commands.begin_render_pass(
            pass,
            framebuffer,
            area,
            &[vk::ClearValue::default(), vk::ClearValue { depth_stencil: depth }],
        );
        commands.scissor(area);
        if let Some(fill) = &fill {
            let set = self.set(fill)?;
            commands.viewport(area, [0.0, 1.0]);
            commands.bind_graphics(fill, &set);
            commands.draw(0, 3);
        }
        let set = self.set(&pipeline)?;
        commands.viewport(area, [input.setup.drawn; 2]);
        commands.bind_graphics(&pipeline, &set);
        if case.mechanism.bounds() {
            commands.depth_bounds(input.setup.bounds[0], input.setup.bounds[1]);
        }
        let push = [input.setup.bounds[1].to_bits(), input.work];
        commands.push(&pipeline.layout, bytemuck::cast_slice(&push));
        if let Some(pool) = counted {
            commands.begin_query(pool, 0);
        }
        for _ in 0..input.draws {
            commands.draw(0, 3);
        }
        if let Some(pool) = counted {
            commands.end_query(pool, 0);
        }
        commands.end_render_pass();
        Ok(())
    }

    /// Ends what [`Ask::Time`] began.
    pub(super) fn stamp(&self, commands: &mut Commands) {
        if let Some(pool) = &self.timestamps {
            commands.timestamp(pool, 1);
        }
    }

    /// Every image and buffer as it has to be before the pass.
    fn restore(&self, commands: &mut Commands, input: &Input) {
        let nothing = vk::ImageLayout::UNDEFINED;
        if input.history == History::Copy {
            commands.image_barrier(&self.depth, ALL, ALL, nothing, TO);
            commands.copy_buffer_to_image(&self.upload, &self.depth, CopyRegion::whole(&self.depth));
            if has_stencil(self.format) {
                // Aspects share memory, and copies of them are not ordered.
                commands.image_barrier(&self.depth, ALL, ALL, TO, TO);
                let pixels = self.pixels();
                commands.copy_buffer_to_stencil(&self.upload, 12 * pixels, &self.depth);
            }
            commands.image_barrier(&self.depth, ALL, ALL, TO, TESTED);
        } else {
            commands.image_barrier(&self.depth, ALL, ALL, nothing, TESTED);
        }
        commands.image_barrier(&self.color, ALL, ALL, nothing, DRAWN);
        commands.image_barrier(&self.touched, ALL, ALL, nothing, TO);
        commands.clear_color(&self.touched);
        commands.image_barrier(&self.touched, ALL, ALL, TO, vk::ImageLayout::GENERAL);
        commands.fill_buffer(&self.counter, 0, 4, 0);
        commands.buffer_barrier(&self.counter, ALL, ALL);
    }

    fn set(&self, pipeline: &GraphicsPipeline) -> Result<DescriptorSet> {
        let resources = [
            ("stored", Bound::Sampled(&self.stored, &self.sampler, READ)),
            ("written", Bound::Sampled(&self.written, &self.sampler, READ)),
            ("counter", Bound::Storage(&self.counter)),
            ("touched", Bound::StorageImage(&self.touched)),
        ];
        DescriptorSet::new(&self.device, &pipeline.name, &pipeline.layout, &resources)
    }
}

fn render_pass(format: vk::Format, load: vk::AttachmentLoadOp) -> RenderPassInfo {
    let attachment = |name: &str, format, role, load, layout| Attachment {
        name: name.to_owned(),
        format,
        role,
        load,
        store: vk::AttachmentStoreOp::STORE,
        before: layout,
        during: layout,
        after: FROM,
    };
    RenderPassInfo {
        name: "probe".to_owned(),
        attachments: vec![
            attachment("color", COLOR, Role::Color, vk::AttachmentLoadOp::CLEAR, DRAWN),
            attachment("depth", format, Role::Depth, load, TESTED),
        ],
        before: Dependency { source: ALL, target: GRAPHICS },
        after: Dependency { source: GRAPHICS, target: ALL },
    }
}
