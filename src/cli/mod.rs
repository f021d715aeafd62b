//! The command line: one file a command.

mod accuracy;
mod bench;
mod compare;
mod info;
mod open;
mod options;
mod output;
mod plan;
mod probe;
mod render;
mod report;
mod reproduce;
mod shells;
mod stability;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

use crate::error::{Result, shown};
use crate::measure::write::write_standard_error;
use crate::scene::{builtin, scenes, tetrahedra};
use crate::vulkan::{exit_at_once, gave_up};

/// A raw Vulkan volume renderer and bench for depth-bounds culling
///
/// Runs the multi-pass ray casters of Krüger and Westermann (2003) and near-neighbor skipping (2005) pass by pass,
/// counts every fragment, times every pass and checks every picture against an f64 reference.
#[derive(Debug, Parser)]
#[command(version, about, max_term_width = 100, after_help = EXAMPLES)]
#[command(after_long_help = format!("{EXAMPLES}\n\n{INPUT}\n\n{}\n\n{NOTES}", built_in()))]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

const EXAMPLES: &str = "Examples:
  depthleap bench -o out                                 every method on built-in volumes
  depthleap bench fuel.nrrd --tf ramp -o out             on a file
  depthleap render fuel.nrrd -o fuel.png                 one picture, its counts and times
  depthleap render builtin:shells:128 --method rc-ert -o -.png > shells.png
  depthleap render builtin:engine-geometry -o engine.png polygons in a volume
  depthleap reproduce --data volumes -o out              the papers' tables, theirs beside ours
  depthleap probe -o out                                 what this driver culls before shading
  depthleap accuracy builtin:gaussian:64 -o out          error against run time
  depthleap stability -o out                             stiff and extreme cases
  depthleap compare before after                         what differs between two results
  depthleap report out                                   the pages of a folder again, from its JSON
  depthleap plan fuel.nrrd --method rc-block             the passes, and what is left out
  depthleap shells fuel.nrrd --count 6 -o fuel.ply       iso-surfaces as polygons
  depthleap info                                         devices, and which --cull works";

const INPUT: &str = "Input:
  A SCENE is a TOML file or the builtin:NAME of a scene; every option has its key there, an option
  given wins. A VOLUME is an NRRD file, a raw file with --dims and --type, a PLY, OBJ, STL or glTF
  mesh, of which it is the distance field, a file of VTK (legacy, VTU, VTS, VTR), a mesh of cells, or
  builtin:NAME:SIZE.
  Without either the volume is builtin:shells:64.";

const NOTES: &str = "Output:
  Files are written to a temporary name and renamed: they are there completely or not at all. Where
  a file is asked for, - stands for standard output (a PNG; -.exr and -.npy name another format).
  Tables of `render` and progress go to standard error, progress on a terminal only.

Exit codes:
  0  done
  1  done, and `compare` found counts that differ
  2  an option, or a combination of options, that makes no sense
  3  a file, or a value in it, that is wrong
  4  a device, or a feature of it, that is missing; a device that was lost or did not end its work
  5  a check that did not hold: messages of the validation layer, a wrong picture
  6  a result that could not be written

Environment:
  VK_DRIVER_FILES  drivers the Vulkan loader offers (VK_ICD_FILENAMES for older loaders)
  NO_COLOR         no colours in messages";

/// What is built in, each with what it is.
fn built_in() -> String {
    let line = |(name, about): (&str, &str)| format!("\n  {name:<16} {about}");
    let volumes: String = builtin::ALL.iter().map(|row| line((row.name, row.about))).collect();
    let meshes: String = tetrahedra::builtin::MESHES.iter().map(|row| line((row.name, row.about))).collect();
    let scenes: String = scenes::ALL.iter().map(|row| line((row.name, row.about))).collect();
    format!(
        "Built-in volumes, builtin:NAME:SIZE:{volumes}\n\nBuilt-in meshes of tetrahedra, builtin:NAME:SIZE:{meshes}\n\nBuilt-in scenes, builtin:NAME:{scenes}"
    )
}

#[derive(Debug, Subcommand)]
enum Command {
    Render(Box<render::Render>),
    Bench(Box<bench::BenchCommand>),
    Reproduce(Box<reproduce::ReproduceCommand>),
    Probe(Box<probe::ProbeCommand>),
    Accuracy(Box<accuracy::AccuracyCommand>),
    Stability(Box<stability::StabilityCommand>),
    Compare(compare::CompareCommand),
    Report(report::ReportCommand),
    Plan(Box<plan::PlanCommand>),
    Shells(Box<shells::ShellsCommand>),
    Info(info::InfoCommand),
}

/// Runs the program with the arguments of the process.
pub fn main() -> ExitCode {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) => {
            let text = error.render().to_string();
            if !error.use_stderr() || shown(&text) == text {
                error.exit();
            }
            write_standard_error(&format!("{}\n", shown(&text).trim_end()));
            return ExitCode::from(2);
        }
    };
    let result = match cli.command {
        Command::Compare(command) => return command.run().unwrap_or_else(|error| finish(Err(error))),
        Command::Render(command) => command.run(),
        Command::Bench(command) => command.run(),
        Command::Reproduce(command) => command.run(),
        Command::Probe(command) => command.run(),
        Command::Accuracy(command) => command.run(),
        Command::Stability(command) => command.run(),
        Command::Report(command) => command.run(),
        Command::Plan(command) => command.run(),
        Command::Shells(command) => command.run(),
        Command::Info(command) => command.run(),
    };
    finish(result)
}

fn finish(result: Result<()>) -> ExitCode {
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            // One line, whatever a driver or a file name holds.
            let line = error.to_string().replace(['\n', '\r'], " ");
            write_standard_error(&format!("error: {line}\n"));
            if gave_up() {
                exit_at_once(error.exit_code());
            }
            ExitCode::from(error.exit_code())
        }
    }
}
