//! The promises of the Vulkan layer, on a device.

mod binding;
mod canvas;
mod drawing;
mod kit;
mod memory;
mod queues;
mod recording;
mod validation;

use crate::harness::Test;

pub fn tests() -> Vec<Test> {
    let tests = [validation::all(), memory::all(), binding::all(), recording::all(), drawing::all(), queues::all()];
    tests.into_iter().flatten().map(|test| test.within("vulkan")).collect()
}
