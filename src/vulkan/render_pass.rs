//! Render passes of one subpass, as data, and their framebuffers.

use std::sync::Arc;

use ash::vk;

use super::device::Device;
use super::failure::misuse;
use super::format::{has_stencil, is_depth};
use super::image::Image;
use super::owned::{Kept, Owned};
use crate::error::{Error, Result};

/// Stages and what they do to memory.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Scope {
    pub stages: vk::PipelineStageFlags2,
    pub access: vk::AccessFlags2,
}

impl Scope {
    /// Nothing to wait for, or nobody who waits.
    pub const NONE: Self = Self::new(vk::PipelineStageFlags2::NONE, vk::AccessFlags2::NONE);

    pub const fn new(stages: vk::PipelineStageFlags2, access: vk::AccessFlags2) -> Self {
        Self { stages, access }
    }
}

/// What has to have happened, and who waits for it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Dependency {
    pub source: Scope,
    pub target: Scope,
}

/// What an attachment is to the pass.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Role {
    Color,
    /// Drawn into, and each fragment may read what its own pixel held before: an input attachment too. Its layout is
    /// `GENERAL`, the one that allows both.
    ColorInput,
    Depth,
}

impl Role {
    /// Whether fragments write a colour there.
    pub fn is_color(self) -> bool {
        matches!(self, Self::Color | Self::ColorInput)
    }
}

/// An image a pass draws into or tests against.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Attachment {
    pub name: String,
    pub format: vk::Format,
    pub role: Role,
    pub load: vk::AttachmentLoadOp,
    pub store: vk::AttachmentStoreOp,
    /// The layout it is in when the pass begins.
    pub before: vk::ImageLayout,
    pub during: vk::ImageLayout,
    /// The layout the pass leaves it in.
    pub after: vk::ImageLayout,
}

/// A pass of one subpass: at most one depth attachment, colour attachments in the order of their locations, input
/// attachments in the order of their indices.
///
/// Fragments of a pass must not cover each other where they read an input attachment: nothing orders one's read and
/// another's write, while a fragment's own read comes before its write.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct RenderPassInfo {
    pub name: String,
    pub attachments: Vec<Attachment>,
    /// From what came before the pass to the pass.
    pub before: Dependency,
    /// From the pass to what comes after it.
    pub after: Dependency,
}

pub struct RenderPass {
    pub info: RenderPassInfo,
    pub(super) owned: Arc<Owned<vk::RenderPass>>,
}

impl RenderPass {
    /// # Errors
    /// Two depth attachments, a role that does not fit its format, too many colour attachments.
    pub fn new(device: &Arc<Device>, info: RenderPassInfo) -> Result<Self> {
        check(device, &info)?;
        let references = |roles: &[Role]| -> Vec<_> {
            let all = info.attachments.iter().enumerate().filter(|(_, one)| roles.contains(&one.role));
            let reference = |(index, one): (usize, &Attachment)| {
                // The aspect counts for input attachments only.
                let aspect = vk::ImageAspectFlags::COLOR;
                vk::AttachmentReference2::default().attachment(index as u32).layout(one.during).aspect_mask(aspect)
            };
            all.map(reference).collect()
        };
        let color = references(&[Role::Color, Role::ColorInput]);
        let (input, depth) = (references(&[Role::ColorInput]), references(&[Role::Depth]));
        let mut subpass = vk::SubpassDescription2::default()
            .pipeline_bind_point(vk::PipelineBindPoint::GRAPHICS)
            .input_attachments(&input)
            .color_attachments(&color);
        if let Some(depth) = depth.first() {
            subpass = subpass.depth_stencil_attachment(depth);
        }
        let attachments: Vec<_> = info
            .attachments
            .iter()
            .map(|one| {
                let stencil = if has_stencil(one.format) {
                    (one.load, one.store)
                } else {
                    (vk::AttachmentLoadOp::DONT_CARE, vk::AttachmentStoreOp::DONT_CARE)
                };
                vk::AttachmentDescription2::default()
                    .format(one.format)
                    .samples(vk::SampleCountFlags::TYPE_1)
                    .load_op(one.load)
                    .store_op(one.store)
                    .stencil_load_op(stencil.0)
                    .stencil_store_op(stencil.1)
                    .initial_layout(one.before)
                    .final_layout(one.after)
            })
            .collect();
        // Masks of 64 bits do not fit the old structure; it takes them from the barrier in its chain.
        let mut barriers = [info.before, info.after].map(memory_barrier);
        let mut subpasses = [(vk::SUBPASS_EXTERNAL, 0), (0, vk::SUBPASS_EXTERNAL)].into_iter();
        let dependencies: Vec<_> = barriers
            .iter_mut()
            .zip(subpasses.by_ref())
            .map(|(barrier, (source, target))| {
                vk::SubpassDependency2::default().src_subpass(source).dst_subpass(target).push_next(barrier)
            })
            .collect();
        let subpasses = [subpass];
        let create = vk::RenderPassCreateInfo2::default()
            .attachments(&attachments)
            .subpasses(&subpasses)
            .dependencies(&dependencies);
        // SAFETY: everything `create` points to is alive; references were made from the attachments' own indices.
        let raw = unsafe { device.raw.create_render_pass2(&create, None) };
        let raw = device.check("vkCreateRenderPass2", &info.name, raw)?;
        device.name(raw, &info.name);
        // SAFETY of the destroyer: called once, when nothing uses the render pass any more.
        let owned = Owned::new(device, raw, |device, raw| unsafe { device.destroy_render_pass(raw, None) });
        Ok(Self { info, owned })
    }
}

