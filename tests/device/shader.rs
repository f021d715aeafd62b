//! Shaders that only tests have, made by the program's own compiler: the same options, the same includes.

use depthleap::glsl::compile::compile;
use depthleap::glsl::source::Source;
use depthleap::vulkan::ShaderModule;

/// A shader of `tests/device/`, named like those of `glsl/`: `vulkan/color.frag`,
/// `formulas/section.comp:MARK_FRAGDEPTH_ANY`. What it includes is looked for in `glsl/`.
pub fn shader(name: &str) -> ShaderModule {
    let (file, defines) = name.split_once(':').unwrap_or((name, ""));
    let defines: Vec<&str> = defines.split('+').filter(|define| !define.is_empty()).collect();
    let text = Source::Folder("glsl".into()).text(&format!("../tests/device/{file}"));
    let compiled = text.and_then(|text| compile(&text, &defines)).unwrap_or_else(|broken| panic!("{broken}"));
    assert_eq!(compiled.warnings, "", "{name}");
    ShaderModule::new(name, &compiled.words).unwrap()
}
