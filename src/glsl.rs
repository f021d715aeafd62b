//! The program's shaders: GLSL files with the defines they are compiled with, and their SPIR-V.
//!
//! A [`Shader`] is data: a file of `glsl/` and a set of defines out of those that the file takes ([`takes`]). The files
//! are built into the program ([`source`]). A module is compiled when it is first asked for ([`compile`]), and lies on disk
//! from then on ([`cache`]). With [`set_directory`] the files come from a folder instead, for people who change a shader and
//! want to see what happens.

pub mod cache;
pub mod compile;
pub mod library;
mod shader;
pub mod source;
pub mod takes;

use std::path::PathBuf;
use std::sync::{Arc, LazyLock, PoisonError, RwLock};

pub use cache::COMPILER;
pub use shader::Shader;
pub use source::Insert;

use crate::error::{Error, Result};
use cache::Cache;
use library::{Library, broken};
use source::Source;

// FILES: paths below `glsl/` and texts.
include!(concat!(env!("OUT_DIR"), "/files.rs"));

/// What the functions below ask.
static LIBRARY: LazyLock<RwLock<Arc<Library>>> =
    LazyLock::new(|| RwLock::new(Arc::new(Library::new(built_in(), Cache::of_user()))));

fn library() -> Arc<Library> {
    LIBRARY.read().unwrap_or_else(PoisonError::into_inner).clone()
}

/// The files that the program was built with.
pub fn built_in() -> Source {
    Source::BuiltIn(FILES)
}

/// From now on shaders come from the files of `directory`, laid out like `glsl/`.
///
/// # Errors
/// A directory that is not there or holds no shader.
pub fn set_directory(directory: PathBuf) -> Result<()> {
    let source = Source::Folder(directory.clone());
    if source.shaders().map_err(broken)?.is_empty() {
        return Err(Error::usage(
            directory.display(),
            "holds no .vert, .frag or .comp file",
            "name a folder laid out like glsl/",
        ));
    }
    let new = Arc::new(Library::new(source, Cache::of_user()));
    *LIBRARY.write().unwrap_or_else(PoisonError::into_inner) = new;
    Ok(())
}

/// Whether shaders are those that the program was built with.
pub fn is_built_in() -> bool {
    library().is_built_in()
}

/// The SPIR-V words of a shader.
///
/// # Errors
/// As [`Library::module`].
pub fn module(shader: &Shader) -> Result<Arc<[u32]>> {
    library().module(shader)
}

/// Makes the modules of all these shaders, on all cores, for those who ask for one after the other.
///
/// # Errors
/// As [`Library::module`].
pub fn prepare<'a>(shaders: impl IntoIterator<Item = &'a Shader>) -> Result<()> {
    library().prepare(shaders)
}

/// Whether any set of defines gives a file the specialization constant of that name.
///
/// # Errors
/// A file that is not there.
pub fn declares(file: &str, constant: &str) -> Result<bool> {
    library().declares(file, constant)
}
