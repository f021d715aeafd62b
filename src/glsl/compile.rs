//! GLSL files to SPIR-V modules, the same for the build script and for `--glsl DIR`.
//!
//! Every `.vert`, `.frag` and `.comp` file below the root is a shader; `shared/` holds what they include. Include
//! paths count from the root: `#include "shared/ray.glsl"`. A shader whose head says
//!
//! ```text
//! //@variant plain
//! //@variant discard CULL_DISCARD
//! ```
//!
//! becomes one module for each such line, with those macros defined; without such a line it is one module. A line
//! `//@also NAME MACRO ...` doubles the variants above it: each is there once more, as `...+NAME`, with those macros too.
//! Modules are named by their path from the root, `structure/cell_range.comp`, variants `main_pass.frag:discard`.

use shaderc::{CompileOptions, Compiler, ResolvedInclude, ShaderKind};
use std::fmt;
use std::path::{Path, PathBuf};

/// One SPIR-V module to be made: a file and the macros it is compiled with.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Module {
    /// `path/from/root.ext` or `path/from/root.ext:variant`.
    pub name: String,
    /// `path/from/root.ext`.
    pub file: String,
    /// Macro names with their values, in the order of the variant line.
    pub macros: Vec<(String, Option<String>)>,
}

/// What the compiler made of a module.
pub struct Compiled {
    pub words: Vec<u32>,
    /// The compiler's warnings, empty where there are none.
    pub warnings: String,
}

/// A shader that cannot be used: where, and what the compiler or the file system says.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Broken {
    /// The file as the user knows it, root included.
    pub place: String,
    /// One `file:line:column: text` for each fault, the column only where it is certain.
    pub text: String,
}

impl fmt::Display for Broken {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}: {}", self.place, self.text)
    }
}

/// Every module below `root`, sorted by name. A root that is not there holds none.
pub fn modules(root: &Path) -> Result<Vec<Module>, Broken> {
    let mut found = Vec::new();
    if root.exists() {
        for file in files(root)? {
            if kind(&file).is_some() {
                found.extend(variants(root, &file)?);
            }
        }
    }
    found.sort_by(|a, b| a.name.cmp(&b.name));
    Ok(found)
}

/// The modules of one shader file, given by its path from `root`.
pub fn variants(root: &Path, file: &str) -> Result<Vec<Module>, Broken> {
    let text = read(root, file)?;
    let mut found: Vec<Module> = Vec::new();
    for (number, line) in text.lines().enumerate() {
        let Some(rest) = line.trim_start().strip_prefix("//@") else { continue };
        let fault = |problem: String| Broken {
            place: root.join(file).display().to_string(),
            text: format!("{}:{}:1: {problem}", root.join(file).display(), number + 1),
        };
        let mut words = rest.split_whitespace();
        let kind = words.next();
        if !matches!(kind, Some("variant" | "also")) {
            return Err(fault(format!("`//@{rest}` is not a known line; write `//@variant NAME MACRO[=VALUE] ...`")));
        }
        let variant = words.next().ok_or_else(|| fault("this variant has no name".into()))?;
        let macros: Vec<(String, Option<String>)> = words
            .map(|word| match word.split_once('=') {
                Some((name, value)) => (name.to_string(), Some(value.to_string())),
                None => (word.to_string(), None),
            })
            .collect();
        let plain = Module { name: format!("{file}:{variant}"), file: file.to_string(), macros };
        let more: Vec<Module> = match kind {
            Some("also") => found
                .iter()
                .map(|above| Module {
                    name: format!("{}+{variant}", above.name),
                    file: file.to_string(),
                    macros: [above.macros.as_slice(), &plain.macros].concat(),
                })
                .collect(),
            _ => vec![plain],
        };
        if more.is_empty() {
            return Err(fault(format!("there is no variant that `{variant}` goes with")));
        }
        if found.iter().any(|module| more.iter().any(|one| one.name == module.name)) {
            return Err(fault(format!("the variant `{variant}` is there twice")));
        }
        found.extend(more);
    }
    if found.is_empty() {
        found.push(Module { name: file.to_string(), file: file.to_string(), macros: Vec::new() });
    }
    Ok(found)
}

