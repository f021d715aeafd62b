//! A colour and a depth image to draw into, with a triangle that covers both.

use std::sync::Arc;

use depthleap::glsl;
use depthleap::vulkan::{
    Attachment, Blend, Bound, Buffer, BufferInfo, Commands, CopyRegion, Dependency, DepthState, DescriptorSet, Device,
    Framebuffer, GraphicsPipeline, GraphicsPipelineInfo, Image, ImageInfo, ImageShape, Place, RenderPass,
    RenderPassInfo, Role, Scope, ShaderModule, vk,
};

use super::kit::{COPY_READ, COPY_WRITE, buffer, run, uploaded, words};

const COLOR_LAYOUT: vk::ImageLayout = vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL;
const DEPTH_LAYOUT: vk::ImageLayout = vk::ImageLayout::DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
const TO: vk::ImageLayout = vk::ImageLayout::TRANSFER_DST_OPTIMAL;
const FROM: vk::ImageLayout = vk::ImageLayout::TRANSFER_SRC_OPTIMAL;

/// What both attachments are used for.
fn attached() -> Scope {
    use vk::{AccessFlags2 as A, PipelineStageFlags2 as S};
    Scope::new(
        S::FRAGMENT_SHADER | S::COLOR_ATTACHMENT_OUTPUT | S::EARLY_FRAGMENT_TESTS | S::LATE_FRAGMENT_TESTS,
        A::COLOR_ATTACHMENT_READ
            | A::COLOR_ATTACHMENT_WRITE
            | A::INPUT_ATTACHMENT_READ
            | A::DEPTH_STENCIL_ATTACHMENT_READ
            | A::DEPTH_STENCIL_ATTACHMENT_WRITE,
    )
}

/// A pass that goes on with what is there.
pub fn pass_info() -> RenderPassInfo {
    let attachment = |name: &str, format, role, layout| Attachment {
        name: name.to_owned(),
        format,
        role,
        load: vk::AttachmentLoadOp::LOAD,
        store: vk::AttachmentStoreOp::STORE,
        before: layout,
        during: layout,
        after: layout,
    };
    let everything = Dependency { source: attached(), target: attached() };
    RenderPassInfo {
        name: "canvas pass".to_owned(),
        attachments: vec![
            attachment("color", vk::Format::R32G32B32A32_SFLOAT, Role::Color, COLOR_LAYOUT),
            attachment("depth", vk::Format::D32_SFLOAT, Role::Depth, DEPTH_LAYOUT),
        ],
        before: everything,
        after: everything,
    }
}

/// The same, whose fragments read the colour they draw into.
pub fn reading_pass_info() -> RenderPassInfo {
    let mut info = pass_info();
    let color = &mut info.attachments[0];
    color.role = Role::ColorInput;
    for layout in [&mut color.before, &mut color.during, &mut color.after] {
        *layout = vk::ImageLayout::GENERAL;
    }
    info
}

pub struct Canvas {
    pub color: Image,
    pub depth: Image,
    pub pass: RenderPass,
    pub framebuffer: Framebuffer,
    triangle: Buffer,
}

impl Canvas {
    /// Transparent black, depth 0.
    pub fn new(device: &Arc<Device>, size: [u32; 2]) -> Self {
        Self::of_pass(device, size, pass_info())
    }

    /// The same for a pass like that of [`pass_info`].
    pub fn of_pass(device: &Arc<Device>, [width, height]: [u32; 2], pass: RenderPassInfo) -> Self {
        let copied = vk::ImageUsageFlags::TRANSFER_SRC | vk::ImageUsageFlags::TRANSFER_DST;
        let image = |name: &str, format, usage| {
            let info = ImageInfo {
                name: name.to_owned(),
                extent: [width, height, 1],
                format,
                usage: usage | copied,
                shape: ImageShape::Flat,
                shared: false,
            };
            Image::new(device, info).unwrap()
        };
        let drawn_and_read = vk::ImageUsageFlags::COLOR_ATTACHMENT | vk::ImageUsageFlags::INPUT_ATTACHMENT;
        let color = image("color", vk::Format::R32G32B32A32_SFLOAT, drawn_and_read);
        let depth = image("depth", vk::Format::D32_SFLOAT, vk::ImageUsageFlags::DEPTH_STENCIL_ATTACHMENT);
        let pass = RenderPass::new(device, pass).unwrap();
        let framebuffer = Framebuffer::new(device, "canvas", &pass, &[&color, &depth], [width, height]).unwrap();
        // x, y, w in clip space, of a triangle that covers the square from -1 to 1.
        let corners: [[f32; 3]; 3] = [[-1.0, -1.0, 1.0], [3.0, -1.0, 1.0], [-1.0, 3.0, 1.0]];
        let usage = vk::BufferUsageFlags::VERTEX_BUFFER;
        let info = BufferInfo { name: "triangle".to_owned(), size: 36, usage, place: Place::Upload };
        let triangle = Buffer::new(device, info).unwrap();
        triangle.write(0, bytemuck::cast_slice(&corners)).unwrap();
        let canvas = Self { color, depth, pass, framebuffer, triangle };
        let pixels = (width * height) as usize;
        canvas.fill(device, &canvas.color, canvas.color_layout(), &vec![0.0; 4 * pixels]);
        canvas.set_depth(device, &vec![0.0; pixels]);
        canvas
    }

