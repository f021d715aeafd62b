//! `depthleap reproduce`: the papers' tables, theirs beside ours.

use std::path::{Path, PathBuf};

use clap::Args;

use super::open::DeviceOptions;
use super::output::{Progress, settings_in};
use crate::error::Result;
use crate::experiment::reproduce::papers::{DATA_SETS, DataSet, FOV, SAMPLES_PER_PASS, VIEWPORT};
use crate::experiment::reproduce::{FORMAT, ReproducedSet, Reproduction, Shown, Variant, csv, page, text};
use crate::frame::EarlyEnd;
use crate::measure::runner::{Checked, Effort, Runner};
use crate::measure::{Run, write, write_atomically};
use crate::method;
use crate::provenance::Provenance;
use crate::read;
use crate::scene::Camera;
use crate::scene::settings::{Alpha, MethodSettings, Settings};

/// The papers' tables, theirs beside ours
///
/// Counts the fragments of the thesis' Tables 1 and 2 of chapter 5 and Table 1 of chapter 7 with its volumes, views and
/// steps, and prints its numbers beside ours, with the ratios to block skipping. What the thesis leaves open is swept, one
/// choice at a time. Volumes that are not there are named, and nothing stands in for them. Writes reproduce.html,
/// reproduce.json and reproduce.csv.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  depthleap reproduce --data volumes -o out
  depthleap reproduce --data volumes --quick -o out
  depthleap reproduce -o out                         the papers' numbers alone")]
pub struct Reproduce {
    /// Folder with the volumes, by their names: engine_256cube.nrrd, fuel.nrrd; mri_head.nrrd and aneurism.nrrd are shown
    /// besides
    #[arg(long, value_name = "DIR")]
    data: Option<PathBuf>,
    /// Folder for the files; made where it is missing
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
    /// Leave out the sweep over what the thesis leaves open
    #[arg(long)]
    quick: bool,
    #[command(flatten)]
    device: DeviceOptions,
}

/// A choice made otherwise than in the main configuration.
type Choice = (&'static str, &'static str, fn(&mut Settings));

const MAIN: Choice =
    ("main", "ramp, T = 0.95, exponential opacity, cells of 1 voxel, rays end ahead of the faces", |_| {});

/// Each of [`crate::experiment::reproduce::papers::OPEN`] alone.
const CHOICES: [Choice; 7] = [
    ("transfer function", "linear", |s| s.transfer.preset = Some("linear".to_owned())),
    ("transfer function", "linear from 12/255", |s| {
        let white = |x: f64, opacity: f64| [x, 1.0, 1.0, 1.0, opacity];
        s.transfer.preset = None;
        s.transfer.points = Some(vec![white(0.0, 0.0), white(12.0 / 255.0, 0.0), white(1.0, 1.0)]);
    }),
    ("threshold T", "0.5", |s| s.sampling.termination = 0.5),
    ("threshold T", "1", |s| s.sampling.termination = 1.0),
    ("opacity correction", "none", |s| s.sampling.alpha = Alpha::Paper),
    ("definition of distance", "cells of 2^3 voxels", |s| s.method.cell = 2),
    ("end of a ray", "noticed on arrival", |s| s.method.exit_lookahead = false),
];

impl Reproduce {
    pub fn run(&self) -> Result<()> {
        write::check_folder(&self.output)?;
        let mut columns = Vec::new();
        let mut pictures = Vec::new();
        let there = |set: &DataSet| self.file(set).is_ok();
        // In the papers every pass runs, those of rays that have ended too.
        let every_pass = |checked| Checked { early_end: Some(EarlyEnd::Never), ..checked };
        let opened = if DATA_SETS.iter().any(there) { Some(every_pass(self.device.open()?)) } else { None };
        let progress = Progress::new();
        for (i, set) in DATA_SETS.iter().enumerate() {
            let file = self.file(set);
            let mut column = ReproducedSet {
                name: set.name.to_owned(),
                source: set.source.to_owned(),
                file: file.as_ref().ok().map(|path| path.display().to_string()),
                absent: file.as_ref().err().cloned(),
                variants: Vec::new(),
            };
            if let (Ok(path), Some(checked)) = (&file, &opened) {
                let choices = if self.quick { &[][..] } else { &CHOICES[..] };
                for choice in std::iter::once(&MAIN).chain(choices) {
                    progress.say(&format!("{}: {}, {}", set.name, choice.0, choice.1));
                    let (variant, shown) = self.count(checked, set, path, *choice)?;
                    column.variants.push(variant);
                    pictures.extend(shown.map(|picture| Shown { column: i, picture }));
                }
            }
            columns.push(column);
        }
        drop(progress);
        opened.map_or(Ok(()), |checked| self.device.close(checked))?;
        self.write(columns, &pictures)
    }

