//! `depthleap bench`: every method on every scene, with a table, JSON, CSV and the report.

use std::ffi::OsString;
use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::open::DeviceOptions;
use super::options::{BENCH_METHODS, SceneOptions, method_parser, scene_name};
use super::output::{self, Progress, settings_in};
use crate::error::{Error, Result};
use crate::experiment::bench::{Difference, ReportInput, csv, report_html, table};
use crate::experiment::orbit::orbits;
use crate::frame::Verdict;
use crate::measure::error::difference;
use crate::measure::picture::Picture;
use crate::measure::record::{FORMAT, Results, Run};
use crate::measure::runner::{Checked, Effort, Measured, Runner};
use crate::measure::{write, write_atomically};
use crate::method;
use crate::part::form::Form;
use crate::part::rows::Method;
use crate::probe::{self, Probe};
use crate::provenance::Provenance;
use crate::read;
use crate::report::comparison::groups;
use crate::report::verdict;
use crate::scene::settings::{CELLS, Cull, EXTRA_FETCHES, MethodName, MethodSettings, Settings};

/// Every method on every scene: the main job
///
/// Prints a table like the thesis' and writes report.html, results.json and results.csv. A run is repeated with
/// `depthleap render --from DIR/results.json#INDEX`. A `method` in a scene file names no method here, but its other keys
/// count.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  depthleap bench -o out
  depthleap bench fuel.nrrd aneurism.nrrd --tf ramp -o out
  depthleap bench engine.nrrd --method rc-block,nn-omni --forms all --repeats 9 -o out
  depthleap bench engine.nrrd --method nn-omni,nn-optimal,nn-cone --orbit 72 -o out
  depthleap bench engine.nrrd --method rc-ert,nn-omni --gpu-cost 32 -o out
  depthleap bench engine.nrrd --method rc-block,nn-omni --cells 1,2,4,8 -o out
  depthleap render --from out/results.json#3 -o again.png")]
pub struct Bench {
    /// Scene files (.toml), volume files or builtin:NAME:SIZE
    #[arg(value_name = "SCENE|VOLUME", default_values = BUILT_IN)]
    scenes: Vec<OsString>,
    /// Folder for report.html, results.json and results.csv; made where it is missing
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
    /// Render methods, with commas between
    #[arg(long, value_name = "NAME,...", value_delimiter = ',', value_parser = method_parser(), default_values = BENCH_METHODS.map(MethodName::name))]
    method: Vec<MethodName>,
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

/// Differences are shown so many times as large: one of 1/255 is a grey that the eye sees.
const GAIN: f64 = 100.0;

/// What is run when no scene is given: a surface, thin structures in empty space, solid blocks.
const BUILT_IN: [&str; 3] = ["builtin:shells:96", "builtin:jets:128", "builtin:blocks:96"];

impl Bench {
    pub fn run(&self) -> Result<()> {
        write::check_folder(&self.output)?;
        let settings = |name: &OsString| self.scene_options.settings(Some(name));
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
        let scenes: Vec<Settings> = self.scenes.iter().map(settings).collect::<Result<_>>()?;
        // Every scene is read and planned before the first is run: a wrong one costs nobody minutes.
        let mut opened: Option<Checked> = None;
        for settings in &scenes {
            let scene = read::scene(settings)?;
            if opened.is_none() && self.method.iter().any(|name| method::find(*name).is_some_and(|row| row.on_device)) {
                opened = Some(self.device.open()?);
            }
            let runner = Runner::new(opened.as_ref(), scene, scene_name(settings));
            runner.check(&self.variants(opened.as_ref(), settings))?;
        }
        let progress = Progress::new();
        let effort = Effort { warmups: self.warmups, repeats: self.repeats, reference: !self.no_reference };
        let mut measured = Vec::new();
        for settings in &scenes {
            let methods = self.variants(opened.as_ref(), settings);
            let mut runner = Runner::new(opened.as_ref(), read::scene(settings)?, scene_name(settings));
            let mut here = runner.measure(&methods, effort, &|what| progress.say(what))?;
            if let Some(count) = self.orbit {
                orbits(&mut runner, &mut here, count, &|what| progress.say(what))?;
            }
            measured.extend(here);
            for cost in self.costs() {
                runner.vary(|settings| settings.sampling.extra_fetches = cost);
                let effort = Effort { reference: false, ..effort };
                measured.extend(runner.measure(&methods, effort, &|what| progress.say(what))?);
            }
        }
        drop(progress);
        opened.map_or(Ok(()), |checked| self.device.close(checked))?;
        self.write(measured)
    }

