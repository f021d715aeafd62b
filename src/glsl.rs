//! The program's SPIR-V modules by name.
//!
//! `tools/build.rs` compiles all of `glsl/` while building, so that the program needs no shader compiler. With the
//! feature `runtime-shaders` and `set_directory` the same compiler runs on each request instead, for people who
//! change a shader and want to see what happens.

#[cfg(feature = "runtime-shaders")]
mod compile;

use crate::error::{Error, Result};
use std::borrow::Cow;

/// Bytes that lie where words may lie.
#[repr(C, align(4))]
struct Words<T: ?Sized>(T);

include!(concat!(env!("OUT_DIR"), "/shaders.rs"));

/// Names of all modules the program was built with, sorted: `main_pass.frag`, `structure/cell_range.comp`,
/// variants as `main_pass.frag:discard`.
pub fn names() -> impl Iterator<Item = &'static str> {
    MODULES.iter().map(|(name, _)| *name)
}

/// The SPIR-V words of the module `name`, from the directory of `set_directory` where one is set.
///
/// # Errors
/// A name that is not among [`names`], with the one most like it; a shader in that directory that does not
/// compile, with the compiler's text.
pub fn module(name: &str) -> Result<Cow<'static, [u32]>> {
    #[cfg(feature = "runtime-shaders")]
    if let Some(root) = runtime::directory() {
        return runtime::module(&root, name).map(Cow::Owned);
    }
    let found = MODULES.binary_search_by(|(other, _)| (*other).cmp(name)).ok();
    match found.and_then(|index| bytemuck::try_cast_slice(&MODULES[index].1.0).ok()) {
        Some(words) => Ok(Cow::Borrowed(words)),
        None => Err(unknown(name, names())),
    }
}

fn unknown<'a>(name: &str, known: impl Iterator<Item = &'a str>) -> Error {
    let near = known.max_by(|a, b| strsim::jaro(name, a).total_cmp(&strsim::jaro(name, b)));
    let remedy = match near {
        Some(near) => format!("did you mean `{near}`?"),
        None => "there are no shaders at all; put them into glsl/ and build again".to_string(),
    };
    Error::usage(format!("shader {name}"), "there is no such module", remedy)
}

#[cfg(feature = "runtime-shaders")]
pub use runtime::set_directory;

#[cfg(feature = "runtime-shaders")]
mod runtime {
    use super::{compile, unknown};
    use crate::error::{Error, Result};
    use std::path::{Path, PathBuf};
    use std::sync::{PoisonError, RwLock};

    static DIRECTORY: RwLock<Option<PathBuf>> = RwLock::new(None);

    /// From now on [`super::module`] compiles from `directory`, laid out like `glsl/`, on every call.
    ///
    /// # Errors
    /// A directory that is not there or holds no shader.
    pub fn set_directory(directory: PathBuf) -> Result<()> {
        if compile::modules(&directory).map_err(error)?.is_empty() {
            return Err(Error::usage(
                directory.display(),
                "holds no .vert, .frag or .comp file",
                "name a folder laid out like glsl/",
            ));
        }
        *DIRECTORY.write().unwrap_or_else(PoisonError::into_inner) = Some(directory);
        Ok(())
    }

    pub(super) fn directory() -> Option<PathBuf> {
        DIRECTORY.read().unwrap_or_else(PoisonError::into_inner).clone()
    }

    pub(super) fn module(root: &Path, name: &str) -> Result<Vec<u32>> {
        let modules = compile::modules(root).map_err(error)?;
        let module = modules.iter().find(|module| module.name == name);
        let module = module.ok_or_else(|| unknown(name, modules.iter().map(|module| module.name.as_str())))?;
        let compiled = compile::compile(root, module).map_err(error)?;
        if !compiled.warnings.is_empty() {
            eprint!("{}", compiled.warnings);
        }
        Ok(compiled.words)
    }

    fn error(broken: compile::Broken) -> Error {
        Error::input(broken.place, broken.text, "mend the shader")
    }
}
