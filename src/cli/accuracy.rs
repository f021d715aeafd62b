//! `depthleap accuracy`: error against run time.

use std::ffi::OsString;
use std::path::PathBuf;

use clap::Args;

use super::open::DeviceOptions;
use super::options::{SceneOptions, is_whole_scene, method_parser, scene_name};
use super::output::{self, Progress};
use crate::error::Result;
use crate::experiment::Host;
use crate::experiment::accuracy::{AccuracyJob, PAGES, keep, text};
use crate::experiment::folder::write_pages;
use crate::measure::write;
use crate::method;
use crate::scene::settings::MethodName;

/// Error against run time
///
/// Renders a scene by each method with ever shorter steps, and holds each picture against the exact emission-absorption
/// integral in f64: largest error, root mean square, PSNR, SSIM, beside the time of a frame. Fits the order in the step, says
/// why it may differ from theory's, and which method at which step is the fastest within an error of 1/255 and 1/1000.
/// Of an iso-surface (--iso) it measures where rays meet it, its normals and its colours, each by itself, by every way to find
/// places and to take gradients, against the root of the interpolant and its gradient there. Shells (--shells max or sum) are drawn in
/// ever larger numbers, beside rays with ever shorter steps. Ways through the cells of a mesh are integrated exactly, and looked up in
/// tables of ever more nodes. Adaptive steps (--tolerances) are made for ever smaller errors.
/// Writes accuracy.json, .csv, .html and two plots as SVG. Unless a scene file or an option says otherwise, pictures have
/// 160x160 pixels and rays end at an opacity of 0.999.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  depthleap accuracy builtin:gaussian:64 --tf linear -o out
  depthleap accuracy fuel.nrrd --method rc,nn-omni --steps 2,1,0.5,0.25 -o out
  depthleap accuracy fuel.nrrd --method rc,rc-ert,single-pass --tolerances 0.016,0.0039,0.001 -o out
  depthleap accuracy builtin:gaussian:64 --iso 0.4 -o out
  depthleap accuracy neghip.nrrd --shells sum --method shells,nn-omni -o out
  depthleap accuracy bluntfin_tet.vtk --array density -o out
  depthleap accuracy builtin:marschner-lobb:41 --full --viewport 100x100 -o out")]
pub struct AccuracyCommand {
    /// Scene file (.toml), volume file, mesh file, builtin:NAME:SIZE or a built-in scene [default: builtin:shells:64]
    #[arg(value_name = "SCENE|VOLUME")]
    scene: Option<OsString>,
    /// Folder for the files; made where it is missing
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
    /// Render methods, with commas between; the ways of sampling that are not the scene's are run by the first of them
    #[arg(long, value_name = "NAME,...", value_delimiter = ',', value_parser = method_parser(), default_values = METHODS.map(|method| method.name()))]
    method: Vec<MethodName>,
    /// Steps in voxels, with commas between
    #[arg(long, value_name = "VOXELS,...", value_delimiter = ',', default_values = STEPS)]
    steps: Vec<f64>,
    /// Numbers of shells of --method shells, with commas between
    #[arg(long, value_name = "N,...", value_delimiter = ',', default_values = SHELL_COUNTS)]
    shell_counts: Vec<u32>,
    /// Nodes along a side of the tables of ways through the cells of a mesh, with commas between
    #[arg(long, value_name = "N,...", value_delimiter = ',', default_values = TABLE_SIZES)]
    table_sizes: Vec<u32>,
    /// Errors that adaptive steps are made for, of methods that take such steps, with commas between; without, none are taken
    #[arg(long, value_name = "ERROR,...", value_delimiter = ',')]
    tolerances: Vec<f64>,
    /// Every way of sampling, by every method
    #[arg(long)]
    full: bool,
    /// Frames timed for each picture; 0 measures no times
    #[arg(long, value_name = "N", default_value_t = 3)]
    repeats: usize,
    #[command(flatten)]
    scene_options: SceneOptions,
    #[command(flatten)]
    device: DeviceOptions,
}

const METHODS: [MethodName; 5] = [
    method::RC.name(),
    method::RC_ERT.name(),
    method::RC_BLOCK.name(),
    method::NN_OMNI.name(),
    method::NN_OPTIMAL.name(),
];

const STEPS: [&str; 8] = ["8", "4", "2", "1", "0.5", "0.25", "0.125", "0.0625"];

const SHELL_COUNTS: [&str; 6] = ["4", "8", "16", "32", "64", "128"];

const TABLE_SIZES: [&str; 5] = ["8", "16", "32", "64", "128"];

/// A picture's side where nothing else is said: the exact integral takes its time.
const SIDE: u32 = 160;

/// T where nothing else is said: at the papers' 0.95 nothing but what lies behind is to be seen of the error.
const TERMINATION: f64 = 0.999;

impl AccuracyCommand {
    pub fn run(&self) -> Result<()> {
        write::check_folder(&self.output)?;
        let mut settings = self.scene_options.settings(self.scene.as_deref())?;
        let whole_scene = self.scene.as_deref().is_some_and(is_whole_scene);
        if self.scene_options.given.image.size.is_none() && !whole_scene {
            settings.image.size = [SIDE; 2];
        }
        if self.scene_options.given.sampling.termination.is_none() && !whole_scene {
            settings.sampling.termination = TERMINATION;
        }
        let job = AccuracyJob {
            name: scene_name(&settings),
            settings,
            methods: self.method.clone(),
            by_default: self.method == METHODS,
            steps: self.steps.clone(),
            shell_counts: self.shell_counts.clone(),
            table_sizes: self.table_sizes.clone(),
            tolerances: self.tolerances.clone(),
            full: self.full,
            repeats: self.repeats,
        };
        let progress = Progress::new();
        let (found, exact) = job.run(&Host {
            open: &|| self.device.open(),
            close: &|checked| self.device.close(checked),
            say: &|what| progress.say(what),
        })?;
        drop(progress);
        let found = keep(&self.output, found, &exact)?;
        let written = write_pages(&self.output, &[&PAGES])?;
        write::write_standard_output(format!("{}\n{}", text(&found), output::reports(&written)).as_bytes())
    }
}
