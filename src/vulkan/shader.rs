//! Shaders: SPIR-V and what it says about itself.

use ash::vk;

use super::reflect::{Binding, Reflection, reflect};
use crate::error::Result;

/// A SPIR-V module with one entry point.
#[derive(Clone, Debug)]
pub struct ShaderModule {
    pub name: String,
    pub stage: vk::ShaderStageFlags,
    /// Sorted by set and binding.
    pub bindings: Vec<Binding>,
    /// Bytes of the push constant block, 0 without one.
    pub push_constants: u32,
    /// By the names of the specification, with their numbers: `EarlyFragmentTests`, `LocalSize 8 8 1`.
    pub execution_modes: Vec<String>,
    /// Name and id of each specialization constant.
    pub spec_constants: Vec<(String, u32)>,
    pub(super) entry_point: String,
    pub(super) words: Vec<u32>,
}

impl ShaderModule {
    /// Reads the SPIR-V of a vertex, fragment or compute shader. Names come from its debug information.
    ///
    /// # Errors
    /// Words that are no such shader, or a kind of resource that this program does not bind.
    pub fn new(name: &str, words: &[u32]) -> Result<Self> {
        let Reflection { stage, entry_point, bindings, push_constants, execution_modes, spec_constants } =
            reflect(name, words)?;
        Ok(Self {
            name: name.into(),
            stage,
            bindings,
            push_constants,
            execution_modes,
            spec_constants,
            entry_point,
            words: words.to_vec(),
        })
    }
}
