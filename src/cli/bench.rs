//! `depthleap bench`: every method on every scene, with a table, JSON, CSV and the report.

use std::ffi::OsString;
use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::open::DeviceOptions;
use super::options::{AskedMethods, BENCH_METHODS, SceneOptions, asked_methods_parser, scene_name};
use super::output::{self, Progress};
use crate::error::{Error, Result};
use crate::experiment::Host;
use crate::experiment::bench::{self, BenchJob, keep, table};
use crate::experiment::folder::write_pages;
use crate::measure::{law, write};
use crate::report::comparison::groups;
use crate::report::{branching, choices, verdict};
use crate::scene::settings::{CELLS, EXTRA_FETCHES, MethodName, Settings};

/// Every method on every scene: the main job
///
/// Prints a table like the thesis' and writes report.html, results.json and results.csv. A run is repeated with
/// `depthleap render --from DIR/results.json#INDEX`. A `method` in a scene file names no method here, but its other keys
/// count.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  depthleap bench -o out
  depthleap bench fuel.nrrd aneurism.nrrd --tf ramp -o out
  depthleap bench engine.nrrd fuel.nrrd --method all,auto -o out
  depthleap bench engine.nrrd --method rc-block,nn-omni --forms all --repeats 9 -o out
  depthleap bench engine.nrrd --method nn-omni,nn-optimal,nn-cone --orbit 72 -o out
  depthleap bench engine.nrrd --method rc-ert,nn-omni --gpu-cost 32 -o out
  depthleap bench engine.nrrd --method rc-block,nn-omni --cells 1,2,4,8 -o out
  depthleap render --from out/results.json#3 -o again.png")]
pub struct BenchCommand {
    /// Scene files (.toml), volume files, mesh files, builtin:NAME:SIZE or built-in scenes
    #[arg(value_name = "SCENE|VOLUME", default_values = BUILT_IN)]
    scenes: Vec<OsString>,
    /// Folder for report.html, results.json and results.csv; made where it is missing
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
    /// Render methods, with commas between
    #[arg(long, value_name = "NAME,...", value_delimiter = ',', value_parser = asked_methods_parser(), default_values = BENCH_METHODS.map(MethodName::name))]
    method: Vec<AskedMethods>,
    /// Forms of culling and marking
    #[arg(long, value_name = "WHICH", default_value = "one")]
    forms: Forms,
    /// Run nn-* with cells of each of these sides, instead of --cell: what larger ones save in building and cost in frames
    #[arg(long, value_name = "VOXELS,...", value_delimiter = ',')]
    cells: Vec<u32>,
    /// Frames timed for each method; 0 counts only
    #[arg(long, value_name = "N", default_value_t = 5, allow_negative_numbers = true)]
    repeats: usize,
    /// Frames run before any is timed
    #[arg(long, value_name = "N", default_value_t = 1, allow_negative_numbers = true)]
    warmups: usize,
    /// Go around each volume in N frames as well, while structures for coming views are built beside the frames
    #[arg(long, value_name = "N")]
    orbit: Option<usize>,
    /// Run each scene again with samples that take 1, 2, 4, ... up to K extra fetches, one after another: where skipping
    /// starts to pay
    #[arg(long, value_name = "K")]
    gpu_cost: Option<u32>,
    /// Leave out the f64 reference: no error and no lower bound
    #[arg(long)]
    no_reference: bool,
    #[command(flatten)]
    scene_options: SceneOptions,
    #[command(flatten)]
    device: DeviceOptions,
}

#[derive(Clone, Copy, Debug, PartialEq, ValueEnum)]
enum Forms {
    /// The one that --cull and --mark name, or `auto` finds
    One,
    /// Every one the device has, instead of --cull and --mark
    All,
}

/// What is run when no scene is given: a surface, thin structures in empty space, solid blocks, polygons in a block, a clipped
/// head.
const BUILT_IN: [&str; 5] =
    ["builtin:shells:96", "builtin:jets:128", "builtin:blocks:96", "builtin:engine-geometry", "builtin:head-clipped"];

impl BenchCommand {
    pub fn run(&self) -> Result<()> {
        write::check_folder(&self.output)?;
        if let Some(cell) = self.cells.iter().find(|cell| !CELLS.contains(cell)) {
            return Err(Error::usage("--cells", format!("has {cell}"), "give some of 1, 2, 4 and 8 voxels"));
        }
        if let Some(cost) = self.gpu_cost.filter(|cost| *cost == 0 || !EXTRA_FETCHES.contains(cost)) {
            let most = EXTRA_FETCHES.end();
            return Err(Error::usage("--gpu-cost", format!("is {cost}"), format!("give a number from 1 to {most}")));
        }
        if self.orbit == Some(0) {
            return Err(Error::usage("--orbit", "is 0", "give the number of frames for one turn"));
        }
        let scene = |name: &OsString| -> Result<(String, Settings)> {
            let settings = self.scene_options.settings(Some(name))?;
            settings.sampling.as_written()?;
            Ok((scene_name(&settings), settings))
        };
        let job = BenchJob {
            scenes: self.scenes.iter().map(scene).collect::<Result<_>>()?,
            methods: self.method.iter().flat_map(AskedMethods::names).collect(),
            by_default: self.method == BENCH_METHODS.map(AskedMethods::One),
            where_drawn: self.method.contains(&AskedMethods::All),
            all_forms: self.forms == Forms::All,
            cells: self.cells.clone(),
            repeats: self.repeats,
            warmups: self.warmups,
            reference: !self.no_reference,
            orbit: self.orbit,
            most_fetches: self.gpu_cost,
        };
        let effect = job.scenes.iter().any(|(_, settings)| settings.effects.file.is_some());
        let progress = Progress::new();
        let measured = job.run(&Host {
            open: &|| self.device.open_for(effect),
            close: &|checked| self.device.close(checked),
            say: &|what| progress.say(what),
        })?;
        drop(progress);
        let lawful = law::check(&measured);
        let results = keep(&self.output, measured)?;
        let written = write_pages(&self.output, &[&bench::PAGES])?;
        output::warn(&results.runs);
        let groups = groups(&results.runs);
        let verdict = std::iter::once(verdict(&groups))
            .chain(branching(&groups))
            .chain(choices(&groups))
            .collect::<Vec<_>>()
            .join("\n");
        let text = format!("{}\n{verdict}\n\n{}", table(&results.runs), output::reports(&written));
        write::write_standard_output(text.as_bytes())?;
        lawful
    }
}
