//! Tests that need a Vulkan device, in one program with a harness of its own: one folder or file for each module.

mod frame;
mod harness;

use std::process::ExitCode;

fn main() -> ExitCode {
    harness::run(frame::tests())
}
