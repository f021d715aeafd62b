//! Plan to device objects: targets, render passes, framebuffers, pipelines, descriptor sets. DeviceObject once, run often.

use std::collections::HashMap;
use std::ops::Range;
use std::sync::Arc;

use ash::vk;

use super::object::{self, DeviceObject};
use super::pipelines::PipelineKey;
use super::resident::Resident;
use super::schedule::{Barrier, schedule};
use crate::error::{Error, Result};
use crate::geometry;
use crate::part::access::{Access, Usage};
use crate::part::resource::{Origin, Resource, ResourceKind};
use crate::part::{Draw, PixelDispatch, Step, Work};
use crate::plan::Plan;
use crate::resource;
use crate::scene::Region;
use crate::scene::Scene;
use crate::scene::settings::{Filter, Formats};
use crate::scene::view::View;
use crate::vulkan::{
    Bound, Buffer, ComputePipeline, DescriptorSet, Device, Framebuffer, GraphicsPipeline, Image, ImageInfo, ImageShape,
    RenderPass, RenderPassInfo, Sampler,
};

/// The objects of a frame.
pub struct Compiled {
    pub steps: Vec<CompiledStep>,
    pub targets: HashMap<Resource, Image>,
    /// Uploads of this frame: its box and its view.
    pub own: HashMap<Resource, DeviceObject>,
    /// Corners of geometries that outlive the frame.
    pub vertices: HashMap<Resource, Buffer>,
    pub marks_buffer: Option<DeviceObject>,
    pub region: Region,
}

pub struct CompiledStep {
    pub step: Step,
    pub barriers: Vec<Barrier>,
    /// Rectangles of the targets that it draws in, or copies.
    pub parts: Vec<Region>,
    pub draw: Option<CompiledDraw>,
    pub pixels: Option<CompiledPixels>,
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
    /// Corners of the geometry, or numbers of them.
    pub corners: Range<u32>,
    /// Where the list of their numbers begins, bytes.
    pub numbers: Option<u64>,
}

/// What a compute shader over the pixels binds.
pub struct CompiledPixels {
    pub pipeline: Arc<ComputePipeline>,
    pub set: DescriptorSet,
}

struct Compiler<'a> {
    device: &'a Arc<Device>,
    scene: &'a Scene,
    plan: &'a Plan,
    resident: &'a mut Resident,
    targets: HashMap<Resource, Image>,
    own: HashMap<Resource, DeviceObject>,
    vertices: HashMap<Resource, Buffer>,
    linear: Option<Sampler>,
    nearest: Sampler,
    framebuffers: HashMap<(RenderPassInfo, Vec<Resource>), Arc<Framebuffer>>,
    /// By pipeline and by what is bound to it.
    sets: HashMap<(PipelineKey, Arc<Vec<Access>>), Arc<DescriptorSet>>,
}

/// Makes every object the plan's graphics steps need.
///
/// # Errors
/// When the device cannot blend the accumulation format, a target is larger than it allows, or memory is short.
pub fn compile(device: &Arc<Device>, scene: &Scene, plan: &Plan, resident: &mut Resident) -> Result<Compiled> {
    let steps = plan.frame().to_vec();
    resident.pipelines.prepare(&steps)?;
    let formats = scene.settings.formats();
    let scheduled = schedule(&steps, |resource| resource.format(formats));
    let mut compiler = Compiler {
        device,
        scene,
        plan,
        resident,
        targets: targets(device, plan, formats)?,
        own: of_frame(device, scene, plan)?,
        vertices: HashMap::new(),
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
        let pixels = match &step.work {
            Work::Pixels(pixels) => Some(compiler.pixels(&step, pixels)?),
            _ => None,
        };
        compiled.push(CompiledStep {
            accumulated_layout: scheduled.layouts.get(&resource::ACCUMULATED).copied(),
            parts: parts(&plan.view, &step),
            step,
            barriers: scheduled.barriers,
            draw,
            pixels,
        });
    }
    let copies = compiler.targets.contains_key(&resource::MARKS);
    let marks_buffer = copies.then(|| object::empty(device, resource::MARKS_BUFFER, &plan.facts(scene))).transpose()?;
    Ok(Compiled {
        steps: compiled,
        targets: compiler.targets,
        own: compiler.own,
        vertices: compiler.vertices,
        marks_buffer,
        region: plan.view.region,
    })
}

