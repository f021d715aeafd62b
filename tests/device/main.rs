//! Tests that need a Vulkan device, in one program with a harness of its own: one folder or file for each module.

mod cli;
mod data;
mod formulas;
mod frame;
mod harness;
mod marching_cubes;
mod probe;
mod shader;
mod structure;
mod vulkan;

use std::process::ExitCode;

fn main() -> ExitCode {
    harness::run(
        [
            data::tests(),
            formulas::tests(),
            vulkan::tests(),
            structure::tests(),
            marching_cubes::tests(),
            frame::tests(),
            probe::tests(),
            cli::tests(),
        ]
        .into_iter()
        .flatten()
        .collect(),
    )
}
