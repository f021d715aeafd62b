//! `--glsl DIR`: a changed shader changes the picture, a broken one is placed.

use std::path::Path;
use std::sync::Arc;

use depthleap::vulkan::Device;

use super::SMALL;
use super::program::Place;
use crate::harness::{Test, test};

#[path = "../../glsl/folder.rs"]
mod folder;

pub fn tests() -> Vec<Test> {
    vec![
        test("a changed shader changes the picture", changed),
        test("a shader that cannot be used ends the run", broken),
    ]
}

const FUSED: &str = "--method nn-omni+fused";

fn shown(folder: &Path) -> String {
    folder.display().to_string()
}

fn changed(_: &Arc<Device>) {
    let (place, copy) = (Place::new(), folder::copy());
    let glsl = shown(copy.path());
    place.done(&format!("render {SMALL} {FUSED} -o built-in.npy"));
    place.done(&format!("render {SMALL} {FUSED} --glsl {glsl} -o same.npy"));
    assert_eq!(place.read("built-in.npy"), place.read("same.npy"));
    folder::alter(copy.path(), "fused.frag", "contribution = segment;", "contribution = 0.5 * segment;");
    place.done(&format!("render {SMALL} {FUSED} --glsl {glsl} -o other.npy"));
    assert_ne!(place.read("built-in.npy"), place.read("other.npy"));
}

fn broken(_: &Arc<Device>) {
    let (place, copy) = (Place::new(), folder::copy());
    let glsl = shown(copy.path());
    let line = folder::alter(copy.path(), "fused.frag", "contribution = segment;", "contribution = nothing;");
    let refused = |says: &[&str]| place.refused(&format!("render {SMALL} {FUSED} --glsl {glsl} -o a.npy"), 3, says);
    refused(&[&format!("fused.frag:{line}:"), "'nothing'", "fix the shader"]);
    // A constant that the program sets and no set of defines has would be the shader's own default.
    let copied = || std::fs::copy("glsl/fused.frag", copy.path().join("fused.frag")).unwrap();
    copied();
    let constant = "layout(constant_id = 10) const float BLEND_ROUNDING = 0.0;";
    folder::alter(copy.path(), "fused.frag", constant, "const float BLEND_ROUNDING = 0.0;");
    refused(&["fused.frag", "declares no specialization constant BLEND_ROUNDING"]);
    copied();
    folder::alter(copy.path(), "fused.frag", "//@takes [DENSE], [ENDLESS]", "//@takes [DENSE]");
    let args = format!("render {SMALL} {FUSED} --termination 1 --glsl {glsl} -o a.npy");
    place.refused(&args, 3, &["fused.frag:17:1:", "`ENDLESS` is asked for"]);
}
