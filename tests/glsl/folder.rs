//! `glsl/` and copies of it that are altered.

use std::fs;
use std::path::{Path, PathBuf};

/// Files below `folder`, by their paths from there.
pub fn files(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let inner = if path.is_dir() { files(&path) } else { vec![PathBuf::new()] };
        found.extend(inner.into_iter().map(|file| Path::new(path.file_name().unwrap()).join(file)));
    }
    found.into_iter().map(|file| file.components().collect()).collect()
}

/// A copy of `glsl/` to be broken.
pub fn copy() -> tempfile::TempDir {
    let copy = tempfile::tempdir().unwrap();
    for file in files(Path::new("glsl")) {
        let to = copy.path().join(&file);
        fs::create_dir_all(to.parent().unwrap()).unwrap();
        fs::copy(Path::new("glsl").join(&file), to).unwrap();
    }
    copy
}

/// Replaces `from`, which stands in one line of `file` only; the number of that line.
pub fn alter(root: &Path, file: &str, from: &str, to: &str) -> usize {
    let path = root.join(file);
    let text = fs::read_to_string(&path).unwrap();
    let lines: Vec<usize> = text.lines().enumerate().filter(|(_, l)| l.contains(from)).map(|(i, _)| i + 1).collect();
    let [line] = lines[..] else { panic!("{from:?} stands in the lines {lines:?} of {file}") };
    fs::write(&path, text.replace(from, to)).unwrap();
    line
}