    /// The layout the colour image has between passes.
    fn color_layout(&self) -> vk::ImageLayout {
        self.pass.info.attachments[0].after
    }

    /// Stored depths, row 0 first.
    pub fn set_depth(&self, device: &Arc<Device>, depths: &[f32]) {
        self.fill(device, &self.depth, DEPTH_LAYOUT, depths);
    }

    fn fill(&self, device: &Arc<Device>, image: &Image, layout: vk::ImageLayout, values: &[f32]) {
        let from = uploaded(device, "texels", bytemuck::cast_slice(values));
        run(device, "fill", |commands| {
            commands.image_barrier(image, attached(), COPY_WRITE, vk::ImageLayout::UNDEFINED, TO);
            commands.copy_buffer_to_image(&from, image, CopyRegion::whole(image));
            commands.image_barrier(image, COPY_WRITE, attached(), TO, layout);
        });
    }

    pub fn pipeline_of(
        &self,
        device: &Arc<Device>,
        vertex: &ShaderModule,
        fragment: &ShaderModule,
    ) -> depthleap::Result<GraphicsPipeline> {
        self.with_state(device, vertex, Some(fragment), DepthState::OFF, Blend::Replace)
    }

    fn with_state(
        &self,
        device: &Arc<Device>,
        vertex: &ShaderModule,
        fragment: Option<&ShaderModule>,
        depth: DepthState,
        blend: Blend,
    ) -> depthleap::Result<GraphicsPipeline> {
        GraphicsPipeline::new(
            device,
            &GraphicsPipelineInfo {
                name: "painter",
                vertex,
                fragment,
                constants: &[],
                render_pass: &self.pass,
                vertex_format: Some(vk::Format::R32G32B32_SFLOAT),
                front_only: false,
                depth,
                stencil: None,
                blend,
            },
        )
    }

    /// Paints one colour through the program's own vertex shader.
    pub fn painter(
        &self,
        device: &Arc<Device>,
        depth: DepthState,
        blend: Blend,
    ) -> depthleap::Result<GraphicsPipeline> {
        self.with_state(device, &box_vertex(), Some(&crate::shader::shader("vulkan/color.frag")), depth, blend)
    }

    /// Paints one colour added to what was there.
    pub fn adder(&self, device: &Arc<Device>, blend: Blend) -> depthleap::Result<GraphicsPipeline> {
        self.with_state(
            device,
            &box_vertex(),
            Some(&crate::shader::shader("vulkan/before.frag")),
            DepthState::OFF,
            blend,
        )
    }

    /// All of it.
    pub fn area(&self) -> vk::Rect2D {
        let [width, height] = self.framebuffer.extent;
        rectangle([0, 0], [width, height])
    }

    /// Draws the triangle at `depth` into `area`, with `around` recording what is to stand before and after it.
    pub fn draw(
        &self,
        device: &Arc<Device>,
        commands: &mut Commands,
        pipeline: &GraphicsPipeline,
        Stroke { color, depth, area }: Stroke,
        around: impl FnOnce(&mut Commands, &dyn Fn(&mut Commands)),
    ) {
        let before = [("before", Bound::Input(&self.color))];
        let set = DescriptorSet::new(device, "what was there", &pipeline.layout, &before).unwrap();
        commands.begin_render_pass(&self.pass, &self.framebuffer, self.area(), &[]);
        commands.bind_graphics(pipeline, &set);
        commands.viewport(self.area(), [depth, depth]);
        commands.scissor(area);
        commands.push(&pipeline.layout, bytemuck::cast_slice(&color));
        commands.vertices(&self.triangle);
        around(commands, &|commands| commands.draw(0, 3));
        commands.end_render_pass();
    }

    /// Premultiplied RGBA of every pixel, row 0 first.
    pub fn colors(&self, device: &Arc<Device>) -> Vec<[f32; 4]> {
        bytemuck::cast_slice(&self.texels(device, &self.color, self.color_layout())).to_vec()
    }

    pub fn depths(&self, device: &Arc<Device>) -> Vec<f32> {
        bytemuck::cast_slice(&self.texels(device, &self.depth, DEPTH_LAYOUT)).to_vec()
    }

    fn texels(&self, device: &Arc<Device>, image: &Image, layout: vk::ImageLayout) -> Vec<u32> {
        let to = buffer(device, "texels", image.bytes(), Place::Readback);
        run(device, "read", |commands| {
            commands.image_barrier(image, attached(), COPY_READ, layout, FROM);
            commands.copy_image_to_buffer(image, &to, CopyRegion::whole(image));
            commands.image_barrier(image, COPY_READ, attached(), FROM, layout);
        });
        words(&to.read().unwrap())
    }
}

/// What is drawn, where and at which depth.
#[derive(Clone, Copy)]
pub struct Stroke {
    pub color: [f32; 4],
    pub depth: f32,
    pub area: vk::Rect2D,
}

pub fn rectangle([x, y]: [i32; 2], [width, height]: [u32; 2]) -> vk::Rect2D {
    vk::Rect2D { offset: vk::Offset2D { x, y }, extent: vk::Extent2D { width, height } }
}

/// The program's own vertex shader.
fn box_vertex() -> ShaderModule {
    let shader = glsl::Shader::new("box.vert", []);
    ShaderModule::new(shader.file, &glsl::module(&shader).unwrap()).unwrap()
}
