//! Counts the fragments of each data set, in the main configuration and with each choice made otherwise; then frames are timed
//! and figures drawn.

use std::path::{Path, PathBuf};

use super::data::{DataFolder, LEFT_OUT};
use super::figures::{self, DrawnFigure};
use super::papers::{DATA_SETS, DataSet, FOV, SAMPLES_PER_PASS, VIEWPORT};
use super::rates::{RATE_TABLES, TimingPlan, file_of, time_rates};
use super::stated_run::{Devices, run_stated};
use super::termination_run::time_termination;
use super::{FORMAT, ReproducedSet, Reproduction, StatedRecord, TimedRecord, Variant};
use crate::error::Result;
use crate::experiment::Host;
use crate::experiment::folder::{keep_picture, settings_in};
use crate::frame::EarlyEnd;
use crate::measure::Checked;
use crate::measure::record::Clock;
use crate::measure::runner::{Effort, Runner};
use crate::measure::write::{create_folder, write_json};
use crate::measure::{Picture, Run};
use crate::method;
use crate::provenance::Provenance;
use crate::read;
use crate::scene::Camera;
use crate::scene::settings::{Alpha, MethodSettings, PartialSegments, Settings};

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

/// A part of the work.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Part {
    /// The thesis' tables of fragments
    Counts,
    /// Frame rates and early ray termination
    Times,
    /// Pictures like the papers' figures
    Figures,
}

/// What is to be counted, timed and drawn.
pub struct ReproduceJob {
    /// The folder of the volumes.
    pub data: Option<PathBuf>,
    /// What is done.
    pub parts: Vec<Part>,
    /// Without the sweep over what the thesis leaves open.
    pub quick: bool,
    /// How frames are timed.
    pub timing: TimingPlan,
}

/// A data set, and its picture in the main configuration.
pub type CountedSet = (ReproducedSet, Option<Picture>);

/// Frames that were timed: the sets of the frame rates, and early ray termination.
pub struct TimedSets {
    /// What times are compared by on the device; none without one.
    pub clock: Option<Clock>,
    /// The sets of all of [`RATE_TABLES`], in their order.
    pub rates: Vec<CountedSet>,
    pub termination: ReproducedSet,
}

/// All that was counted and drawn.
pub struct Counted {
    /// Data sets in the order of [`DATA_SETS`].
    pub columns: Vec<CountedSet>,
    pub timed: TimedSets,
    pub figures: Vec<DrawnFigure>,
    pub stated: StatedRecord,
}

impl ReproduceJob {
    /// # Errors
    /// When a volume cannot be read, or the driver fails.
    pub fn run(&self, host: &Host) -> Result<Counted> {
        let opened = if self.needs_device() { Some((host.open)()?) } else { None };
        // In the papers every pass runs, those of rays that have ended too.
        let opened = opened.map(|checked| Checked { early_end: Some(EarlyEnd::Never), ..checked });
        let checked = opened.as_ref();
        let columns = DATA_SETS.iter().map(|set| self.column(checked, set, host)).collect::<Result<_>>()?;
        let times = self.data(Part::Times);
        let rates = time_rates(checked, times, &self.timing, host)?;
        let any = rates.iter().any(|(column, _)| !column.variants.is_empty());
        let clock = checked.filter(|_| any).map(clock);
        let timed = TimedSets { clock, rates, termination: time_termination(checked, times, &self.timing, host)? };
        let counted = checked.map(|one| Checked { early_end: None, ..one.clone() });
        let devices = Devices { counted: counted.as_ref(), every_pass: checked };
        let stated = run_stated(&devices, times, &self.timing, host)?;
        drop(counted);
        let figures = figures::draw(checked, self.data(Part::Figures), host)?;
        opened.map_or(Ok(()), host.close)?;
        Ok(Counted { columns, timed, figures, stated })
    }

    /// Whether any volume of a part that was asked for is there.
    fn needs_device(&self) -> bool {
        let times = self.data(Part::Times);
        let counted = DATA_SETS.iter().any(|set| self.file(set).is_ok());
        counted
            || RATE_TABLES.iter().any(|table| {
                let times = self.timing.of(table, times);
                table.sets.iter().any(|set| file_of(set, times).is_ok())
            })
            || figures::any_volume(self.data(Part::Figures))
    }

    /// A data set, counted where its volume is there.
    fn column(&self, checked: Option<&Checked>, set: &DataSet, host: &Host) -> Result<CountedSet> {
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
        if let (Ok(path), Some(checked)) = (&file, checked) {
            let choices = if self.quick { &[][..] } else { &CHOICES[..] };
            for choice in std::iter::once(&MAIN).chain(choices) {
                (host.say)(&format!("{}: {}, {}", set.name, choice.0, choice.1));
                let (variant, shown) = count(checked, set, path, *choice)?;
                column.variants.push(variant);
                picture = picture.or(shown);
            }
        }
        Ok((column, picture))
    }

    /// The file of a data set, or why there is none.
    fn file(&self, set: &DataSet) -> std::result::Result<PathBuf, String> {
        let Some(name) = set.file else { return Err(set.remark.unwrap_or("the volume is not available").to_owned()) };
        self.data(Part::Counts).volume(name)
    }

    fn data(&self, part: Part) -> DataFolder<'_> {
        let left_out = (!self.parts.contains(&part)).then_some(LEFT_OUT);
        DataFolder { folder: self.data.as_deref(), left_out }
    }
}

