//! Shaders compiled on every request (`--glsl DIR`). A file and a process of its own, since the folder is set for
//! all of a process: `cargo test --features runtime-shaders --test runtime_shaders`.

#[path = "glsl/folder.rs"]
mod folder;

use std::path::PathBuf;

use depthleap::error::Kind;
use depthleap::glsl;
use folder::{alter, copy};

#[test]
fn folder_is_compiled_anew_on_every_request() {
    let built = glsl::module("entry.frag").unwrap().into_owned();
    let missing = glsl::set_directory(PathBuf::from("no/such/folder")).unwrap_err().to_string();
    assert!(missing.contains("no/such/folder") && missing.contains("holds no .vert"), "{missing}");

    let copy = copy();
    glsl::set_directory(copy.path().to_path_buf()).unwrap();
    assert_eq!(*glsl::module("entry.frag").unwrap(), built, "the same compiler");
    alter(copy.path(), "entry.frag", "entry.w = 1.0;", "entry.w = 2.0;");
    assert_ne!(*glsl::module("entry.frag").unwrap(), built, "a change is seen");

    let line = alter(copy.path(), "entry.frag", "entry.w = 2.0;", "entry.w = two;");
    let error = glsl::module("entry.frag").unwrap_err();
    assert_eq!(error.kind, Kind::Input);
    let place = format!("{}:{line}:15:", copy.path().join("entry.frag").display());
    assert!(error.to_string().contains(&place), "{error}");
    assert!(glsl::module("direction.frag").is_ok(), "others still compile");
    let unknown = glsl::module("entrance.frag").unwrap_err().to_string();
    assert!(unknown.contains("did you mean `entry.frag`?"), "{unknown}");
}
