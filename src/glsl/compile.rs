//! GLSL to SPIR-V, the same for the build script, for the program and for tests. Everything that decides which words come
//! out stands in this file: its text is part of the key modules are kept by ([`super::cache`]).

use std::sync::OnceLock;

use shaderc::{CompileOptions, Compiler, OptimizationLevel, ResolvedInclude, ShaderKind};

use super::source::{Broken, Text, stage};

/// What the compiler made of a shader.
pub struct CompiledModule {
    pub words: Vec<u32>,
    /// The compiler's warnings, empty where there are none.
    pub warnings: String,
}

/// A line of shaders that are left to the optimisers of drivers; the reason stands beside it.
pub const UNOPTIMISED: &str = "//@unoptimised";

/// Compiles a shader with these defines for Vulkan 1.3, as SPIR-V 1.5, optimised where its file does not say otherwise.
///
/// # Errors
/// What the compiler says, each fault with its file and line.
pub fn compile(text: &Text, defines: &[&str]) -> Result<CompiledModule, Broken> {
    let level = match text.own().lines().any(|line| line == UNOPTIMISED) {
        true => OptimizationLevel::Zero,
        false => OptimizationLevel::Performance,
    };
    compile_to(text, defines, level)
}

/// Compiles a shader as [`compile`] does, but for the optimiser, which takes most of the time: what a module declares is known
/// without it.
///
/// # Errors
/// What the compiler says, each fault with its file and line.
pub fn compile_unoptimised(text: &Text, defines: &[&str]) -> Result<CompiledModule, Broken> {
    compile_to(text, defines, OptimizationLevel::Zero)
}

/// Debug information stays in: the optimiser strips the names of bindings and members without it, and bindings
/// are made by name.
fn compile_to(text: &Text, defines: &[&str], level: OptimizationLevel) -> Result<CompiledModule, Broken> {
    let shown = text.shown(&text.file);
    let broken = |text: String| Broken { place: shown.clone(), text };
    let kind = match stage(&text.file) {
        Some("vert") => ShaderKind::Vertex,
        Some("frag") => ShaderKind::Fragment,
        Some("comp") => ShaderKind::Compute,
        _ => return Err(broken("not a .vert, .frag or .comp file".into())),
    };
    let mut options = CompileOptions::new().map_err(|error| broken(error.to_string()))?;
    options.set_target_env(shaderc::TargetEnv::Vulkan, shaderc::EnvVersion::Vulkan1_3 as u32);
    options.set_target_spirv(shaderc::SpirvVersion::V1_5);
    options.set_optimization_level(level);
    options.set_generate_debug_info();
    options.set_include_callback(|path, _, _, _| {
        text.include(path).map(|(resolved_name, content)| ResolvedInclude { resolved_name, content })
    });
    for define in defines {
        match define.split_once('=') {
            Some((name, value)) => options.add_macro_definition(name, Some(value)),
            None => options.add_macro_definition(define, None),
        }
    }
    let artifact =
        compiler()?.compile_into_spirv(text.own(), kind, &shown, "main", Some(&options)).map_err(|error| {
            let said = match error {
                shaderc::Error::CompilationError(_, said) => said,
                other => other.to_string(),
            };
            broken(said.lines().map(|line| point(text, line)).collect::<Vec<_>>().join("\n"))
        })?;
    Ok(CompiledModule { words: without_source(artifact.as_binary()), warnings: artifact.get_warning_messages() })
}

/// One for the whole process: what it has learned of the language is lost with the last one.
fn compiler() -> Result<&'static Compiler, Broken> {
    static COMPILER: OnceLock<Result<Compiler, String>> = OnceLock::new();
    let made = COMPILER.get_or_init(|| Compiler::new().map_err(|error| error.to_string()));
    made.as_ref().map_err(|text| Broken { place: "the compiler of shaders".to_owned(), text: text.clone() })
}

/// Adds the column, the line itself and a mark to a message `file:line: error: 'token' : text`, where the token
/// stands only once in that line. The compiler gives no columns.
fn point(text: &Text, message: &str) -> String {
    let column = || {
        let mut parts = message.splitn(3, ':');
        let (file, number, rest) = (parts.next()?, parts.next()?, parts.next()?);
        let line = text.of_shown(file)?.lines().nth(number.parse::<usize>().ok()?.checked_sub(1)?)?;
        let token = rest.split('\'').nth(1).filter(|token| !token.is_empty());
        let mut at = token.into_iter().flat_map(|token| words(line, token));
        let first = at.next().filter(|_| at.next().is_none());
        let place = first.map_or(String::new(), |at| format!("{}:", line[..at].chars().count() + 1));
        let mark = first.map_or(String::new(), |at| {
            let blank = line[..at].chars().map(|c| if c == '\t' { '\t' } else { ' ' });
            format!("\n    {}^", blank.collect::<String>())
        });
        Some(format!("{file}:{number}:{place}{rest}\n    {line}{mark}"))
    };
    column().unwrap_or_else(|| message.to_string())
}

/// Byte offsets of `token` in `line` where it is not part of a longer name.
fn words<'a>(line: &'a str, token: &'a str) -> impl Iterator<Item = usize> + 'a {
    let part = |c: Option<char>| c.is_some_and(|c| c.is_alphanumeric() || c == '_');
    let name = part(token.chars().next());
    line.match_indices(token).map(|(at, _)| at).filter(move |&at| {
        !name || !part(line[..at].chars().next_back()) && !part(line[at + token.len()..].chars().next())
    })
}

/// The module without the text it was made from. Names stay, for reflection; the text is of no use to a driver, and
/// the compiler splits it between bytes of one character, which readers of SPIR-V refuse.
fn without_source(words: &[u32]) -> Vec<u32> {
    const HEADER: usize = 5;
    // OpSourceContinued, OpSource, OpSourceExtension, OpString, OpLine, OpNoLine, OpModuleProcessed.
    const SOURCE: [u32; 7] = [2, 3, 4, 7, 8, 317, 330];
    let mut kept = words[..HEADER.min(words.len())].to_vec();
    let mut rest = &words[kept.len()..];
    while let Some(first) = rest.first() {
        let (opcode, length) = (first & 0xffff, ((first >> 16) as usize).clamp(1, rest.len()));
        if !SOURCE.contains(&opcode) {
            kept.extend_from_slice(&rest[..length]);
        }
        rest = &rest[length..];
    }
    kept
}
