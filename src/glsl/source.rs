//! Where GLSL text comes from: the files built into the program, or a folder laid out like `glsl/`.
//!
//! Every `.vert`, `.frag` and `.comp` file below the root is a shader; `shared/` holds what they include. Include paths
//! count from the root: `#include "shared/ray.glsl"`.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::fmt;
use std::path::{Path, PathBuf};

/// The folder of the repository that built-in files come from, as messages show it.
const BUILT_IN: &str = "glsl";

/// A root of GLSL files.
#[derive(Clone, Debug)]
pub enum Source {
    /// Path from the root and text of each file, sorted by path.
    BuiltIn(&'static [(&'static str, &'static str)]),
    Folder(PathBuf),
}

/// A file of the user's that shaders include by the path [`Insert::PATH`], wherever it lies.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Insert {
    /// The file as messages show it.
    pub name: String,
    pub text: String,
    /// What the file has to define, for the message where it does not: `vec4 effect(Sample here)`.
    pub defines: &'static str,
}

impl Insert {
    /// The path of `#include` lines that stand for it.
    pub const PATH: &str = "effect.glsl";
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

/// A shader's file and every file it may include, as they stood at one moment.
#[derive(Clone, Debug)]
pub struct Text {
    /// Path of the shader from the root.
    pub file: String,
    /// Path from the root and text of each file, the shader's own among them.
    pub parts: BTreeMap<String, Cow<'static, str>>,
    root: PathBuf,
    /// What messages call the user's own text among the parts, where there is one.
    insert: Option<String>,
}

impl Source {
    fn root(&self) -> &Path {
        match self {
            Self::BuiltIn(_) => Path::new(BUILT_IN),
            Self::Folder(root) => root,
        }
    }

    /// Every file by its path from the root, with `/` between folders; sorted. A root that is not there holds none.
    ///
    /// # Errors
    /// A folder that cannot be read.
    pub fn files(&self) -> Result<Vec<String>, Broken> {
        match self {
            Self::BuiltIn(files) => Ok(files.iter().map(|(path, _)| (*path).to_owned()).collect()),
            Self::Folder(root) if root.exists() => files_below(root),
            Self::Folder(_) => Ok(Vec::new()),
        }
    }

    /// The files that are shaders, not only included by shaders.
    ///
    /// # Errors
    /// As [`Source::files`].
    pub fn shaders(&self) -> Result<Vec<String>, Broken> {
        let mut files = self.files()?;
        files.retain(|file| stage(file).is_some());
        Ok(files)
    }

    fn read(&self, file: &str) -> Result<Cow<'static, str>, Broken> {
        let path = self.root().join(file);
        let broken = |text: String| Broken { place: path.display().to_string(), text };
        let text = match self {
            Self::BuiltIn(files) => {
                let found = files.binary_search_by(|(path, _)| (*path).cmp(file));
                Cow::Borrowed(files[found.map_err(|_| broken("there is no such file".into()))?].1)
            }
            Self::Folder(_) => Cow::Owned(std::fs::read_to_string(&path).map_err(|error| broken(error.to_string()))?),
        };
        // The compiler takes C strings.
        if text.contains('\0') { Err(broken("holds a zero byte".into())) } else { Ok(text) }
    }

    /// The shader `file` with what it may include. Conditions around an `#include` are not looked at, and a file that
    /// is not there is left to the compiler, which knows whether it is included at all.
    ///
    /// # Errors
    /// A file that cannot be read.
    pub fn text(&self, file: &str) -> Result<Text, Broken> {
        let mut parts = BTreeMap::new();
        let mut waiting = vec![(file.to_owned(), self.read(file)?)];
        while let Some((path, text)) = waiting.pop() {
            for included in included(&text) {
                if !parts.contains_key(included) && included != path {
                    waiting.extend(self.read(included).ok().map(|text| (included.to_owned(), text)));
                }
            }
            parts.insert(path, text);
        }
        Ok(Text { file: file.to_owned(), parts, root: self.root().to_owned(), insert: None })
    }
}

impl Text {
    /// The same with the user's own text among its parts.
    pub fn with(mut self, insert: Option<&Insert>) -> Self {
        if let Some(insert) = insert {
            self.parts.insert(Insert::PATH.to_owned(), insert.text.clone().into());
            self.insert = Some(insert.name.clone());
        }
        self
    }

    /// A file of the same root, or the user's own, as messages show it.
    pub fn shown(&self, file: &str) -> String {
        match &self.insert {
            Some(name) if file == Insert::PATH => name.clone(),
            _ => self.root.join(file).display().to_string(),
        }
    }

    /// The text of a file that is named as messages show it.
    pub fn of_shown(&self, shown: &str) -> Option<&str> {
        self.parts.iter().find(|(file, _)| self.shown(file) == shown).map(|(_, text)| text.as_ref())
    }

    /// What `#include "path"` stands for: the file as messages show it, and its text.
    ///
    /// # Errors
    /// A file that was not there.
    pub fn include(&self, path: &str) -> Result<(String, String), String> {
        let shown = self.shown(path);
        match self.parts.get(path) {
            Some(text) => Ok((shown, text.clone().into_owned())),
            None => Err(format!("{shown}: there is no such file; include paths count from {}", self.root.display())),
        }
    }

    /// The shader's own text.
    pub fn own(&self) -> &str {
        self.parts.get(&self.file).map_or("", |text| text.as_ref())
    }

    /// A fault in line `number`, counted from 1, of the shader's own text.
    pub fn fault(&self, number: usize, problem: &str) -> Broken {
        let place = self.shown(&self.file);
        Broken { text: format!("{place}:{number}:1: {problem}"), place }
    }

    /// Whether any set of defines gives the shader a specialization constant of that name.
    pub fn declares(&self, constant: &str) -> bool {
        let declared = |line: &str| {
            let (layout, rest) = line.split_once(')')?;
            let name = rest.split('=').next()?.split_whitespace().last()?;
            (layout.trim_start().starts_with("layout(constant_id") && name == constant).then_some(())
        };
        self.parts.values().flat_map(|text| text.lines()).any(|line| declared(line).is_some())
    }
}

/// The stage a file's ending stands for; `None` for files that are only included.
pub fn stage(file: &str) -> Option<&str> {
    let (_, ending) = file.rsplit_once('.')?;
    (!file.starts_with("shared/") && matches!(ending, "vert" | "frag" | "comp")).then_some(ending)
}

/// The paths that a text names in `#include` lines.
fn included(text: &str) -> impl Iterator<Item = &str> {
    text.lines().filter_map(|line| {
        let rest = line.trim_start().strip_prefix('#')?.trim_start().strip_prefix("include")?.trim();
        rest.strip_prefix('"')?.split('"').next()
    })
}

fn files_below(root: &Path) -> Result<Vec<String>, Broken> {
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
