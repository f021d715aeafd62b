//! Descriptor sets, bound by the names the shaders use.

use std::sync::Arc;

use ash::vk;

use super::buffer::Buffer;
use super::device::Device;
use super::failure::misuse;
use super::image::{Image, Sampler};
use super::layout::Layout;
use super::owned::{Kept, Owned};
use super::reflect::Binding;
use super::texel_buffer::TexelBuffer;
use crate::error::Result;

/// What a binding is given.
#[derive(Clone, Copy)]
pub enum Bound<'a> {
    /// An image read through a sampler, in the layout it has then.
    Sampled(&'a Image, &'a Sampler, vk::ImageLayout),
    Storage(&'a Buffer),
    Uniform(&'a Buffer),
    Texels(&'a TexelBuffer),
    /// An image read and written texel by texel, in layout `GENERAL`.
    StorageImage(&'a Image),
    /// An attachment of the pass of which a fragment reads its own pixel, in layout `GENERAL`.
    Input(&'a Image),
}

/// A descriptor set in a pool of its own. Keeps its resources alive.
pub struct DescriptorSet {
    pub name: String,
    pub(super) bindings: Vec<Binding>,
    pub(super) stages: vk::ShaderStageFlags,
    /// `None` for a layout without bindings.
    pub(super) set: Option<(vk::DescriptorSet, Arc<Owned<vk::DescriptorPool>>)>,
    pub(super) resources: Vec<Kept>,
}

impl DescriptorSet {
    /// Writes every binding of `layout`: a driver crashes on a set with an unwritten one, used or not. An array
    /// takes all resources of its name, in their order; names the shaders do not have are ignored.
    ///
    /// # Errors
    /// A binding without resource, of another kind, or with another number of them.
    pub fn new(device: &Arc<Device>, name: &str, layout: &Layout, resources: &[(&str, Bound<'_>)]) -> Result<Self> {
        let mut made = Self {
            name: name.into(),
            bindings: layout.bindings.clone(),
            stages: layout.stages,
            set: None,
            resources: Vec::new(),
        };
        if layout.bindings.is_empty() {
            return Ok(made);
        }
        let mut images = Vec::new();
        let mut buffers = Vec::new();
        let mut views = Vec::new();
        for binding in &layout.bindings {
            let given: Vec<_> = resources.iter().filter(|(name, _)| *name == binding.name).collect();
            if given.len() != binding.count as usize {
                let names: Vec<_> = resources.iter().map(|(name, _)| *name).collect();
                return Err(misuse(
                    name,
                    format!(
                        "{} takes {} resources, {} of that name are given (all: {})",
                        binding.name,
                        binding.count,
                        given.len(),
                        names.join(", ")
                    ),
                ));
            }
            let mut image_infos = Vec::new();
            let mut buffer_infos = Vec::new();
            let mut texel_views = Vec::new();
            for (_, resource) in given {
                if resource.kind() != binding.kind {
                    let problem = format!("{} is {:?}, {:?} is given", binding.name, binding.kind, resource.kind());
                    return Err(misuse(name, problem));
                }
                image_infos.extend(resource.image_info());
                buffer_infos.extend(resource.buffer_info());
                texel_views.extend(resource.texel_view());
                resource.keep(&mut made.resources);
            }
            images.push(image_infos);
            buffers.push(buffer_infos);
            views.push(texel_views);
        }

        let pool = pool(device, name, &layout.bindings)?;
        let layouts = [layout.set.raw];
        let allocate = vk::DescriptorSetAllocateInfo::default().descriptor_pool(pool.raw).set_layouts(&layouts);
        // SAFETY: the pool was made for this one set and is locked to this thread.
        let set = unsafe { device.raw.allocate_descriptor_sets(&allocate) };
        let set = device.check("vkAllocateDescriptorSets", name, set)?[0];
        device.name(set, name);
        let writes: Vec<_> = layout
            .bindings
            .iter()
            .zip(images.iter().zip(&buffers).zip(&views))
            .map(|(binding, ((images, buffers), views))| {
                let mut write = vk::WriteDescriptorSet::default()
                    .dst_set(set)
                    .dst_binding(binding.binding)
                    .descriptor_type(binding.kind)
                    .image_info(images)
                    .buffer_info(buffers)
                    .texel_buffer_view(views);
                write.descriptor_count = binding.count;
                write
            })
            .collect();
        // SAFETY: the set is new and not in use; each write has as many infos as its binding has elements, and
        // their resources are kept alive by the set.
        unsafe { device.raw.update_descriptor_sets(&writes, &[]) };
        made.set = Some((set, pool));
        Ok(made)
    }

    /// Whether a pipeline of that layout can use this set.
    pub(super) fn fits(&self, layout: &Layout) -> bool {
        self.bindings == layout.bindings && self.stages == layout.stages
    }
}

impl Bound<'_> {
    fn kind(&self) -> vk::DescriptorType {
        match self {
            Bound::Sampled(..) => vk::DescriptorType::COMBINED_IMAGE_SAMPLER,
            Bound::Storage(_) => vk::DescriptorType::STORAGE_BUFFER,
            Bound::Uniform(_) => vk::DescriptorType::UNIFORM_BUFFER,
            Bound::Texels(_) => vk::DescriptorType::UNIFORM_TEXEL_BUFFER,
            Bound::StorageImage(_) => vk::DescriptorType::STORAGE_IMAGE,
            Bound::Input(_) => vk::DescriptorType::INPUT_ATTACHMENT,
        }
    }

    fn image_info(&self) -> Option<vk::DescriptorImageInfo> {
        let info = vk::DescriptorImageInfo::default();
        match self {
            Bound::Sampled(image, sampler, layout) => {
                Some(info.image_view(image.view()).sampler(sampler.owned.raw).image_layout(*layout))
            }
            Bound::StorageImage(image) | Bound::Input(image) => {
                Some(info.image_view(image.view()).image_layout(vk::ImageLayout::GENERAL))
            }
            Bound::Storage(_) | Bound::Uniform(_) | Bound::Texels(_) => None,
        }
    }

    fn buffer_info(&self) -> Option<vk::DescriptorBufferInfo> {
        match self {
            Bound::Storage(buffer) | Bound::Uniform(buffer) => {
                Some(vk::DescriptorBufferInfo::default().buffer(buffer.handle()).range(buffer.info.size))
            }
            Bound::Sampled(..) | Bound::StorageImage(_) | Bound::Input(_) | Bound::Texels(_) => None,
        }
    }

    fn texel_view(&self) -> Option<vk::BufferView> {
        match self {
            Bound::Texels(texels) => Some(texels.view.raw),
            _ => None,
        }
    }

    fn keep(&self, kept: &mut Vec<Kept>) {
        match self {
            Bound::Sampled(image, sampler, _) => {
                kept.push(image.inner.clone());
                kept.push(sampler.owned.clone());
            }
            Bound::StorageImage(image) | Bound::Input(image) => kept.push(image.inner.clone()),
            Bound::Storage(buffer) | Bound::Uniform(buffer) => kept.push(buffer.inner.clone()),
            Bound::Texels(texels) => {
                kept.push(texels.view.clone());
                kept.push(texels.buffer.inner.clone());
            }
        }
    }
}

fn pool(device: &Arc<Device>, name: &str, bindings: &[Binding]) -> Result<Arc<Owned<vk::DescriptorPool>>> {
    let size = |one: &Binding| vk::DescriptorPoolSize::default().ty(one.kind).descriptor_count(one.count);
    let sizes: Vec<_> = bindings.iter().map(size).collect();
    let create = vk::DescriptorPoolCreateInfo::default().max_sets(1).pool_sizes(&sizes);
    // SAFETY: the device is alive.
    let raw = unsafe { device.raw.create_descriptor_pool(&create, None) };
    let raw = device.check("vkCreateDescriptorPool", name, raw)?;
    device.name(raw, name);
    // SAFETY of the destroyer: called once, when nothing uses the set any more; it goes with its pool.
    Ok(Owned::new(device, raw, |device, raw| unsafe { device.destroy_descriptor_pool(raw, None) }))
}
