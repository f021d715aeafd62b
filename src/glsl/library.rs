//! Modules of one root of GLSL files: from memory, from disk, or from the compiler.

use std::collections::{BTreeSet, HashMap};
use std::sync::{Arc, Mutex, PoisonError};

use rayon::prelude::*;

use super::cache::{Cache, CacheKey};
use super::compile::compile;
use super::shader::Shader;
use super::source::{Broken, Insert, Source, Text};
use super::takes::Takes;
use crate::error::{Error, Result};

/// Where modules come from. A folder's files are read at every request, so that what was changed is compiled anew.
pub struct Library {
    source: Source,
    cache: Cache,
    made: Mutex<HashMap<CacheKey, Arc<[u32]>>>,
}

impl Library {
    pub fn new(source: Source, cache: Cache) -> Self {
        Self { source, cache, made: Mutex::default() }
    }

    /// Whether its files are those that the program was built with.
    pub fn is_built_in(&self) -> bool {
        matches!(self.source, Source::BuiltIn(_))
    }

    /// The SPIR-V words of a shader.
    ///
    /// # Errors
    /// A file that is not there, with the one most like it; a define that the file does not take; a shader that does not
    /// compile, with the compiler's text.
    pub fn module(&self, shader: &Shader) -> Result<Arc<[u32]>> {
        let insert = shader.insert.as_deref();
        let text = self.text(shader.file)?.with(insert);
        let defines: Vec<&str> = shader.defines.iter().copied().collect();
        Takes::of(&text).and_then(|takes| takes.check(&text, &defines)).map_err(broken)?;
        let key = CacheKey::of(&text, &defines);
        if let Some(made) = self.made().get(&key) {
            return Ok(made.clone());
        }
        let words: Arc<[u32]> = match self.cache.load(&key) {
            Some(words) => words.into(),
            None => self.compiled(&text, &defines, &key).map_err(|broken| fault(broken, insert))?.into(),
        };
        self.made().insert(key, words.clone());
        Ok(words)
    }

    /// Makes the modules of all these shaders, on all cores, for those who ask for one after the other.
    ///
    /// # Errors
    /// As [`Library::module`], of the first shader that has one.
    pub fn prepare<'a>(&self, shaders: impl IntoIterator<Item = &'a Shader>) -> Result<()> {
        let shaders: BTreeSet<&Shader> = shaders.into_iter().collect();
        let made: Vec<Result<_>> = shaders.into_par_iter().map(|shader| self.module(shader)).collect();
        made.into_iter().try_for_each(|module| module.map(drop))
    }

    /// Whether any set of defines gives the file a specialization constant of that name.
    ///
    /// # Errors
    /// A file that is not there.
    pub fn declares(&self, file: &str, constant: &str) -> Result<bool> {
        Ok(self.text(file)?.declares(constant))
    }

    fn text(&self, file: &str) -> Result<Text> {
        let known = self.source.shaders().map_err(broken)?;
        if !known.iter().any(|known| known == file) {
            return Err(unknown(file, &known));
        }
        self.source.text(file).map_err(broken)
    }

    fn compiled(&self, text: &Text, defines: &[&str], key: &CacheKey) -> Result<Vec<u32>, Broken> {
        let compiled = compile(text, defines)?;
        if compiled.warnings.is_empty() {
            self.cache.store(key, &compiled.words);
        } else {
            // Not kept, so that they are heard again.
            eprint!("{}", compiled.warnings);
        }
        Ok(compiled.words)
    }

    fn made(&self) -> std::sync::MutexGuard<'_, HashMap<CacheKey, Arc<[u32]>>> {
        self.made.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

fn unknown(file: &str, known: &[String]) -> Error {
    let near = known.iter().max_by(|a, b| strsim::jaro(file, a).total_cmp(&strsim::jaro(file, b)));
    let remedy = match near {
        Some(near) => format!("did you mean `{near}`?"),
        None => "name a folder laid out like glsl/".to_string(),
    };
    Error::usage(format!("shader {file}"), "there is no such file", remedy)
}

/// A shader that does not compile as the program's error. Where it includes a text of the user's, that is at fault.
fn fault(found: Broken, insert: Option<&Insert>) -> Error {
    let Some(Insert { name, defines, .. }) = insert else { return broken(found) };
    let problem = match found.text.contains(NO_BODY) {
        true => format!("does not define `{defines}`"),
        false => found.text,
    };
    Error::input(
        name,
        problem,
        format!("fix the file, which has to define `{defines}`; glsl/shared/effect.glsl tells what it may use"),
    )
}

/// What the compiler says of a function that is declared and called, and not defined.
const NO_BODY: &str = "No function definition (body) found";

/// A broken shader as the program's error.
pub fn broken(broken: Broken) -> Error {
    Error::input(broken.place, broken.text, "fix the shader")
}
