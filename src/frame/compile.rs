//! Plan to device objects: targets, render passes, framebuffers, pipelines, descriptor sets. Made once, run often.

use std::collections::HashMap;
use std::sync::Arc;

use ash::vk;

use super::pipelines::PipelineKey;
use super::resident::Resident;
use super::schedule::{Barrier, schedule};
use crate::error::{Error, Result};
use crate::part::resource::{Access, Resource, Usage};
use crate::part::{Draw, Faces, Group, Step, Work};
use crate::plan::{Plan, bytes_per_pixel};
use crate::scene::Region;
use crate::scene::Scene;
use crate::scene::settings::{Accumulate, DepthFormat, Filter, Formats};
use crate::shared;
use crate::vulkan::{
    Buffer, BufferInfo, DescriptorSet, Device, Framebuffer, GraphicsPipeline, Image, ImageInfo, Place, RenderPass,
    RenderPassInfo, Sampler,
};

/// The objects of a frame.
pub struct Compiled {
    pub steps: Vec<CompiledStep>,
    pub vertices: Option<Buffer>,
    pub targets: HashMap<Resource, Image>,
    pub marks_buffer: Option<Buffer>,
    pub region: Region,
}

pub struct CompiledStep {
    pub step: Step,
    pub barriers: Vec<Barrier>,
    pub draw: Option<CompiledDraw>,
    /// Where RES is once the step has run, for whoever reads the picture then.
    pub accumulated_layout: Option<vk::ImageLayout>,
}

/// What a draw binds. Steps of the same kind share the objects.
#[derive(Clone)]
pub struct CompiledDraw {
    pub render_pass: Arc<RenderPass>,
    pub framebuffer: Arc<Framebuffer>,
    pub pipeline: Arc<GraphicsPipeline>,
    pub set: Arc<DescriptorSet>,
    pub clears: Vec<vk::ClearValue>,
    pub first_vertex: u32,
    pub vertices: u32,
}

struct Compiler<'a> {
    device: &'a Arc<Device>,
    plan: &'a Plan,
    resident: &'a mut Resident,
    targets: HashMap<Resource, Image>,
    frame: Buffer,
    linear: Option<Sampler>,
    nearest: Sampler,
    framebuffers: HashMap<(RenderPassInfo, Vec<Resource>), Arc<Framebuffer>>,
    /// By pipeline and by what is bound to it.
    sets: HashMap<(PipelineKey, Arc<Vec<Access>>), Arc<DescriptorSet>>,
}

/// The format of a target.
pub fn target_format(resource: Resource, formats: Formats) -> vk::Format {
    match resource {
        Resource::Accumulated => match formats.accumulate {
            Accumulate::Rgba32f => vk::Format::R32G32B32A32_SFLOAT,
            Accumulate::Rgba16f => vk::Format::R16G16B16A16_SFLOAT,
            Accumulate::Rgba8 => vk::Format::R8G8B8A8_UNORM,
        },
        Resource::Stored => match formats.depth {
            DepthFormat::D32 => vk::Format::D32_SFLOAT,
            DepthFormat::D24 => vk::Format::X8_D24_UNORM_PACK32,
            DepthFormat::D16 => vk::Format::D16_UNORM,
        },
        // Of the same bytes, which are copied as they are.
        Resource::Marks => match formats.depth {
            DepthFormat::D32 | DepthFormat::D24 => vk::Format::R32_SFLOAT,
            DepthFormat::D16 => vk::Format::R8G8_UNORM,
        },
        _ => vk::Format::R32G32B32A32_SFLOAT,
    }
}

