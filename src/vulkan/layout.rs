//! What a pipeline binds: descriptor set 0 and push constants, merged from its shaders.

use std::sync::Arc;

use ash::vk;

use super::device::Device;
use super::failure::misuse;
use super::owned::Owned;
use super::reflect::Binding;
use super::shader::ShaderModule;
use crate::error::{Error, Result};

/// The layout of a pipeline.
pub struct Layout {
    pub name: String,
    /// Of descriptor set 0, sorted by binding.
    pub bindings: Vec<Binding>,
    /// Bytes of the largest push constant block of the stages.
    pub push_constants: u32,
    /// All stages; each sees the push constants and every binding, but for input attachments, which only fragments have.
    pub stages: vk::ShaderStageFlags,
    pub(super) set: Arc<Owned<vk::DescriptorSetLayout>>,
    pub(super) owned: Arc<Owned<vk::PipelineLayout>>,
}

impl Layout {
    pub(super) fn new(device: &Arc<Device>, name: &str, shaders: &[&ShaderModule]) -> Result<Arc<Self>> {
        let bindings = merge(name, shaders)?;
        let stages = shaders.iter().fold(vk::ShaderStageFlags::empty(), |all, shader| all | shader.stage);
        let push_constants = shaders.iter().map(|shader| shader.push_constants).max().unwrap_or(0);
        let limit = device.limits.max_push_constants_size;
        if push_constants > limit {
            let problem = format!("{push_constants} bytes of push constants, {} allows {limit}", device.info.name);
            return Err(Error::device(name, problem, "choose another device"));
        }
        let described: Vec<_> = bindings
            .iter()
            .map(|one| {
                vk::DescriptorSetLayoutBinding::default()
                    .binding(one.binding)
                    .descriptor_type(one.kind)
                    .descriptor_count(one.count)
                    .stage_flags(match one.kind {
                        vk::DescriptorType::INPUT_ATTACHMENT => stages & vk::ShaderStageFlags::FRAGMENT,
                        _ => stages,
                    })
            })
            .collect();
        let create = vk::DescriptorSetLayoutCreateInfo::default().bindings(&described);
        // SAFETY: the device is alive, here and below; handles are of this device.
        let raw = unsafe { device.raw.create_descriptor_set_layout(&create, None) };
        let raw = device.check("vkCreateDescriptorSetLayout", name, raw)?;
        device.name(raw, name);
        // SAFETY of the destroyers: called once, when nothing uses the layouts any more.
        let set = Owned::new(device, raw, |device, raw| unsafe { device.destroy_descriptor_set_layout(raw, None) });

        let sets = [set.raw];
        let ranges = [vk::PushConstantRange::default().stage_flags(stages).size(push_constants)];
        let mut create = vk::PipelineLayoutCreateInfo::default().set_layouts(&sets);
        if push_constants > 0 {
            create = create.push_constant_ranges(&ranges);
        }
        let raw = unsafe { device.raw.create_pipeline_layout(&create, None) };
        let raw = device.check("vkCreatePipelineLayout", name, raw)?;
        device.name(raw, name);
        let owned = Owned::new(device, raw, |device, raw| unsafe { device.destroy_pipeline_layout(raw, None) });
        Ok(Arc::new(Self { name: name.into(), bindings, push_constants, stages, set, owned }))
    }
}

/// The bindings of all stages; one that several declare must be the same in each.
fn merge(name: &str, shaders: &[&ShaderModule]) -> Result<Vec<Binding>> {
    let mut merged: Vec<Binding> = Vec::new();
    for shader in shaders {
        for one in &shader.bindings {
            if one.set != 0 {
                return Err(misuse(
                    name,
                    format!("{} of {} is in set {}, only 0 is used", one.name, shader.name, one.set),
                ));
            }
            match merged.iter().find(|other| other.binding == one.binding || other.name == one.name) {
                None => merged.push(one.clone()),
                Some(other) if other == one => {}
                Some(other) => {
                    return Err(misuse(
                        name,
                        format!(
                            "{} declares {} ({:?} x {}) at binding {}, another stage {} ({:?} x {}) at {}",
                            shader.name,
                            one.name,
                            one.kind,
                            one.count,
                            one.binding,
                            other.name,
                            other.kind,
                            other.count,
                            other.binding
                        ),
                    ));
                }
            }
        }
    }
    merged.sort_by_key(|one| one.binding);
    Ok(merged)
}
