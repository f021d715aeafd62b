//! Times the frames of the frame rates: data sets in turn, from several directions.

use std::path::PathBuf;

use super::data::DataFolder;
use super::rates::{RATE_BASE, RATE_SETS, RENDERERS, RateSet};
use super::{CountedSet, ReproducedSet, Variant};
use crate::error::Result;
use crate::experiment::Host;
use crate::measure::abreast::measure_abreast;
use crate::measure::runner::{Checked, Effort, Runner};
use crate::read;
use crate::scene::settings::{Classification, Last, Settings};
use crate::scene::{Camera, Scene};

/// How much is timed.
#[derive(Clone, Debug)]
pub struct TimingPlan {
    /// Sides of the square viewports of the frame rates, pixels.
    pub sizes: Vec<u32>,
    /// Directions that a volume is seen from, once around.
    pub directions: u32,
    /// Frames timed from each.
    pub repeats: usize,
    /// With each choice made otherwise that the paper leaves open.
    pub sweep: bool,
}

impl TimingPlan {
    /// The viewport in which influences are shown, since frames cost the least there.
    pub fn smallest(&self) -> u32 {
        self.sizes.iter().copied().min().unwrap_or(1)
    }
}

/// A choice made otherwise than in the main configuration.
type TimedChoice = (&'static str, &'static str, fn(&mut Settings));

const MAIN: TimedChoice =
    ("main", "ramp, T = 1, pre-integrated, one slice of the paper's volume, eye 1.91 away", |_| {});

/// Choices of [`super::rates::RATES_OPEN`], each alone, in the smallest viewport.
const CHOICES: [TimedChoice; 4] = [
    ("early ray termination", "T = 0.95", |s| s.sampling.termination = TERMINATION),
    ("classification", "by the value of each sample", |s| s.sampling.classification = Classification::Post),
    ("sampling distance", "one slice of the file's volume", |s| s.sampling.step = 1.0),
    ("view", "eye 1.4 away", |s| s.camera.eye = tilted(s, NEAR_DISTANCE)),
];

/// T of frames whose rays end early.
pub const TERMINATION: f64 = 0.95;

/// T of frames whose rays do not.
pub const NO_TERMINATION: f64 = 1.0;

/// The tilt of the volume, degrees; how far the eye is from its centre, in longest sides, and how far where it is nearer;
/// and the vertical field of view, degrees.
const TILT: f64 = 20.0;
const DISTANCE: f64 = 1.91;
const NEAR_DISTANCE: f64 = 1.4;
const FOV: f64 = 45.0;

/// Where a turn begins, degrees: no direction then lies along an axis of the volume.
const FIRST_TURN: f64 = 15.0;

/// The sets of the frame rates, timed where their volumes are there and `checked` is a device; a picture of each from the
/// first direction.
///
/// # Errors
/// When a volume cannot be read, or the driver fails.
pub fn time_rates(
    checked: Option<&Checked>,
    data: DataFolder,
    plan: &TimingPlan,
    host: &Host,
) -> Result<Vec<CountedSet>> {
    let mut columns: Vec<CountedSet> = RATE_SETS.iter().map(|set| (untimed(set, data), None)).collect();
    let Some(checked) = checked else { return Ok(columns) };
    let smallest = [plan.smallest()];
    time_choice(checked, &mut columns, data, plan, (&MAIN, &plan.sizes), host)?;
    for choice in CHOICES.iter().filter(|_| plan.sweep) {
        time_choice(checked, &mut columns, data, plan, (choice, &smallest), host)?;
    }
    Ok(columns)
}

