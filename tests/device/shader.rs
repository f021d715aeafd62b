//! Shaders that only tests have, made by the program's own compiler: the same options, the same includes.

use std::path::Path;

use depthleap::vulkan::Shader;

// The build script uses all of it.
#[path = "../../src/glsl/compile.rs"]
#[allow(dead_code)]
mod compile;

/// A shader of `tests/device/`, named like those of `glsl/`: `vulkan/color.frag`, `formulas/section.comp:any`. What it
/// includes is looked for in `glsl/`.
pub fn shader(name: &str) -> Shader {
    let root = Path::new("glsl");
    let (file, wanted) = (name.split(':').next().unwrap_or(name), format!("../tests/device/{name}"));
    let made = compile::variants(root, &format!("../tests/device/{file}")).and_then(|modules| {
        let module = modules.iter().find(|module| module.name == wanted);
        compile::compile(root, module.unwrap_or_else(|| panic!("there is no variant {name}")))
    });
    let compiled = made.unwrap_or_else(|broken| panic!("{broken}"));
    assert_eq!(compiled.warnings, "", "{name}");
    Shader::new(name, &compiled.words).unwrap()
}
