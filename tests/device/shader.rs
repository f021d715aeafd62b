//! Shaders that only tests have, made by the program's own compiler: the same options, the same includes.

use std::path::Path;

use depthleap::vulkan::Shader;

// The build script uses all of it.
#[path = "../../src/glsl/compile.rs"]
#[allow(dead_code)]
mod compile;

/// The shader in `tests/FILE`; what it includes is looked for in `glsl/`.
pub fn shader(file: &str) -> Shader {
    let module = compile::Module { name: file.to_owned(), file: format!("../tests/{file}"), macros: Vec::new() };
    let compiled = compile::compile(Path::new("glsl"), &module).unwrap_or_else(|broken| panic!("{broken}"));
    assert_eq!(compiled.warnings, "", "{file}");
    Shader::new(file, &compiled.words).unwrap()
}