/// Makes every object the plan's graphics steps need.
///
/// # Errors
/// When the device cannot blend the accumulation format, a target is larger than it allows, or memory is short.
pub fn compile(device: &Arc<Device>, scene: &Scene, plan: &Plan, resident: &mut Resident) -> Result<Compiled> {
    let steps: Vec<Step> = plan.steps.iter().filter(|s| s.group != Group::Structure).cloned().collect();
    resident.pipelines.prepare(&steps)?;
    let formats = scene.settings.formats();
    let scheduled = schedule(&steps, |r| target_format(r, formats));
    let mut compiler = Compiler {
        device,
        plan,
        resident,
        targets: targets(device, plan, formats)?,
        frame: frame_buffer(device, scene, plan)?,
        linear: match scene.settings.sampling.filter {
            Filter::Hardware => Some(Sampler::new(device, "trilinear", true)?),
            Filter::Exact | Filter::Nearest => None,
        },
        nearest: Sampler::new(device, "nearest", false)?,
        framebuffers: HashMap::new(),
        sets: HashMap::new(),
    };
    let mut compiled = Vec::with_capacity(steps.len());
    for (step, scheduled) in steps.into_iter().zip(scheduled) {
        let draw = match (&step.work, scheduled.render_pass) {
            (Work::Draw(draw), Some(info)) => Some(compiler.draw(&step, draw, info, &scheduled.targets)?),
            _ => None,
        };
        compiled.push(CompiledStep {
            accumulated_layout: scheduled.layouts.get(&Resource::Accumulated).copied(),
            step,
            barriers: scheduled.barriers,
            draw,
        });
    }
    let marks_buffer = compiler
        .targets
        .contains_key(&Resource::Marks)
        .then(|| {
            Buffer::new(
                device,
                BufferInfo {
                    name: Resource::MarksBuffer.name().to_owned(),
                    size: plan.view.region.pixels() * bytes_per_pixel(Resource::Marks, formats),
                    usage: vk::BufferUsageFlags::TRANSFER_SRC | vk::BufferUsageFlags::TRANSFER_DST,
                    place: Place::Device,
                },
            )
        })
        .transpose()?;
    Ok(Compiled {
        steps: compiled,
        vertices: vertex_buffer(device, plan)?,
        targets: compiler.targets,
        marks_buffer,
        region: plan.view.region,
    })
}

fn targets(device: &Arc<Device>, plan: &Plan, formats: Formats) -> Result<HashMap<Resource, Image>> {
    let mut usages: HashMap<Resource, vk::ImageUsageFlags> = HashMap::new();
    for access in plan.steps.iter().flat_map(|s| s.accesses.iter()).filter(|a| a.resource.is_target()) {
        let flags = usages.entry(access.resource).or_default();
        *flags |= match access.usage {
            Usage::Color | Usage::ColorKept => vk::ImageUsageFlags::COLOR_ATTACHMENT,
            Usage::ColorInput => vk::ImageUsageFlags::COLOR_ATTACHMENT | vk::ImageUsageFlags::INPUT_ATTACHMENT,
            Usage::DepthWrite | Usage::DepthTest => vk::ImageUsageFlags::DEPTH_STENCIL_ATTACHMENT,
            Usage::CopySource => vk::ImageUsageFlags::TRANSFER_SRC,
            Usage::CopyTarget => vk::ImageUsageFlags::TRANSFER_DST,
            _ => vk::ImageUsageFlags::SAMPLED,
        };
        if access.resource == Resource::Accumulated {
            // The picture is read back.
            *flags |= vk::ImageUsageFlags::TRANSFER_SRC;
        }
    }
    let accumulated = target_format(Resource::Accumulated, formats);
    if !device.format_supports(accumulated, vk::FormatFeatureFlags::COLOR_ATTACHMENT_BLEND) {
        return Err(Error::device(
            &device.info.name,
            format!("cannot blend into {accumulated:?}"),
            "choose another image.accumulate: rgba32f, rgba16f or rgba8",
        ));
    }
    let stored = target_format(Resource::Stored, formats);
    if usages.contains_key(&Resource::Stored)
        && !device.format_supports(stored, vk::FormatFeatureFlags::DEPTH_STENCIL_ATTACHMENT)
    {
        return Err(Error::device(
            &device.info.name,
            format!("has no depth format {stored:?}"),
            "use --depth-format d32 or d16, which every device has",
        ));
    }
    let Region { width, height, .. } = plan.view.region;
    usages
        .into_iter()
        .map(|(resource, usage)| {
            let info = ImageInfo {
                name: resource.name().to_owned(),
                extent: [width, height, 1],
                format: target_format(resource, formats),
                usage,
                volume: false,
                shared: false,
            };
            Ok((resource, Image::new(device, info)?))
        })
        .collect()
}

fn frame_buffer(device: &Arc<Device>, scene: &Scene, plan: &Plan) -> Result<Buffer> {
    let region = plan.view.region;
    let frame = shared::Frame::new(scene, &plan.view.rays, plan.passes, [region.x, region.y]);
    let buffer = Buffer::new(
        device,
        BufferInfo {
            name: Resource::Frame.name().to_owned(),
            size: size_of_val(&frame) as u64,
            usage: vk::BufferUsageFlags::UNIFORM_BUFFER,
            place: Place::Upload,
        },
    )?;
    buffer.write(0, bytemuck::bytes_of(&frame))?;
    Ok(buffer)
}

