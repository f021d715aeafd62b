//! One formula, one GLSL function, one f64 function: both are run on random arguments, on the device under test.

mod double_float;
mod kit;
mod opacity;
mod polygon;
mod ray;
mod root;
mod samples;
mod section;
mod single_rays;
mod volume;

use depthleap::read;
use depthleap::scene::{Scene, Settings};

pub use kit::Random;

use crate::harness::Test;

pub fn tests() -> Vec<Test> {
    let tests = [
        opacity::all(),
        double_float::all(),
        ray::all(),
        single_rays::all(),
        section::all(),
        samples::all(),
        volume::all(),
        polygon::all(),
        root::all(),
    ];
    tests.into_iter().flatten().map(|test| test.within("formulas")).collect()
}

/// A scene of a built-in volume, `NAME:SIZE`.
fn scene(builtin: &str) -> Scene {
    let mut settings = Settings::default();
    settings.volume.builtin = Some(builtin.to_owned());
    read::scene(&settings).unwrap()
}