fn memory_barrier(dependency: Dependency) -> vk::MemoryBarrier2<'static> {
    vk::MemoryBarrier2::default()
        .src_stage_mask(dependency.source.stages)
        .src_access_mask(dependency.source.access)
        .dst_stage_mask(dependency.target.stages)
        .dst_access_mask(dependency.target.access)
}

fn check(device: &Device, info: &RenderPassInfo) -> Result<()> {
    let count = |role| info.attachments.iter().filter(|one| one.role == role).count();
    if count(Role::Depth) > 1 {
        return Err(misuse(&info.name, "has more than one depth attachment"));
    }
    let limits = &device.limits;
    let (input, color) = (count(Role::ColorInput), count(Role::ColorInput) + count(Role::Color));
    for (what, found, limit) in [
        ("colour attachments", color, limits.max_color_attachments),
        ("input attachments", input, limits.max_per_stage_descriptor_input_attachments),
    ] {
        if found > limit as usize {
            let problem = format!("{found} {what}, {} allows {limit}", device.info.name);
            return Err(Error::device(&info.name, problem, "choose another device"));
        }
    }
    let general = |one: &&Attachment| one.during == vk::ImageLayout::GENERAL;
    if let Some(one) = info.attachments.iter().filter(|one| one.role == Role::ColorInput).find(|one| !general(one)) {
        return Err(misuse(
            &info.name,
            format!("{} is drawn into and read in {:?}, not GENERAL", one.name, one.during),
        ));
    }
    match info.attachments.iter().find(|one| is_depth(one.format) != (one.role == Role::Depth)) {
        Some(one) => Err(misuse(&info.name, format!("{} is {:?} but has role {:?}", one.name, one.format, one.role))),
        None => Ok(()),
    }
}

/// The images of a render pass, in the order of its attachments.
pub struct Framebuffer {
    pub name: String,
    /// Pixels, width and height.
    pub extent: [u32; 2],
    pub(super) owned: Arc<Owned<vk::Framebuffer>>,
    pub(super) images: Vec<Kept>,
}

impl Framebuffer {
    /// `extent` is in pixels and no larger than any of the images; a pass without attachments needs it too.
    ///
    /// # Errors
    /// Images that do not match the attachments in number, format or size.
    pub fn new(
        device: &Arc<Device>,
        name: &str,
        pass: &RenderPass,
        images: &[&Image],
        extent: [u32; 2],
    ) -> Result<Self> {
        let attachments = &pass.info.attachments;
        if images.len() != attachments.len() {
            let problem =
                format!("{} images for {} attachments of {}", images.len(), attachments.len(), pass.info.name);
            return Err(misuse(name, problem));
        }
        for (image, attachment) in images.iter().zip(attachments) {
            let [width, height, depth] = image.info.extent;
            if image.info.format != attachment.format || depth != 1 || width < extent[0] || height < extent[1] {
                let problem = format!(
                    "{} ({:?}, {width} x {height} x {depth}) does not fit attachment {} ({:?}, {} x {})",
                    image.info.name, image.info.format, attachment.name, attachment.format, extent[0], extent[1]
                );
                return Err(misuse(name, problem));
            }
        }
        let most = [device.limits.max_framebuffer_width, device.limits.max_framebuffer_height];
        if extent.contains(&0) || extent[0] > most[0] || extent[1] > most[1] {
            let [width, height] = extent;
            let problem = format!("{width} x {height} pixels, {} allows {} x {}", device.info.name, most[0], most[1]);
            return Err(Error::device(name, problem, "use another viewport"));
        }
        let views: Vec<_> = images.iter().map(|image| image.view()).collect();
        let create = vk::FramebufferCreateInfo::default()
            .render_pass(pass.owned.raw)
            .attachments(&views)
            .width(extent[0])
            .height(extent[1])
            .layers(1);
        // SAFETY: the views are alive and kept by the framebuffer; they match the render pass.
        let raw = unsafe { device.raw.create_framebuffer(&create, None) };
        let raw = device.check("vkCreateFramebuffer", name, raw)?;
        device.name(raw, name);
        // SAFETY of the destroyer: called once, when nothing uses the framebuffer any more.
        let owned = Owned::new(device, raw, |device, raw| unsafe { device.destroy_framebuffer(raw, None) });
        let images = images.iter().map(|image| image.inner.clone() as Kept).collect();
        Ok(Self { name: name.into(), extent, owned, images })
    }
}
