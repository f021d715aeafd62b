//! Writes the GLSL files into the program (`files.rs`, for `src/glsl.rs`), and compiles each once, with its plain set of
//! defines: a broken shader stops the build with the compiler's text.

// Not all of what the program does with shaders is done here.
#[allow(dead_code)]
#[path = "../src/glsl/compile.rs"]
mod compile;
#[allow(dead_code)]
#[path = "../src/glsl/source.rs"]
mod source;
#[allow(dead_code)]
#[path = "../src/glsl/takes.rs"]
mod takes;

use std::fmt::Write;
use std::path::Path;
use std::process::ExitCode;
use std::sync::Mutex;

use sha2::{Digest, Sha256};

use compile::{CompiledModule, compile};
use source::{Broken, Source};
use takes::Takes;

const ROOT: &str = "glsl";

fn main() -> ExitCode {
    println!("cargo:rustc-env=DEPTHLEAP_COMMIT={}", commit());
    println!("cargo:rerun-if-changed=tools/build.rs");
    for file in ["compile.rs", "source.rs", "takes.rs"] {
        println!("cargo:rerun-if-changed=src/glsl/{file}");
    }
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
    let write = |name: &str, bytes: &[u8]| {
        let path = Path::new(&out).join(name);
        std::fs::write(&path, bytes).map_err(|error| format!("{}: {error}", path.display()))
    };
    let source = Source::Folder(ROOT.into());
    write("files.rs", table(&source.files().map_err(|broken| broken.to_string())?).as_bytes())?;

    // What tells this compiler from others (`src/glsl/cache.rs`): what it is told, and what it makes of every file.
    let mut compiler = Sha256::new_with_prefix(include_str!("../src/glsl/compile.rs"));
    let mut faults = String::new();
    let shaders = source.shaders().map_err(|broken| broken.to_string())?;
    for (file, result) in shaders.iter().zip(compile_all(&source, &shaders)) {
        match result {
            Ok(compiled) => {
                for line in compiled.warnings.lines() {
                    println!("cargo:warning={line}");
                }
                compiled.words.iter().for_each(|word| compiler.update(word.to_le_bytes()));
            }
            Err(broken) => {
                let _ = writeln!(faults, "{file} does not compile:\n{}", broken.text);
            }
        }
    }
    write("compiler", &compiler.finalize())?;
    if faults.is_empty() { Ok(()) } else { Err(faults) }
}

/// The files as an item of the program.
fn table(files: &[String]) -> String {
    let mut table = String::from("static FILES: &[(&str, &str)] = &[\n");
    for file in files {
        let path = format!("/{ROOT}/{file}");
        let _ = writeln!(table, "    ({file:?}, include_str!(concat!(env!(\"CARGO_MANIFEST_DIR\"), {path:?}))),");
    }
    table.push_str("];\n");
    table
}

/// A shader with as few defines as it takes.
fn plain(source: &Source, file: &str) -> Result<CompiledModule, Broken> {
    let text = source.text(file)?;
    compile(&text, &Takes::of(&text)?.plain())
}

/// Compiles on all processors; results stand in the order of `shaders`.
fn compile_all(source: &Source, shaders: &[String]) -> Vec<Result<CompiledModule, Broken>> {
    let waiting = Mutex::new(shaders.iter().enumerate());
    let done = Mutex::new(Vec::new());
    std::thread::scope(|scope| {
        for _ in 0..std::thread::available_parallelism().map_or(1, usize::from) {
            scope.spawn(|| {
                loop {
                    let next = waiting.lock().ok().and_then(|mut waiting| waiting.next());
                    let Some((index, file)) = next else { break };
                    let result = plain(source, file);
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