/// What times are compared by on a device.
fn clock(checked: &Checked) -> Clock {
    Clock::on(checked.device.info.is_cpu(), checked.device.info.timestamp_valid_bits > 0)
}

/// All rows of one configuration, and its picture where it is the main one. Where there are polygons, first without them and
/// then with them.
fn count(
    checked: &Checked,
    set: &DataSet,
    path: &Path,
    (choice, value, change): OpenChoice,
) -> Result<(Variant, Option<Picture>)> {
    let main = choice == MAIN.0;
    let settings = settings(set, path, change);
    let methods = methods(set, &settings.method);
    let measure = |settings: &Settings, methods: &[MethodSettings], reference: bool| {
        let effort = Effort { warmups: 0, repeats: 0, reference };
        Runner::new(Some(checked), read::scene(settings)?, set.name.to_owned()).measure(methods, effort, &|_| {})
    };
    let mut measured = measure(&settings, &methods, main && set.geometry.is_none())?;
    let mut shown = 0;
    if let Some(geometry) = &set.geometry {
        shown = measured.len();
        let scene = read::settings_of(geometry.scene.file, geometry.scene.text, Path::new(""))?;
        let mut settings = Settings { meshes: scene.meshes, ..settings };
        settings.layers.most = geometry.parts - 1;
        measured.extend(measure(&settings, &methods, false)?);
        settings.layers.partial = PartialSegments::Apart;
        measured.extend(measure(&settings, &apart(&settings.method), false)?);
    }
    let (runs, pictures): (Vec<Run>, Vec<Picture>) = measured.into_iter().map(|one| (one.run, one.picture)).unzip();
    let picture = pictures.into_iter().nth(shown).filter(|_| main);
    Ok((Variant { choice: choice.to_owned(), value: value.to_owned(), runs }, picture))
}

/// The view and the sampling of the thesis.
fn settings(set: &DataSet, path: &Path, change: fn(&mut Settings)) -> Settings {
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
    settings
}

/// The methods of a set's rows.
fn methods(set: &DataSet, base: &MethodSettings) -> Vec<MethodSettings> {
    let method = |name| MethodSettings { name, ..base.clone() };
    let mut methods = vec![method(method::RC_BLOCK.name()), block_first(base)];
    methods.extend(set.geometry.map(|_| method(method::RC_ERT.name())));
    methods.extend([method::NN_OPTIMAL, method::NN_OMNI, method::NN_DIRECTIONAL].map(|row| method(row.name())));
    if set.geometry.is_none() {
        let each = |name| MethodSettings { lookups: SAMPLES_PER_PASS, ..method(name) };
        methods.extend([method::NN_OPTIMAL, method::NN_OMNI].map(|row| each(row.name())));
    }
    methods
}

/// Empty blocks, looked for before the first main pass too.
fn block_first(base: &MethodSettings) -> MethodSettings {
    MethodSettings { name: method::RC_BLOCK.name(), block_first: true, ..base.clone() }
}

/// The methods that are counted with segments drawn apart too.
fn apart(base: &MethodSettings) -> Vec<MethodSettings> {
    let method = |name| MethodSettings { name, ..base.clone() };
    vec![block_first(base), method(method::NN_OPTIMAL.name()), method(method::NN_OMNI.name())]
}

/// Keeps what was counted in `folder`, with the pictures.
///
/// # Errors
/// When a file cannot be written.
pub fn keep(folder: &Path, counted: Counted) -> Result<Reproduction> {
    create_folder(folder)?;
    let keep_all = |sets: Vec<CountedSet>, what: fn(&ReproducedSet) -> String| -> Result<Vec<ReproducedSet>> {
        sets.into_iter().map(|set| keep_set(folder, &what(&set.0), set)).collect()
    };
    let columns = keep_all(counted.columns, |_| "reproduce".to_owned())?;
    let TimedSets { clock, rates, termination } = counted.timed;
    let timed = TimedRecord {
        clock,
        // Sets of several papers have one name; a source begins with its paper.
        rates: keep_all(rates, |set| format!("rates {}", set.source.split(',').next().unwrap_or_default()))?,
        termination: keep_set(folder, "termination", (termination, None))?,
    };
    let StatedRecord { slices, propagation } = counted.stated;
    let stated = StatedRecord {
        slices: keep_all(slices.into_iter().map(|set| (set, None)).collect(), |_| "slices".to_owned())?,
        propagation: keep_set(folder, "propagation", (propagation, None))?,
    };
    let mut figures = Vec::new();
    for (mut figure, picture) in counted.figures {
        figure.run.iter_mut().for_each(|run| run.settings = settings_in(folder, run.settings.clone()));
        if let Some(picture) = &picture {
            figure.picture = Some(keep_picture(folder, &["figure", &figure.scene], picture, [0.0; 3])?);
        }
        figures.push(figure);
    }
    let provenance = Provenance::now(FORMAT);
    let found = Reproduction { provenance, columns, figures, timed: Some(timed), stated: Some(stated) };
    write_json(&folder.join("reproduce.json"), &found)?;
    Ok(found)
}

/// A data set as the folder's JSON has it, its picture kept as one of `what`.
fn keep_set(folder: &Path, what: &str, (mut column, picture): CountedSet) -> Result<ReproducedSet> {
    for run in column.variants.iter_mut().flat_map(|variant| &mut variant.runs) {
        run.settings = settings_in(folder, run.settings.clone());
    }
    if let Some(picture) = &picture {
        column.picture = Some(keep_picture(folder, &[what, &column.name], picture, [0.0; 3])?);
    }
    Ok(column)
}
