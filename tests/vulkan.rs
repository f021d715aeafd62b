//! The promises of the Vulkan layer, on a device.

#[path = "vulkan/binding.rs"]
mod binding;
#[path = "vulkan/canvas.rs"]
mod canvas;
mod device;
#[path = "vulkan/drawing.rs"]
mod drawing;
#[path = "vulkan/kit.rs"]
mod kit;
#[path = "vulkan/memory.rs"]
mod memory;
#[path = "vulkan/queues.rs"]
mod queues;
#[path = "vulkan/recording.rs"]
mod recording;
#[path = "device/shader.rs"]
mod shader;
#[path = "vulkan/validation.rs"]
mod validation;

use std::process::ExitCode;

fn main() -> ExitCode {
    let tests = [validation::all(), memory::all(), binding::all(), recording::all(), drawing::all(), queues::all()];
    device::run(tests.into_iter().flatten().collect())
}
