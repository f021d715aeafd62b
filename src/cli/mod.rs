//! The command line: one file a command.

mod bench;
mod info;
mod open;
mod options;
mod plan;
mod render;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

use crate::error::Result;

/// A raw Vulkan volume renderer and bench for depth-bounds culling
///
/// Runs the multi-pass ray casters of Krüger and Westermann (2003) and near-neighbor skipping (2005) pass by pass,
/// counts every fragment, times every pass and checks every picture against an f64 reference.
#[derive(Debug, Parser)]
#[command(version, about, max_term_width = 100, after_help = EXAMPLES)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

const EXAMPLES: &str = "Examples:
  depthleap bench -o out                                 every method on built-in volumes
  depthleap bench fuel.nrrd --tf ramp -o out             on a file
  depthleap render fuel.nrrd -o fuel.png                 one picture, its counts and times
  depthleap render builtin:shells:128 --method rc-ert -o -.png > shells.png
  depthleap plan fuel.nrrd --method rc-block             the passes, and what is left out
  depthleap info                                         devices, and which --cull works";

#[derive(Debug, Subcommand)]
enum Command {
    Render(Box<render::Render>),
    Bench(Box<bench::Bench>),
    Plan(Box<plan::Plan>),
    Info(info::Info),
}

/// Runs the program with the arguments of the process.
pub fn main() -> ExitCode {
    let cli = Cli::parse();
    let result = match cli.command {
        Command::Render(command) => command.run(),
        Command::Bench(command) => command.run(),
        Command::Plan(command) => command.run(),
        Command::Info(command) => command.run(),
    };
    finish(result)
}

fn finish(result: Result<()>) -> ExitCode {
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(error.exit_code())
        }
    }
}