/// Compiles one module for Vulkan 1.3, as SPIR-V 1.5, optimised.
///
/// Debug information stays in: the optimiser strips the names of bindings and members without it, and bindings
/// are made by name.
pub fn compile(root: &Path, module: &Module) -> Result<Compiled, Broken> {
    let shown = root.join(&module.file).display().to_string();
    let broken = |text: String| Broken { place: shown.clone(), text };
    let text = read(root, &module.file)?;
    let kind = kind(&module.file).ok_or_else(|| broken("not a .vert, .frag or .comp file".into()))?;
    let compiler = Compiler::new().map_err(|error| broken(error.to_string()))?;
    let mut options = CompileOptions::new().map_err(|error| broken(error.to_string()))?;
    options.set_target_env(shaderc::TargetEnv::Vulkan, shaderc::EnvVersion::Vulkan1_3 as u32);
    options.set_target_spirv(shaderc::SpirvVersion::V1_5);
    options.set_optimization_level(shaderc::OptimizationLevel::Performance);
    options.set_generate_debug_info();
    options.set_include_callback(|path, _, _, _| include(root, path));
    for (name, value) in &module.macros {
        options.add_macro_definition(name, value.as_deref());
    }
    let artifact = compiler.compile_into_spirv(&text, kind, &shown, "main", Some(&options)).map_err(|error| {
        let text = match error {
            shaderc::Error::CompilationError(_, text) => text,
            other => other.to_string(),
        };
        broken(text.lines().map(point).collect::<Vec<_>>().join("\n"))
    })?;
    Ok(Compiled { words: without_source(artifact.as_binary()), warnings: artifact.get_warning_messages() })
}

/// Every file below `root` by its path from there, with `/` between folders; sorted.
fn files(root: &Path) -> Result<Vec<String>, Broken> {
    let mut found = Vec::new();
    let mut folders = vec![PathBuf::new()];
    while let Some(folder) = folders.pop() {
        let here = root.join(&folder);
        let broken = |error: std::io::Error| Broken { place: here.display().to_string(), text: error.to_string() };
        for entry in std::fs::read_dir(&here).map_err(broken)? {
            let entry = entry.map_err(broken)?;
            let path = folder.join(entry.file_name());
            if entry.file_type().map_err(broken)?.is_dir() {
                folders.push(path);
            } else if let Some(path) = path.to_str() {
                found.push(path.replace(std::path::MAIN_SEPARATOR, "/"));
            }
        }
    }
    found.sort();
    Ok(found)
}

/// The stage a file's ending stands for; `None` for files that are only included.
fn kind(file: &str) -> Option<ShaderKind> {
    if file.starts_with("shared/") {
        return None;
    }
    match file.rsplit_once('.')?.1 {
        "vert" => Some(ShaderKind::Vertex),
        "frag" => Some(ShaderKind::Fragment),
        "comp" => Some(ShaderKind::Compute),
        _ => None,
    }
}

fn read(root: &Path, file: &str) -> Result<String, Broken> {
    let path = root.join(file);
    let broken = |text: String| Broken { place: path.display().to_string(), text };
    let text = std::fs::read_to_string(&path).map_err(|error| broken(error.to_string()))?;
    // shaderc takes C strings.
    if text.contains('\0') { Err(broken("holds a zero byte".into())) } else { Ok(text) }
}

fn include(root: &Path, path: &str) -> Result<ResolvedInclude, String> {
    let content =
        read(root, path).map_err(|broken| format!("{broken}; include paths count from {}", root.display()))?;
    Ok(ResolvedInclude { resolved_name: root.join(path).display().to_string(), content })
}

/// Adds the column, the line itself and a mark to a message `file:line: error: 'token' : text`, where the token
/// stands only once in that line. The compiler gives no columns.
fn point(message: &str) -> String {
    let column = || {
        let mut parts = message.splitn(3, ':');
        let (file, number, rest) = (parts.next()?, parts.next()?, parts.next()?);
        let text = std::fs::read_to_string(file).ok()?;
        let line = text.lines().nth(number.parse::<usize>().ok()?.checked_sub(1)?)?.to_string();
        let token = rest.split('\'').nth(1).filter(|token| !token.is_empty());
        let mut at = token.into_iter().flat_map(|token| words(&line, token));
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
