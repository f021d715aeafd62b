//! ShaderModule modules and their specialization, needed only while a pipeline is made.

use std::ffi::CString;

use ash::vk;

use super::device::{Device, c_text};
use super::failure::misuse;
use super::shader::ShaderModule;
use crate::error::Result;

/// The stages of a pipeline, each in the order it was given.
pub(super) struct Stages<'a> {
    device: &'a Device,
    stages: Vec<Stage>,
    /// Values of the specialization constants, four bytes each, shared by all stages.
    values: Vec<u8>,
}

struct Stage {
    kind: vk::ShaderStageFlags,
    module: vk::ShaderModule,
    entry_point: CString,
    constants: Vec<vk::SpecializationMapEntry>,
}

impl<'a> Stages<'a> {
    /// # Errors
    /// A constant that no shader has.
    pub fn new(device: &'a Device, name: &str, shaders: &[&ShaderModule], constants: &[(&str, u32)]) -> Result<Self> {
        let known = || shaders.iter().flat_map(|shader| &shader.spec_constants).map(|(name, _)| name.as_str());
        if let Some((unknown, _)) = constants.iter().find(|(wanted, _)| !known().any(|name| name == *wanted)) {
            let names: Vec<_> = known().collect();
            let problem = format!("no shader has a constant {unknown:?} (there are: {})", names.join(", "));
            return Err(misuse(name, problem));
        }
        let values = constants.iter().flat_map(|(_, bits)| bits.to_ne_bytes()).collect();
        let mut made = Self { device, stages: Vec::new(), values };
        for shader in shaders {
            let create = vk::ShaderModuleCreateInfo::default().code(&shader.words);
            // SAFETY: the words are SPIR-V, they were parsed when the shader was made.
            let module = unsafe { device.raw.create_shader_module(&create, None) };
            let module = device.check("vkCreateShaderModule", &shader.name, module)?;
            device.name(module, &shader.name);
            made.stages.push(Stage {
                kind: shader.stage,
                module,
                entry_point: c_text(&shader.entry_point),
                constants: entries(shader, constants),
            });
        }
        Ok(made)
    }

    pub fn specializations(&self) -> Vec<vk::SpecializationInfo<'_>> {
        let info = vk::SpecializationInfo::default().data(&self.values);
        self.stages.iter().map(|stage| info.map_entries(&stage.constants)).collect()
    }

    pub fn infos<'b>(
        &'b self,
        specializations: &'b [vk::SpecializationInfo<'b>],
    ) -> Vec<vk::PipelineShaderStageCreateInfo<'b>> {
        let info = |(stage, constants): (&'b Stage, &'b vk::SpecializationInfo<'b>)| {
            vk::PipelineShaderStageCreateInfo::default()
                .stage(stage.kind)
                .module(stage.module)
                .name(&stage.entry_point)
                .specialization_info(constants)
        };
        self.stages.iter().zip(specializations).map(info).collect()
    }
}

impl Drop for Stages<'_> {
    fn drop(&mut self) {
        for stage in &self.stages {
            // SAFETY: a pipeline does not need its modules once it is made.
            unsafe { self.device.raw.destroy_shader_module(stage.module, None) };
        }
    }
}

/// Where the shader's constants stand among the values.
fn entries(shader: &ShaderModule, constants: &[(&str, u32)]) -> Vec<vk::SpecializationMapEntry> {
    let mut entries = Vec::new();
    for (index, (wanted, _)) in constants.iter().enumerate() {
        let ids = shader.spec_constants.iter().filter(|(name, _)| name == wanted).map(|(_, id)| *id);
        entries.extend(
            ids.map(|id| vk::SpecializationMapEntry::default().constant_id(id).offset(4 * index as u32).size(4)),
        );
    }
    entries
}
