//! The pipelines that cases are drawn with, made when they are first asked for.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};

use ash::vk;

use super::case::{Case, Mechanism};
use crate::error::Result;
use crate::glsl::{self, Shader};
use crate::vulkan::{Blend, DepthState, Device, GraphicsPipeline, GraphicsPipelineInfo, RenderPass, ShaderModule};

/// Pipelines of one format, whatever the size of the picture: drivers take long for one.
pub struct CasePipelines {
    device: Arc<Device>,
    vertex: ShaderModule,
    /// By case; none for the draw that fills.
    made: Mutex<HashMap<Option<Case>, Arc<GraphicsPipeline>>>,
}

impl CasePipelines {
    /// # Errors
    /// A shader that does not compile.
    pub fn new(device: &Arc<Device>) -> Result<Self> {
        Ok(Self { device: device.clone(), vertex: compiled(&vertex())?, made: Mutex::default() })
    }

    /// The pipeline of a case, or of the draw that fills, for passes like this one.
    ///
    /// # Errors
    /// What the driver reports.
    pub fn of(&self, case: Option<&Case>, pass: &RenderPass) -> Result<Arc<GraphicsPipeline>> {
        let mut pipelines = self.made.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(known) = pipelines.get(&case.copied()) {
            return Ok(known.clone());
        }
        let made = match case {
            Some(case) => {
                let mechanism = case.mechanism;
                let stencil = (mechanism == Mechanism::Stencil).then_some(1);
                let depth = DepthState {
                    test: mechanism != Mechanism::BoundsAlone,
                    write: mechanism.writes_depth(),
                    compare: if mechanism.compares() { case.compare.op() } else { vk::CompareOp::ALWAYS },
                    bounds: mechanism.bounds(),
                };
                self.make(&case.name(), &case.fragment(), pass, depth, stencil)?
            }
            None => {
                let depth = DepthState { test: true, write: true, ..DepthState::OFF };
                self.make("probe fill", &fill(), pass, depth, None)?
            }
        };
        pipelines.insert(case.copied(), made.clone());
        Ok(made)
    }

    fn make(
        &self,
        name: &str,
        fragment: &Shader,
        render_pass: &RenderPass,
        depth: DepthState,
        stencil: Option<u8>,
    ) -> Result<Arc<GraphicsPipeline>> {
        let fragment = compiled(fragment)?;
        let info = GraphicsPipelineInfo {
            name,
            vertex: &self.vertex,
            fragment: Some(&fragment),
            constants: &[],
            render_pass,
            vertex_format: None,
            front_only: false,
            depth,
            stencil,
            blend: Blend::Replace,
        };
        Ok(Arc::new(GraphicsPipeline::new(&self.device, &info)?))
    }
}

fn vertex() -> Shader {
    Shader::new("probe/probe.vert", [])
}

/// What writes depths before a case is drawn.
fn fill() -> Shader {
    Shader::new("probe/fill.frag", [])
}

/// Everything that drawing these cases compiles.
pub fn shaders(cases: &[Case]) -> Vec<Shader> {
    cases.iter().map(Case::fragment).chain([vertex(), fill()]).collect()
}

fn compiled(shader: &Shader) -> Result<ShaderModule> {
    ShaderModule::new(&shader.to_string(), &glsl::module(shader)?)
}