/// The rectangles of the targets that a step draws in, or copies.
fn parts(view: &View, step: &Step) -> Vec<Region> {
    let parts = match &step.work {
        Work::Draw(draw) => (draw.geometry.parts)(view, step.pass),
        Work::Copy { of, .. } => of.and_then(|pass| geometry::of_pass(view, pass)),
        _ => None,
    };
    parts.map_or_else(|| vec![Region { x: 0, y: 0, ..view.region }], <[Region]>::to_vec)
}

fn targets(device: &Arc<Device>, plan: &Plan, formats: Formats) -> Result<HashMap<Resource, Image>> {
    let mut usages: HashMap<Resource, vk::ImageUsageFlags> = HashMap::new();
    for access in plan.steps.iter().flat_map(|s| s.accesses.iter()).filter(|a| a.resource.is_target()) {
        let flags = usages.entry(access.resource).or_default();
        *flags |= match access.usage {
            Usage::Color | Usage::ColorKept => vk::ImageUsageFlags::COLOR_ATTACHMENT,
            Usage::ColorInput => vk::ImageUsageFlags::COLOR_ATTACHMENT | vk::ImageUsageFlags::INPUT_ATTACHMENT,
            Usage::DepthWrite | Usage::DepthTest | Usage::DepthAnew => vk::ImageUsageFlags::DEPTH_STENCIL_ATTACHMENT,
            Usage::CopySource => vk::ImageUsageFlags::TRANSFER_SRC,
            Usage::CopyTarget => vk::ImageUsageFlags::TRANSFER_DST,
            Usage::ImageWrite | Usage::ImageUpdate => vk::ImageUsageFlags::STORAGE,
            _ => vk::ImageUsageFlags::SAMPLED,
        };
        if access.resource == resource::ACCUMULATED {
            // The picture is read back.
            *flags |= vk::ImageUsageFlags::TRANSFER_SRC;
        }
    }
    let check = |resource: Resource, needed: vk::FormatFeatureFlags, cannot: &str, remedy: &str| {
        let format = resource.format(formats);
        match device.format_supports(format, needed) {
            true => Ok(()),
            false => Err(Error::device(&device.info.name, format!("{cannot} {format:?}"), remedy)),
        }
    };
    let (blend, depth) =
        (vk::FormatFeatureFlags::COLOR_ATTACHMENT_BLEND, vk::FormatFeatureFlags::DEPTH_STENCIL_ATTACHMENT);
    let remedy = "choose another image.accumulate: rgba32f, rgba16f or rgba8";
    check(resource::ACCUMULATED, blend, "cannot blend into", remedy)?;
    let computed = plan.steps.iter().any(|step| matches!(step.work, Work::Pixels(_)));
    if computed {
        check(resource::ACCUMULATED, vk::FormatFeatureFlags::STORAGE_IMAGE, "cannot write in compute shaders", remedy)?;
    }
    if usages.contains_key(&resource::SURFACE_HIT) {
        let remedy = "leave the iso-surface out, whose places rays gather there, or use another device";
        check(resource::SURFACE_HIT, blend, "cannot blend into", remedy)?;
    }
    if usages.contains_key(&resource::STORED) {
        let remedy = "use --depth-format d32 or d16, which every device has";
        check(resource::STORED, depth, "has no depth format", remedy)?;
    }
    let Region { width, height, .. } = plan.view.region;
    usages
        .into_iter()
        .map(|(resource, usage)| {
            let info = ImageInfo {
                name: resource.label(),
                extent: [width, height, 1],
                format: resource.format(formats),
                usage,
                shape: ImageShape::Flat,
                // Both queues write it.
                shared: computed,
            };
            Ok((resource, Image::new(device, info)?))
        })
        .collect()
}

/// Uploads what is made anew for every frame.
fn of_frame(device: &Arc<Device>, scene: &Scene, plan: &Plan) -> Result<HashMap<Resource, DeviceObject>> {
    let facts = plan.facts(scene);
    let builds = plan.builds.iter().filter(|build| build.of_frame());
    builds
        .filter_map(|build| match build.asset.resource.of.origin {
            Origin::Host(bytes) => Some((build, bytes)),
            _ => None,
        })
        .map(|(build, bytes)| {
            let resource = build.asset.resource;
            plan.steps[build.steps.clone()].iter().for_each(|step| device.trace(&step.name));
            Ok((resource, object::filled(device, resource, &facts, &bytes(&facts))?))
        })
        .collect()
}

