//! Render passes and pipelines that stay on the device while frames change: a driver takes tens of milliseconds for a
//! pipeline, and another view of a scene draws with the same ones.

use std::collections::HashMap;
use std::sync::Arc;

use ash::vk;

use crate::error::{Error, Result};
use crate::glsl;
use crate::part::geometry::Geometry;
use crate::part::{Constant, DepthTest, Step};
use crate::vulkan::{
    Blend, ComputePipeline, DepthState, Device, GraphicsPipeline, GraphicsPipelineInfo, RenderPass, RenderPassInfo,
    ShaderModule,
};

/// Steps that agree in all of this share one pipeline.
#[derive(Clone, PartialEq, Eq, Hash)]
pub struct PipelineKey {
    pub render_pass: RenderPassInfo,
    pub vertex: glsl::Shader,
    pub shader: Option<Arc<glsl::Shader>>,
    pub constants: Arc<Vec<Constant>>,
    pub test: DepthTest,
    pub blend: Blend,
    pub geometry: &'static Geometry,
}

/// Made when first asked for.
pub struct Pipelines {
    device: Arc<Device>,
    shaders: HashMap<glsl::Shader, Arc<ShaderModule>>,
    render_passes: HashMap<RenderPassInfo, Arc<RenderPass>>,
    pipelines: HashMap<PipelineKey, Arc<GraphicsPipeline>>,
    compute: HashMap<ComputeKey, Arc<ComputePipeline>>,
}

/// ShaderModule and specialization constants.
type ComputeKey = (Arc<glsl::Shader>, Vec<Constant>);

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
        let vertex = self.shader(&key.vertex)?;
        let fragment = key.shader.as_deref().map(|shader| self.shader(shader)).transpose()?;
        let constants = match (&key.shader, &fragment) {
            (Some(shader), Some(fragment)) => present(shader, fragment, &key.constants)?,
            _ => Vec::new(),
        };
        let made = Arc::new(GraphicsPipeline::new(
            &self.device,
            &GraphicsPipelineInfo {
                name,
                vertex: &vertex,
                fragment: fragment.as_deref(),
                constants: &constants,
                render_pass: &render_pass,
                vertex_format: Some(key.geometry.corner),
                front_only: key.geometry.front_only,
                depth: DepthState {
                    test: key.test.compare.is_some(),
                    write: key.test.write,
                    compare: key.test.compare.unwrap_or(vk::CompareOp::ALWAYS),
                    bounds: key.test.bounds,
                },
                stencil: None,
                blend: key.blend,
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
        shader: &Arc<glsl::Shader>,
        constants: &[Constant],
        name: &str,
    ) -> Result<Arc<ComputePipeline>> {
        let key = (shader.clone(), constants.to_vec());
        if let Some(known) = self.compute.get(&key) {
            return Ok(known.clone());
        }
        let module = self.shader(shader)?;
        let constants = present(shader, &module, constants)?;
        let made = Arc::new(ComputePipeline::new(&self.device, name, &module, &constants)?);
        self.compute.insert(key, made.clone());
        Ok(made)
    }

    /// Compiles the shaders of these steps that are not here yet, side by side.
    ///
    /// # Errors
    /// A shader that does not compile.
    pub fn prepare<'a>(&self, steps: impl IntoIterator<Item = &'a Step>) -> Result<()> {
        let mut asked: Vec<glsl::Shader> = Vec::new();
        for step in steps {
            asked.extend(step.work.shader().map(|shader| glsl::Shader::clone(shader)));
            asked.extend(step.work.vertex());
        }
        glsl::prepare(asked.iter().filter(|shader| !self.shaders.contains_key(shader)))
    }

    fn shader(&mut self, shader: &glsl::Shader) -> Result<Arc<ShaderModule>> {
        if let Some(known) = self.shaders.get(shader) {
            return Ok(known.clone());
        }
        let made = Arc::new(ShaderModule::new(&shader.to_string(), &glsl::module(shader)?)?);
        self.shaders.insert(shader.clone(), made.clone());
        Ok(made)
    }
}

/// The constants that a module has. Those it has no use for are gone from its SPIR-V; one that its file declares for no
/// set of defines is misspelt.
fn present(shader: &glsl::Shader, module: &ShaderModule, constants: &[Constant]) -> Result<Vec<Constant>> {
    let has = |name: &str| module.spec_constants.iter().any(|(n, _)| n == name);
    let (present, absent): (Vec<Constant>, Vec<Constant>) = constants.iter().partition(|(name, _)| has(name));
    for (name, _) in absent {
        if !glsl::declares(shader.file, name)? {
            return Err(Error::input(
                format!("shader {}", shader.file),
                format!("declares no specialization constant {name}"),
                format!("declare it as `layout(constant_id = ...) const ... {name}`, which the program sets"),
            ));
        }
    }
    Ok(present)
}
