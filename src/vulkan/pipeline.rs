//! Graphics and compute pipelines.

use std::sync::Arc;

use ash::vk;

use super::device::Device;
use super::failure::misuse;
use super::format::{has_alpha, has_stencil, texel_bytes};
use super::layout::Layout;
use super::owned::Owned;
use super::render_pass::{RenderPass, Role};
use super::shader::ShaderModule;
use super::stages::Stages;
use crate::error::{Error, Result};
use crate::math::blend::Blend;

/// What happens between a fragment's depth and the stored one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct DepthState {
    /// Without the test nothing is written either.
    pub test: bool,
    pub write: bool,
    pub compare: vk::CompareOp,
    /// The depth bounds test, with bounds set while recording.
    pub bounds: bool,
}

impl DepthState {
    /// No test, no write.
    pub const OFF: Self = Self { test: false, write: false, compare: vk::CompareOp::ALWAYS, bounds: false };
}

/// What a graphics pipeline is made from. Triangle lists; viewport, scissor and depth bounds are
/// set while recording.
pub struct GraphicsPipelineInfo<'a> {
    pub name: &'a str,
    pub vertex: &'a ShaderModule,
    /// Without one colours are undefined, and colour attachments are left as they are.
    pub fragment: Option<&'a ShaderModule>,
    /// Specialization constants by name, with the bits of their values.
    pub constants: &'a [(&'a str, u32)],
    pub render_pass: &'a RenderPass,
    /// One attribute at location 0, tightly packed; `None`: no vertex buffer.
    pub vertex_format: Option<vk::Format>,
    /// Whether triangles are drawn only where their corners go round to the left; else both faces are.
    pub front_only: bool,
    pub depth: DepthState,
    /// Fragments pass where the stencil attachment holds this value, which stays; `None`: no stencil test.
    pub stencil: Option<u8>,
    /// How a fragment's colour goes into the attachments; one whose format has no alpha is replaced.
    pub blend: Blend,
}

pub struct GraphicsPipeline {
    pub name: String,
    pub layout: Arc<Layout>,
    pub depth: DepthState,
    pub(super) owned: Arc<Owned<vk::Pipeline>>,
}

impl GraphicsPipeline {
    /// # Errors
    /// Shaders of the wrong stage or that contradict each other, a constant that no shader has, a depth state
    /// without a depth attachment, a missing device feature.
    pub fn new(device: &Arc<Device>, info: &GraphicsPipelineInfo<'_>) -> Result<Self> {
        let name = info.name;
        let shaders: Vec<&ShaderModule> = std::iter::once(info.vertex).chain(info.fragment).collect();
        for (shader, stage) in shaders.iter().zip([vk::ShaderStageFlags::VERTEX, vk::ShaderStageFlags::FRAGMENT]) {
            expect_stage(name, shader, stage)?;
        }
        check_depth(device, info)?;
        let blends = blends(device, info)?;
        let layout = Layout::new(device, name, &shaders)?;
        let stages = Stages::new(device, name, &shaders, info.constants)?;

        let mut binding = Vec::new();
        let mut attribute = Vec::new();
        if let Some(format) = info.vertex_format {
            let stride =
                texel_bytes(format).ok_or_else(|| misuse(name, format!("vertices of {format:?}: unknown size")))?;
            binding.push(vk::VertexInputBindingDescription::default().stride(stride as u32));
            attribute.push(vk::VertexInputAttributeDescription::default().format(format));
        }
        let input = vk::PipelineVertexInputStateCreateInfo::default()
            .vertex_binding_descriptions(&binding)
            .vertex_attribute_descriptions(&attribute);
        let assembly =
            vk::PipelineInputAssemblyStateCreateInfo::default().topology(vk::PrimitiveTopology::TRIANGLE_LIST);
        let viewport = vk::PipelineViewportStateCreateInfo::default().viewport_count(1).scissor_count(1);
        let raster = vk::PipelineRasterizationStateCreateInfo::default()
            .polygon_mode(vk::PolygonMode::FILL)
            .cull_mode(if info.front_only { vk::CullModeFlags::BACK } else { vk::CullModeFlags::NONE })
            .front_face(vk::FrontFace::COUNTER_CLOCKWISE)
            .line_width(1.0);
        let samples =
            vk::PipelineMultisampleStateCreateInfo::default().rasterization_samples(vk::SampleCountFlags::TYPE_1);
        let stencil = vk::StencilOpState::default()
            .compare_op(vk::CompareOp::EQUAL)
            .compare_mask(0xff)
            .reference(info.stencil.unwrap_or_default().into());
        let depth = vk::PipelineDepthStencilStateCreateInfo::default()
            .stencil_test_enable(info.stencil.is_some())
            .front(stencil)
            .back(stencil)
            .depth_test_enable(info.depth.test)
            .depth_write_enable(info.depth.write)
            .depth_compare_op(info.depth.compare)
            .depth_bounds_test_enable(info.depth.bounds)
            .max_depth_bounds(1.0);
        let blend = vk::PipelineColorBlendStateCreateInfo::default().attachments(&blends);
        let mut states = vec![vk::DynamicState::VIEWPORT, vk::DynamicState::SCISSOR];
        states.extend(info.depth.bounds.then_some(vk::DynamicState::DEPTH_BOUNDS));
        let dynamic = vk::PipelineDynamicStateCreateInfo::default().dynamic_states(&states);

        let specializations = stages.specializations();
        let stages_info = stages.infos(&specializations);
        let create = vk::GraphicsPipelineCreateInfo::default()
            .stages(&stages_info)
            .vertex_input_state(&input)
            .input_assembly_state(&assembly)
            .viewport_state(&viewport)
            .rasterization_state(&raster)
            .multisample_state(&samples)
            .depth_stencil_state(&depth)
            .color_blend_state(&blend)
            .dynamic_state(&dynamic)
            .layout(layout.owned.raw)
            .render_pass(info.render_pass.owned.raw);
        // SAFETY: everything `create` points to outlives the call; all handles are of this device.
        let made = unsafe { device.raw.create_graphics_pipelines(device.cache, &[create], None) };
        let owned = own(device, "vkCreateGraphicsPipelines", name, made)?;
        Ok(Self { name: name.into(), layout, depth: info.depth, owned })
    }
}

