//! Compiles every shader below `glsl/` and writes `shaders.rs`, the table that `src/glsl.rs` reads.
//! A broken shader stops the build with the compiler's text.

#[path = "../src/glsl/compile.rs"]
mod compile;

use std::fmt::Write;
use std::path::Path;
use std::process::ExitCode;
use std::sync::Mutex;

const ROOT: &str = "glsl";

fn main() -> ExitCode {
    println!("cargo:rustc-env=DEPTHLEAP_COMMIT={}", commit());
    println!("cargo:rerun-if-changed=tools/build.rs");
    println!("cargo:rerun-if-changed=src/glsl/compile.rs");
    // A folder stands for all files in it.
    println!("cargo:rerun-if-changed={ROOT}");
    match build() {
        Ok(()) => ExitCode::SUCCESS,
        Err(text) => {
            eprintln!("{text}");
            ExitCode::FAILURE
        }
    }
}

fn build() -> Result<(), String> {
    let out = std::env::var("OUT_DIR").map_err(|error| format!("OUT_DIR: {error}; run this through cargo"))?;
    let out = Path::new(&out);
    let root = Path::new(ROOT);
    let modules = compile::modules(root).map_err(|broken| broken.to_string())?;

    let results = compile_all(root, &modules);
    let mut table = String::from("static MODULES: &[(&str, &Words<[u8]>)] = &[\n");
    let mut faults = String::new();
    for (index, (module, result)) in modules.iter().zip(results).enumerate() {
        match result {
            Ok(compiled) => {
                for line in compiled.warnings.lines() {
                    println!("cargo:warning={line}");
                }
                let path = out.join(format!("{index}.spv"));
                let bytes: Vec<u8> = compiled.words.iter().flat_map(|word| word.to_ne_bytes()).collect();
                std::fs::write(&path, bytes).map_err(|error| format!("{}: {error}", path.display()))?;
                let _ = writeln!(table, "    ({:?}, &Words(*include_bytes!({path:?}))),", module.name);
            }
            // Variants of one file often fail alike: once is enough.
            Err(broken) if !faults.contains(&broken.text) => {
                let _ = writeln!(faults, "{} does not compile:\n{}", module.name, broken.text);
            }
            Err(_) => {}
        }
    }
    if !faults.is_empty() {
        return Err(faults);
    }
    table.push_str("];\n");
    let path = out.join("shaders.rs");
    std::fs::write(&path, table).map_err(|error| format!("{}: {error}", path.display()))
}

/// Compiles on all processors; results stand in the order of `modules`.
fn compile_all(root: &Path, modules: &[compile::Module]) -> Vec<Result<compile::Compiled, compile::Broken>> {
    let waiting = Mutex::new(modules.iter().enumerate());
    let done = Mutex::new(Vec::new());
    std::thread::scope(|scope| {
        for _ in 0..std::thread::available_parallelism().map_or(1, usize::from) {
            scope.spawn(|| {
                loop {
                    let next = waiting.lock().ok().and_then(|mut waiting| waiting.next());
                    let Some((index, module)) = next else { break };
                    let result = compile::compile(root, module);
                    if let Ok(mut done) = done.lock() {
                        done.push((index, result));
                    }
                }
            });
        }
    });
    let mut done = done.into_inner().unwrap_or_default();
    done.sort_by_key(|(index, _)| *index);
    done.into_iter().map(|(_, result)| result).collect()
}

/// The commit that is built, for the results file; `unknown` outside a checkout.
fn commit() -> String {
    // A file that is not there would bring the script back each time, and in a worktree it lies elsewhere.
    if let Some(log) = git(&["rev-parse", "--git-path", "logs/HEAD"]).filter(|log| Path::new(log).exists()) {
        println!("cargo:rerun-if-changed={log}");
    }
    git(&["rev-parse", "--short=12", "HEAD"]).unwrap_or_else(|| "unknown".to_owned())
}

/// What git says, where it says anything.
fn git(arguments: &[&str]) -> Option<String> {
    let output = std::process::Command::new("git").args(arguments).output().ok()?;
    let text = String::from_utf8(output.stdout).ok().filter(|_| output.status.success())?;
    Some(text.trim().to_owned())
}