    /// Extra fetches beyond those of the scene: doubled up to the most.
    fn costs(&self) -> Vec<u32> {
        let Some(most) = self.gpu_cost else { return Vec::new() };
        let mut costs: Vec<u32> = std::iter::successors(Some(1u32), |cost| cost.checked_mul(2)).collect();
        costs.retain(|cost| *cost < most);
        costs.push(most);
        costs
    }

    /// The methods of one scene, in every form that is asked for.
    fn variants(&self, checked: Option<&Checked>, settings: &Settings) -> Vec<MethodSettings> {
        let mut variants = Vec::new();
        for &name in &self.method {
            let forms = match self.forms {
                Forms::One => Vec::new(),
                Forms::All => method::forms(name).into_iter().filter(|form| available(checked, *form)).collect(),
            };
            let cells = match method::find(name).and_then(Method::distance) {
                Some(_) if !self.cells.is_empty() => &self.cells[..],
                _ => &[settings.method.cell],
            };
            for &cell in cells {
                let base = MethodSettings { name, cell, ..settings.method.clone() };
                variants.extend(forms.iter().map(|f| MethodSettings { cull: f.cull, mark: f.mark, ..base.clone() }));
                if forms.is_empty() {
                    variants.push(base);
                }
            }
        }
        variants
    }

    /// What `depthleap probe` left in the same folder, of the same device and driver.
    fn probe_of(&self, results: &Results) -> Option<Probe> {
        let path = self.output.join("probe.json");
        let found = probe::record::read(&std::fs::read_to_string(&path).ok()?, &path.display().to_string()).ok()?;
        let same = |run: &Run| (run.device.as_str(), run.driver.trim()) == (&found.device.name, &found.device.driver);
        results.runs.iter().any(same).then_some(found)
    }

    fn write(&self, measured: Vec<Measured>) -> Result<()> {
        let mut runs = Vec::new();
        let broken: Vec<String> = measured.iter().filter_map(broken_law).collect();
        write::create_folder(&self.output)?;
        let (mut pictures, mut differences): (Vec<(usize, Picture)>, Vec<Difference>) = (Vec::new(), Vec::new());
        for (i, one) in measured.into_iter().enumerate() {
            if let Some(reference) = &one.reference {
                let picture = difference(&one.picture, reference, GAIN)?;
                differences.push(Difference { run: i, gain: GAIN, picture });
            }
            let settings = settings_in(&self.output, one.run.settings);
            runs.push(Run { settings, ..one.run });
            pictures.push((i, one.picture));
        }
        let results = Results { provenance: Provenance::now(FORMAT), runs };
        let probe = self.probe_of(&results);
        let input = ReportInput {
            title: "Depthleap bench",
            results: &results,
            pictures: &pictures,
            differences: &differences,
            probe: probe.as_ref(),
        };
        write_atomically(&self.output.join("results.json"), results.to_json()?.as_bytes())?;
        write_atomically(&self.output.join("results.csv"), csv(&results)?.as_bytes())?;
        let report = self.output.join("report.html");
        write_atomically(&report, report_html(&input)?.as_bytes())?;
        let verdict = verdict(&groups(&results.runs));
        output::warn(&results.runs);
        let text = format!("{}\n{verdict}\n\nReport: {}\n", table(&results.runs), report.display());
        write::write_standard_output(text.as_bytes())?;
        match broken.first() {
            None => Ok(()),
            Some(first) => Err(Error::check(
                "law of skipping",
                format!("{} run(s) changed the picture, the first: {first}", broken.len()),
                "this is a bug in depthleap, in the driver or in a changed shader; the report has the pictures",
            )),
        }
    }
}

/// A run whose form passed the self-check and whose picture skipping changed nevertheless.
fn broken_law(one: &Measured) -> Option<String> {
    let differs = |count: Option<u64>, what: &str| {
        let count = count.filter(|n| one.trusted && *n > 0)?;
        Some(format!("{}, {}: {count} {what}", one.run.scene, one.run.method))
    };
    differs(one.differing, "pixels").or_else(|| differs(one.differing_frames, "frames of the orbit"))
}

fn available(checked: Option<&Checked>, form: Form) -> bool {
    checked.is_some_and(|checked| {
        let missing = matches!(checked.check.forms.get(&form), Some(Verdict::Missing(_)));
        !missing && (form.cull != Cull::Bounds || checked.device.info.depth_bounds)
    })
}
