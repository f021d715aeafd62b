//! Shaders of a folder (`--glsl DIR`). A file and a process of its own, since the folder is set for all of a process.

#[path = "glsl/folder.rs"]
mod folder;

use std::path::PathBuf;

use depthleap::error::{ErrorKind, Result};
use depthleap::glsl::{self, Shader};
use folder::{alter, copy};

fn module(file: &'static str) -> Result<Vec<u32>> {
    glsl::module(&Shader::new(file, [])).map(|words| words.to_vec())
}

#[test]
fn what_was_changed_in_the_folder_is_compiled_anew() {
    let built = module("entry.frag").unwrap();
    let missing = glsl::set_directory(PathBuf::from("no/such/folder")).unwrap_err().to_string();
    assert!(missing.contains("no/such/folder") && missing.contains("holds no .vert"), "{missing}");

    let copy = copy();
    glsl::set_directory(copy.path().to_path_buf()).unwrap();
    assert_eq!(module("entry.frag").unwrap(), built, "the same compiler");
    alter(copy.path(), "entry.frag", "(pixel, ray)), 1.0);", "(pixel, ray)), 2.0);");
    assert_ne!(module("entry.frag").unwrap(), built, "a change is seen");

    let line = alter(copy.path(), "entry.frag", "(pixel, ray)), 2.0);", "(pixel, ray)), two);");
    let error = module("entry.frag").unwrap_err();
    assert_eq!(error.kind, ErrorKind::Input);
    let place = format!("{}:{line}:59:", copy.path().join("entry.frag").display());
    assert!(error.to_string().contains(&place), "{error}");
    assert!(module("direction.frag").is_ok(), "others still compile");
    let unknown = module("entrance.frag").unwrap_err().to_string();
    assert!(unknown.contains("did you mean `entry.frag`?"), "{unknown}");
}
