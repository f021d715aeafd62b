//! One formula, one GLSL function, one f64 function: both are run on random arguments, on the device under test.

mod device;
#[path = "formulas/double_float.rs"]
mod double_float;
#[path = "formulas/kit.rs"]
mod kit;
#[path = "formulas/opacity.rs"]
mod opacity;
#[path = "formulas/ray.rs"]
mod ray;
#[path = "formulas/samples.rs"]
mod samples;
#[path = "formulas/section.rs"]
mod section;
#[path = "device/shader.rs"]
mod shader;
#[path = "formulas/volume.rs"]
mod volume;

use std::process::ExitCode;

use depthleap::read;
use depthleap::scene::{Scene, Settings};

fn main() -> ExitCode {
    let tests = [opacity::all(), double_float::all(), ray::all(), section::all(), samples::all(), volume::all()];
    device::run(tests.into_iter().flatten().collect())
}

/// A scene of a built-in volume, `NAME:SIZE`.
fn scene(builtin: &str) -> Scene {
    let mut settings = Settings::default();
    settings.volume.builtin = Some(builtin.to_owned());
    read::scene(&settings).unwrap()
}
