//! Counts the fragments of each data set, in the main configuration and with each choice made otherwise.

use std::path::{Path, PathBuf};

use super::papers::{DATA_SETS, DataSet, FOV, SAMPLES_PER_PASS, VIEWPORT};
use super::{FORMAT, ReproducedSet, Reproduction, Variant};
use crate::error::Result;
use crate::experiment::Host;
use crate::experiment::folder::{keep_picture, settings_in};
use crate::frame::EarlyEnd;
use crate::measure::runner::{Checked, Effort, Runner};
use crate::measure::write::{create_folder, write_json};
use crate::measure::{Picture, Run};
use crate::method;
use crate::provenance::Provenance;
use crate::read;
use crate::scene::Camera;
use crate::scene::settings::{Alpha, MethodSettings, Settings};

/// A choice made otherwise than in the main configuration.
type OpenChoice = (&'static str, &'static str, fn(&mut Settings));

const MAIN: OpenChoice =
    ("main", "ramp, T = 0.95, exponential opacity, cells of 1 voxel, rays end ahead of the faces", |_| {});

/// Each of [`super::papers::OPEN`] alone.
const CHOICES: [OpenChoice; 7] = [
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

/// What is to be counted.
pub struct ReproduceJob {
    /// The folder of the volumes.
    pub data: Option<PathBuf>,
    /// Without the sweep over what the thesis leaves open.
    pub quick: bool,
}

/// A data set, and its picture in the main configuration.
pub type CountedSet = (ReproducedSet, Option<Picture>);

impl ReproduceJob {
    /// Data sets in the order of [`DATA_SETS`].
    ///
    /// # Errors
    /// When a volume cannot be read, or the driver fails.
    pub fn run(&self, host: &Host) -> Result<Vec<CountedSet>> {
        let mut columns = Vec::new();
        let there = |set: &DataSet| self.file(set).is_ok();
        // In the papers every pass runs, those of rays that have ended too.
        let every_pass = |checked| Checked { early_end: Some(EarlyEnd::Never), ..checked };
        let opened = if DATA_SETS.iter().any(there) { Some(every_pass((host.open)()?)) } else { None };
        for set in &DATA_SETS {
            let file = self.file(set);
            let mut column = ReproducedSet {
                name: set.name.to_owned(),
                source: set.source.to_owned(),
                file: file.as_ref().ok().map(|path| path.display().to_string()),
                absent: file.as_ref().err().cloned(),
                picture: None,
                variants: Vec::new(),
            };
            let mut picture = None;
            if let (Ok(path), Some(checked)) = (&file, &opened) {
                let choices = if self.quick { &[][..] } else { &CHOICES[..] };
                for choice in std::iter::once(&MAIN).chain(choices) {
                    (host.say)(&format!("{}: {}, {}", set.name, choice.0, choice.1));
                    let (variant, shown) = count(checked, set, path, *choice)?;
                    column.variants.push(variant);
                    picture = picture.or(shown);
                }
            }
            columns.push((column, picture));
        }
        opened.map_or(Ok(()), host.close)?;
        Ok(columns)
    }

    /// The file of a data set, or why there is none.
    fn file(&self, set: &DataSet) -> std::result::Result<PathBuf, String> {
        let Some(name) = set.file else { return Err(set.remark.unwrap_or("the volume is not available").to_owned()) };
        let Some(folder) = &self.data else { return Err(format!("give the folder with {name} as --data")) };
        let path = folder.join(name);
        if path.is_file() { Ok(path) } else { Err(format!("{} is not there", path.display())) }
    }
}

/// All rows of one configuration, and its picture where it is the main one.
fn count(
    checked: &Checked,
    set: &DataSet,
    path: &Path,
    (choice, value, change): OpenChoice,
) -> Result<(Variant, Option<Picture>)> {
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

/// Keeps what was counted in `folder`, with the pictures.
///
/// # Errors
/// When a file cannot be written.
pub fn keep(folder: &Path, counted: Vec<CountedSet>) -> Result<Reproduction> {
    create_folder(folder)?;
    let mut columns = Vec::new();
    for (mut column, picture) in counted {
        for run in column.variants.iter_mut().flat_map(|variant| &mut variant.runs) {
            run.settings = settings_in(folder, run.settings.clone());
        }
        if let Some(picture) = &picture {
            column.picture = Some(keep_picture(folder, &["reproduce", &column.name], picture, [0.0; 3])?);
        }
        columns.push(column);
    }
    let found = Reproduction { provenance: Provenance::now(FORMAT), columns };
    write_json(&folder.join("reproduce.json"), &found)?;
    Ok(found)
}