    /// The file of a data set, or why there is none.
    fn file(&self, set: &DataSet) -> std::result::Result<PathBuf, String> {
        let Some(name) = set.file else { return Err(set.remark.unwrap_or("the volume is not available").to_owned()) };
        let Some(folder) = &self.data else { return Err(format!("give the folder with {name} as --data")) };
        let path = folder.join(name);
        if path.is_file() { Ok(path) } else { Err(format!("{} is not there", path.display())) }
    }

    /// All rows of one configuration, and its picture where it is the main one.
    fn count(
        &self,
        checked: &Checked,
        set: &DataSet,
        path: &Path,
        (choice, value, change): Choice,
    ) -> Result<(Variant, Option<crate::measure::Picture>)> {
        let main = choice == MAIN.0;
        let mut settings = Settings::default();
        settings.volume.path = Some(path.to_owned());
        settings.transfer.preset = Some("ramp".to_owned());
        settings.image.size = [VIEWPORT; 2];
        settings.camera.fov_y = FOV;
        settings.camera.eye = Camera::orbit(0.0, 0.0, set.distance(), FOV).eye.to_array();
        settings.sampling.samples_per_pass = SAMPLES_PER_PASS;
        settings.sampling.step = set.step_voxels();
        // None after the last main pass.
        settings.sampling.passes = set.intermediate_passes + 1;
        change(&mut settings);
        let method = |name| MethodSettings { name, ..settings.method.clone() };
        let methods = [
            method(method::RC_BLOCK.name()),
            MethodSettings { block_first: true, ..method(method::RC_BLOCK.name()) },
            method(method::NN_OPTIMAL.name()),
            method(method::NN_OMNI.name()),
            method(method::NN_DIRECTIONAL.name()),
            MethodSettings { lookups: SAMPLES_PER_PASS, ..method(method::NN_OPTIMAL.name()) },
            MethodSettings { lookups: SAMPLES_PER_PASS, ..method(method::NN_OMNI.name()) },
        ];
        let effort = Effort { warmups: 0, repeats: 0, reference: main };
        let mut runner = Runner::new(Some(checked), read::scene(&settings)?, set.name.to_owned());
        let mut measured = runner.measure(&methods, effort, &|_| {})?;
        let picture = measured.drain(..1).next();
        let first = picture.as_ref().map(|one| one.run.clone());
        let runs: Vec<Run> = first.into_iter().chain(measured.into_iter().map(|one| one.run)).collect();
        let variant = Variant { choice: choice.to_owned(), value: value.to_owned(), runs };
        Ok((variant, picture.map(|one| one.picture).filter(|_| main)))
    }

    fn write(&self, mut columns: Vec<ReproducedSet>, pictures: &[Shown]) -> Result<()> {
        write::create_folder(&self.output)?;
        for run in columns.iter_mut().flat_map(|c| &mut c.variants).flat_map(|v| &mut v.runs) {
            run.settings = settings_in(&self.output, run.settings.clone());
        }
        let found = Reproduction { provenance: Provenance::now(FORMAT), columns };
        super::output::write_json(&self.output.join("reproduce.json"), &found)?;
        write_atomically(&self.output.join("reproduce.csv"), csv(&found)?.as_bytes())?;
        let report = self.output.join("reproduce.html");
        write_atomically(&report, page(&found, pictures)?.as_bytes())?;
        let out = format!("{}\nReport: {}\n", text(&found), report.display());
        write::write_standard_output(out.as_bytes())
    }
}