/// All data sets in turn, from every direction in every viewport, by each renderer.
fn time_choice(
    checked: &Checked,
    columns: &mut [CountedSet],
    data: DataFolder,
    plan: &TimingPlan,
    ((choice, value, change), sizes): (&TimedChoice, &[u32]),
    host: &Host,
) -> Result<()> {
    let mut timed: Vec<(Scene, &mut CountedSet)> = Vec::new();
    for (place, (set, column)) in RATE_SETS.iter().zip(columns).enumerate() {
        let Some(settings) = settings_of(set, data, *change) else { continue };
        // What a choice leaves as it was is not timed again, but for the set that the others are told in: frames that are
        // compared take turns.
        let again = !column.0.variants.is_empty() && Some(&settings) == settings_of(set, data, MAIN.2).as_ref();
        if again && place != RATE_BASE {
            continue;
        }
        let variant = Variant { choice: (*choice).to_owned(), value: (*value).to_owned(), runs: Vec::new() };
        column.0.variants.push(variant);
        timed.push((read::scene(&settings)?, column));
    }
    for (size, direction) in sizes.iter().flat_map(|size| (0..plan.directions).map(move |direction| (size, direction)))
    {
        let of = plan.directions;
        (host.say)(&format!("frame rates, {choice}: {value}, {size}^2, direction {} of {of}", direction + 1));
        let mut runners = Vec::new();
        for (scene, column) in &timed {
            for renderer in RENDERERS {
                let mut scene = turned(scene, plan, direction, *size);
                scene.settings.method.name = renderer.method.name();
                runners.push(Runner::new(Some(checked), scene, column.0.name.clone()));
            }
        }
        for (i, one) in measure_abreast(&mut runners, effort(plan))?.into_iter().enumerate() {
            let (column, picture) = &mut *timed[i / RENDERERS.len()].1;
            column.variants.last_mut().into_iter().for_each(|variant| variant.runs.push(one.run.clone()));
            picture.get_or_insert(one.picture);
        }
    }
    Ok(())
}

/// A data set that nothing was timed of yet, and why nothing will be where that is so.
fn untimed(set: &RateSet, data: DataFolder) -> ReproducedSet {
    let file = file_of(set, data);
    ReproducedSet {
        name: set.name.to_owned(),
        source: set.source(),
        file: file.as_ref().ok().map(|path| path.display().to_string()),
        absent: file.err(),
        picture: None,
        variants: Vec::new(),
    }
}

/// The file of a data set whose volume can be made of it, or why there is none.
pub fn file_of(set: &RateSet, data: DataFolder) -> std::result::Result<PathBuf, String> {
    set.open.map_err(str::to_owned).and_then(|_| data.volume(set.file))
}

/// The view and the sampling of a data set, from where a turn begins; none where its volume is not there.
pub fn settings_of(set: &RateSet, data: DataFolder, change: fn(&mut Settings)) -> Option<Settings> {
    let (open, path) = (set.open.ok()?, file_of(set, data).ok()?);
    let mut settings = Settings::default();
    open(&mut settings, path);
    settings.transfer.preset = Some("ramp".to_owned());
    settings.camera.fov_y = FOV;
    settings.camera.eye = tilted(&settings, DISTANCE);
    settings.sampling.step = set.step;
    settings.sampling.termination = NO_TERMINATION;
    settings.sampling.classification = Classification::PreIntegrated;
    settings.sampling.last = Last::None;
    change(&mut settings);
    Some(settings)
}

/// The eye where a turn begins, at a distance from what is looked at.
fn tilted(settings: &Settings, distance: f64) -> [f64; 3] {
    let eye = Camera::orbit(FIRST_TURN, TILT, distance, FOV).eye;
    (eye + glam::DVec3::from(settings.camera.target)).to_array()
}

/// The scene seen from one of the directions of a turn, in a square viewport.
pub fn turned(scene: &Scene, plan: &TimingPlan, direction: u32, size: u32) -> Scene {
    let degrees = 360.0 * f64::from(direction) / f64::from(plan.directions);
    let camera = Camera::from(&scene.settings.camera).turned(degrees);
    let mut scene = scene.clone().seen_by(camera);
    scene.settings.image.size = [size; 2];
    scene
}

/// The first draw with a new pipeline is thrown away.
pub fn effort(plan: &TimingPlan) -> Effort {
    Effort { warmups: 1, repeats: plan.repeats, reference: false }
}
