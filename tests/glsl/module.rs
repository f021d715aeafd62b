//! Modules of the program and what they say about themselves.

use depthleap::glsl::{self, Shader as Source};
use depthleap::vulkan::ShaderModule;

pub fn compiled(shader: &Source) -> ShaderModule {
    ShaderModule::new(&shader.to_string(), &glsl::module(shader).unwrap()).unwrap()
}

/// The module of `FILE:DEFINE+DEFINE`.
pub fn module(name: &'static str) -> ShaderModule {
    let (file, defines) = name.split_once(':').unwrap_or((name, ""));
    compiled(&Source::new(file, defines.split('+').filter(|define| !define.is_empty())))
}