/// Front triangles, then back triangles.
fn vertex_buffer(device: &Arc<Device>, plan: &Plan) -> Result<Option<Buffer>> {
    let corners: Vec<[f32; 3]> = [plan.view.front.as_slice(), &plan.view.back].concat();
    if corners.is_empty() {
        return Ok(None);
    }
    let buffer = Buffer::new(
        device,
        BufferInfo {
            name: Resource::Box.name().to_owned(),
            size: size_of_val(corners.as_slice()) as u64,
            usage: vk::BufferUsageFlags::VERTEX_BUFFER,
            place: Place::Upload,
        },
    )?;
    buffer.write(0, bytemuck::cast_slice(&corners))?;
    Ok(Some(buffer))
}

impl Compiler<'_> {
    fn draw(&mut self, step: &Step, draw: &Draw, info: RenderPassInfo, targets: &[Resource]) -> Result<CompiledDraw> {
        let render_pass = self.resident.pipelines.render_pass(&info)?;
        let framebuffer = self.framebuffer(&render_pass, targets)?;
        let key = PipelineKey {
            render_pass: info,
            shader: draw.shader.clone(),
            constants: draw.constants.clone(),
            test: draw.test,
            blend: draw.blend,
        };
        let pipeline = self.resident.pipelines.pipeline(&key, step.pass_name())?;
        let set = self.set(&key, step, &pipeline)?;
        let (front, back) = (self.plan.view.front.len() as u32, self.plan.view.back.len() as u32);
        let (first_vertex, vertices) = match draw.faces {
            Faces::Front => (0, front),
            Faces::Back => (front, back),
        };
        Ok(CompiledDraw {
            clears: vec![vk::ClearValue::default(); targets.len()],
            render_pass,
            framebuffer,
            pipeline,
            set,
            first_vertex,
            vertices,
        })
    }

    fn framebuffer(&mut self, pass: &Arc<RenderPass>, targets: &[Resource]) -> Result<Arc<Framebuffer>> {
        let key = (pass.info.clone(), targets.to_vec());
        if let Some(known) = self.framebuffers.get(&key) {
            return Ok(known.clone());
        }
        let images: Vec<&Image> = targets.iter().map(|t| &self.targets[t]).collect();
        let made =
            Arc::new(Framebuffer::new(self.device, &pass.info.name, pass, &images, self.plan.view.region.size())?);
        self.framebuffers.insert(key, made.clone());
        Ok(made)
    }

    fn set(&mut self, key: &PipelineKey, step: &Step, pipeline: &GraphicsPipeline) -> Result<Arc<DescriptorSet>> {
        use crate::vulkan::Resource as Bound;
        let by = (key.clone(), step.accesses.clone());
        if let Some(known) = self.sets.get(&by) {
            return Ok(known.clone());
        }
        let mut bound: Vec<(&str, Bound)> = Vec::new();
        for access in step.accesses.iter().filter(|a| matches!(a.usage, Usage::Sampled | Usage::ColorInput)) {
            let resource = access.resource;
            let layout = access.usage.layout();
            if access.usage == Usage::ColorInput {
                bound.push((resource.name(), Bound::Input(&self.targets[&resource])));
            } else if resource == Resource::Frame {
                bound.push((resource.name(), Bound::Uniform(&self.frame)));
            } else if let Some(buffer) = self.resident.buffer(resource) {
                bound.push((resource.name(), Bound::Storage(buffer)));
            } else if let Some(image) = self.image(resource) {
                let sampler = match &self.linear {
                    Some(linear) if resource == Resource::Volume => linear,
                    _ => &self.nearest,
                };
                bound.push((resource.name(), Bound::Sampled(image, sampler, layout)));
            }
        }
        let name = step.pass_name();
        let made = Arc::new(DescriptorSet::new(self.device, name, &pipeline.layout, &bound)?);
        self.sets.insert(by, made.clone());
        Ok(made)
    }

    fn image(&self, resource: Resource) -> Option<&Image> {
        match (resource, &self.plan.distance) {
            (Resource::NearestDistance, Some(lookup)) => self.resident.distance(lookup),
            _ => self.targets.get(&resource).or_else(|| self.resident.image(resource)),
        }
    }
}