impl Compiler<'_> {
    fn draw(&mut self, step: &Step, draw: &Draw, info: RenderPassInfo, targets: &[Resource]) -> Result<CompiledDraw> {
        let render_pass = self.resident.pipelines.render_pass(&info)?;
        let framebuffer = self.framebuffer(&render_pass, targets)?;
        let key = PipelineKey {
            render_pass: info,
            vertex: draw.vertex(),
            shader: draw.shader.clone(),
            constants: draw.constants.clone(),
            test: draw.test,
            blend: draw.blend,
            geometry: draw.geometry,
        };
        let pipeline = self.resident.pipelines.pipeline(&key, step.pass_name())?;
        let set = self.set(&key, step, &pipeline)?;
        let kept = self.resident.of_plan(self.plan, draw.vertices).and_then(DeviceObject::buffer);
        self.vertices.extend(kept.map(|buffer| (draw.vertices, buffer.clone())));
        Ok(CompiledDraw {
            clears: vec![vk::ClearValue::default(); targets.len()],
            render_pass,
            framebuffer,
            pipeline,
            set,
            corners: (draw.geometry.range)(self.scene, &self.plan.view, step.pass),
            numbers: (draw.geometry.numbers)(self.scene, step.pass),
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

    fn pixels(&mut self, step: &Step, pixels: &PixelDispatch) -> Result<CompiledPixels> {
        let pipeline = self.resident.pipelines.compute(&pixels.shader, &pixels.constants, step.pass_name())?;
        let set = DescriptorSet::new(self.device, step.pass_name(), &pipeline.layout, &self.bound(step))?;
        Ok(CompiledPixels { pipeline, set })
    }

    fn set(&mut self, key: &PipelineKey, step: &Step, pipeline: &GraphicsPipeline) -> Result<Arc<DescriptorSet>> {
        let by = (key.clone(), step.accesses.clone());
        if let Some(known) = self.sets.get(&by) {
            return Ok(known.clone());
        }
        let made = DescriptorSet::new(self.device, step.pass_name(), &pipeline.layout, &self.bound(step))?;
        let made = Arc::new(made);
        self.sets.insert(by, made.clone());
        Ok(made)
    }

    /// What the shader of a step binds, by the names there.
    fn bound(&self, step: &Step) -> Vec<(&'static str, Bound<'_>)> {
        let mut bound: Vec<(&str, Bound)> = Vec::new();
        for access in step.accesses.iter() {
            let resource = access.resource;
            let layout = access.usage.layout();
            if access.usage == Usage::ColorInput {
                bound.push((resource.name(), Bound::Input(&self.targets[&resource])));
            } else if access.usage.is_storage_image() {
                bound.push((resource.name(), Bound::StorageImage(&self.targets[&resource])));
            } else if !matches!(access.usage, Usage::Sampled | Usage::Placing | Usage::ComputeRead) {
                continue;
            } else if let Some(image) = self.image(resource) {
                let sampler = match (&self.linear, &resource.of.kind) {
                    (Some(linear), ResourceKind::Texture(texture)) if texture.filtered => linear,
                    _ => &self.nearest,
                };
                bound.push((resource.name(), Bound::Sampled(image, sampler, layout)));
            } else if let Some(DeviceObject::Texels(texels)) = self.made(resource) {
                bound.push((resource.name(), Bound::Texels(texels)));
            } else if let Some(buffer) = self.made(resource).and_then(DeviceObject::buffer) {
                let of =
                    if matches!(resource.of.kind, ResourceKind::Uniform(_)) { Bound::Uniform } else { Bound::Storage };
                bound.push((resource.name(), of(buffer)));
            }
        }
        bound
    }

    fn image(&self, resource: Resource) -> Option<&Image> {
        self.targets.get(&resource).or_else(|| self.made(resource).and_then(DeviceObject::image))
    }

    fn made(&self, resource: Resource) -> Option<&DeviceObject> {
        self.own.get(&resource).or_else(|| self.resident.of_plan(self.plan, resource))
    }
}