pub struct ComputePipeline {
    pub name: String,
    pub layout: Arc<Layout>,
    pub(super) owned: Arc<Owned<vk::Pipeline>>,
}

impl ComputePipeline {
    /// `constants`: specialization constants by name, with the bits of their values.
    ///
    /// # Errors
    /// A shader of another stage, a constant it does not have.
    pub fn new(device: &Arc<Device>, name: &str, shader: &ShaderModule, constants: &[(&str, u32)]) -> Result<Self> {
        expect_stage(name, shader, vk::ShaderStageFlags::COMPUTE)?;
        let shaders = [shader];
        let layout = Layout::new(device, name, &shaders)?;
        let stages = Stages::new(device, name, &shaders, constants)?;
        let specializations = stages.specializations();
        let create =
            vk::ComputePipelineCreateInfo::default().stage(stages.infos(&specializations)[0]).layout(layout.owned.raw);
        // SAFETY: everything `create` points to outlives the call; all handles are of this device.
        let made = unsafe { device.raw.create_compute_pipelines(device.cache, &[create], None) };
        let owned = own(device, "vkCreateComputePipelines", name, made)?;
        Ok(Self { name: name.into(), layout, owned })
    }
}

type PipelinesMade = Result<Vec<vk::Pipeline>, (Vec<vk::Pipeline>, vk::Result)>;

fn own(device: &Arc<Device>, call: &str, name: &str, made: PipelinesMade) -> Result<Arc<Owned<vk::Pipeline>>> {
    let raw = device.check(call, name, made.map_err(|(_, code)| code))?[0];
    device.name(raw, name);
    // SAFETY of the destroyer: called once, when nothing uses the pipeline any more.
    Ok(Owned::new(device, raw, |device, raw| unsafe { device.destroy_pipeline(raw, None) }))
}

fn expect_stage(name: &str, shader: &ShaderModule, stage: vk::ShaderStageFlags) -> Result<()> {
    match shader.stage == stage {
        true => Ok(()),
        false => Err(misuse(name, format!("{} is a {:?} shader in the place of {stage:?}", shader.name, shader.stage))),
    }
}

fn check_depth(device: &Device, info: &GraphicsPipelineInfo<'_>) -> Result<()> {
    let attached = info.render_pass.info.attachments.iter().any(|one| one.role == Role::Depth);
    if (info.depth.test || info.depth.bounds) && !attached {
        let problem = format!("tests depth in {}, which has no depth attachment", info.render_pass.info.name);
        return Err(misuse(info.name, problem));
    }
    let with_stencil = |one: &super::Attachment| one.role == Role::Depth && has_stencil(one.format);
    if info.stencil.is_some() && !info.render_pass.info.attachments.iter().any(with_stencil) {
        let problem = format!("tests stencils in {}, which has no stencil attachment", info.render_pass.info.name);
        return Err(misuse(info.name, problem));
    }
    if info.depth.bounds && !device.info.depth_bounds {
        return Err(Error::device(
            info.name,
            format!("{} has no depth bounds test", device.info.name),
            "cull by another test or choose another device",
        ));
    }
    Ok(())
}

fn blends(device: &Device, info: &GraphicsPipelineInfo<'_>) -> Result<Vec<vk::PipelineColorBlendAttachmentState>> {
    let colors = info.render_pass.info.attachments.iter().filter(|one| one.role.is_color());
    let blended: Vec<_> = colors.map(|one| info.blend != Blend::Replace && has_alpha(one.format)).collect();
    if blended.windows(2).any(|pair| pair[0] != pair[1]) && device.features.independent_blend != vk::TRUE {
        return Err(Error::device(
            info.name,
            format!("{} blends all attachments alike (no independentBlend)", device.info.name),
            "choose another device",
        ));
    }
    let one = vk::BlendFactor::ONE;
    // The greater and the lesser are found without factors.
    let (source, target, operation) = match info.blend {
        Blend::Replace | Blend::Add => (one, one, vk::BlendOp::ADD),
        Blend::Over => (vk::BlendFactor::ONE_MINUS_DST_ALPHA, one, vk::BlendOp::ADD),
        Blend::InFront => (one, vk::BlendFactor::ONE_MINUS_SRC_ALPHA, vk::BlendOp::ADD),
        Blend::Max => (one, one, vk::BlendOp::MAX),
        Blend::Min => (one, one, vk::BlendOp::MIN),
    };
    let written = match info.fragment {
        Some(_) => vk::ColorComponentFlags::RGBA,
        None => vk::ColorComponentFlags::empty(),
    };
    let state = |blended| {
        vk::PipelineColorBlendAttachmentState::default()
            .blend_enable(blended)
            .src_color_blend_factor(source)
            .dst_color_blend_factor(target)
            .color_blend_op(operation)
            .src_alpha_blend_factor(source)
            .dst_alpha_blend_factor(target)
            .alpha_blend_op(operation)
            .color_write_mask(written)
    };
    Ok(blended.into_iter().map(state).collect())
}
