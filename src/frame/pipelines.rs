//! Render passes and pipelines that stay on the device while frames change: a driver takes tens of milliseconds for a
//! pipeline, and another view of a scene draws with the same ones.

use std::collections::HashMap;
use std::sync::Arc;

use ash::vk;

use crate::error::Result;
use crate::glsl;
use crate::part::{Constant, DepthTest};
use crate::vulkan::{
    Blend, ComputePipeline, DepthState, Device, GraphicsPipeline, GraphicsPipelineInfo, RenderPass, RenderPassInfo,
    Shader,
};

/// Steps that agree in all of this share one pipeline.
#[derive(Clone, PartialEq, Eq, Hash)]
pub struct PipelineKey {
    pub render_pass: RenderPassInfo,
    pub shader: Option<Arc<str>>,
    pub constants: Arc<Vec<Constant>>,
    pub test: DepthTest,
    pub blend: bool,
}

/// Made when first asked for.
pub struct Pipelines {
    device: Arc<Device>,
    shaders: HashMap<String, Arc<Shader>>,
    render_passes: HashMap<RenderPassInfo, Arc<RenderPass>>,
    pipelines: HashMap<PipelineKey, Arc<GraphicsPipeline>>,
    compute: HashMap<ComputeKey, Arc<ComputePipeline>>,
}

/// Shader and specialization constants.
type ComputeKey = (String, Vec<(&'static str, u32)>);

impl Pipelines {
    pub fn new(device: &Arc<Device>) -> Self {
        Self {
            device: device.clone(),
            shaders: HashMap::new(),
            render_passes: HashMap::new(),
            pipelines: HashMap::new(),
            compute: HashMap::new(),
        }
    }

    /// # Errors
    /// As [`RenderPass::new`].
    pub fn render_pass(&mut self, info: &RenderPassInfo) -> Result<Arc<RenderPass>> {
        if let Some(known) = self.render_passes.get(info) {
            return Ok(known.clone());
        }
        let made = Arc::new(RenderPass::new(&self.device, info.clone())?);
        self.render_passes.insert(info.clone(), made.clone());
        Ok(made)
    }

    /// The pipeline for `key`; `name` is the pass it was first made for.
    ///
    /// # Errors
    /// When there is no such shader, or the driver refuses it.
    pub fn pipeline(&mut self, key: &PipelineKey, name: &str) -> Result<Arc<GraphicsPipeline>> {
        if let Some(known) = self.pipelines.get(key) {
            return Ok(known.clone());
        }
        let render_pass = self.render_pass(&key.render_pass)?;
        let vertex = self.shader("box.vert")?;
        let fragment = key.shader.as_deref().map(|name| self.shader(name)).transpose()?;
        // Constants that a variant has no use for are gone from its SPIR-V.
        let known = |name: &str| fragment.iter().any(|f| f.spec_constants.iter().any(|(n, _)| n == name));
        let constants: Vec<(&str, u32)> = key.constants.iter().copied().filter(|(name, _)| known(name)).collect();
        let made = Arc::new(GraphicsPipeline::new(
            &self.device,
            &GraphicsPipelineInfo {
                name,
                vertex: &vertex,
                fragment: fragment.as_deref(),
                constants: &constants,
                render_pass: &render_pass,
                vertex_format: Some(vk::Format::R32G32B32_SFLOAT),
                depth: DepthState {
                    test: key.test.compare.is_some(),
                    write: key.test.write,
                    compare: key.test.compare.unwrap_or(vk::CompareOp::ALWAYS),
                    bounds: key.test.bounds,
                },
                stencil: None,
                blend: if key.blend { Blend::Over } else { Blend::Replace },
            },
        )?);
        self.pipelines.insert(key.clone(), made.clone());
        Ok(made)
    }

    /// The compute pipeline of `shader`; `name` is the step it was first made for.
    ///
    /// # Errors
    /// As [`Pipelines::pipeline`].
    pub fn compute(
        &mut self,
        shader: &str,
        constants: &[(&'static str, u32)],
        name: &str,
    ) -> Result<Arc<ComputePipeline>> {
        let key = (shader.to_owned(), constants.to_vec());
        if let Some(known) = self.compute.get(&key) {
            return Ok(known.clone());
        }
        let module = self.shader(shader)?;
        // As above.
        let known = |name: &str| module.spec_constants.iter().any(|(n, _)| n == name);
        let constants: Vec<(&str, u32)> = constants.iter().copied().filter(|(name, _)| known(name)).collect();
        let made = Arc::new(ComputePipeline::new(&self.device, name, &module, &constants)?);
        self.compute.insert(key, made.clone());
        Ok(made)
    }

    fn shader(&mut self, name: &str) -> Result<Arc<Shader>> {
        if let Some(known) = self.shaders.get(name) {
            return Ok(known.clone());
        }
        let made = Arc::new(Shader::new(name, &glsl::module(name)?)?);
        self.shaders.insert(name.to_owned(), made.clone());
        Ok(made)
    }
}
