//! Shaders: SPIR-V and what it says about itself.

use ash::vk;

use super::reflect::{Reflection, reflect};
use crate::error::Result;

/// A resource a shader declares.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Binding {
    /// The variable's name, or its block's where the block has no instance name.
    pub name: String,
    pub set: u32,
    pub binding: u32,
    pub kind: vk::DescriptorType,
    /// Elements of an array, 1 for anything else.
    pub count: u32,
}

/// A SPIR-V module with one entry point.
#[derive(Clone, Debug)]
pub struct Shader {
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

impl Shader {
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
