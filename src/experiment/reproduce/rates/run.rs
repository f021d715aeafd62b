//! Times the frames of the frame rates: data sets in turn, from several directions.

use std::cell::RefCell;
use std::path::PathBuf;

use super::super::data::{DataFolder, PAPER_LEFT_OUT};
use super::super::{CountedSet, ReproducedSet, Variant};
use super::{DISTANCE, FOV, RATE_TABLES, RateSet, RateTable, TimedChoice, tilted};
use crate::error::Result;
use crate::experiment::Host;
use crate::measure::Checked;
use crate::measure::abreast::measure_abreast;
use crate::measure::runner::{Effort, Runner};
use crate::read;
use crate::scene::settings::{Settings, VolumeSettings};
use crate::scene::{Camera, Content, Scene};

/// How much is timed.
#[derive(Clone, Debug)]
pub struct TimingPlan {
    /// The papers whose frames are timed, as reports cite them in any case; none for all of them.
    pub papers: Option<Vec<String>>,
    /// Sides of the square viewports of the frame rates, pixels; none for those of each table.
    pub sizes: Option<Vec<u32>>,
    /// Directions that a volume is seen from, once around.
    pub directions: u32,
    /// Frames timed from each.
    pub repeats: usize,
    /// With each choice made otherwise that the paper leaves open.
    pub sweep: bool,
}

impl TimingPlan {
    fn sizes<'a>(&'a self, table: &'a RateTable) -> &'a [u32] {
        self.sizes.as_deref().unwrap_or(table.sizes)
    }

    /// The folder of the volumes as a table sees it.
    pub fn of<'a>(&self, table: &RateTable, data: DataFolder<'a>) -> DataFolder<'a> {
        let named = |papers: &Vec<String>| papers.iter().any(|paper| paper.eq_ignore_ascii_case(table.paper));
        let left_out = self.papers.as_ref().is_some_and(|papers| !named(papers)).then_some(PAPER_LEFT_OUT);
        DataFolder { left_out: data.left_out.or(left_out), ..data }
    }

    /// The viewport of a table in which influences are shown, since frames cost the least there.
    pub fn smallest(&self, table: &RateTable) -> u32 {
        self.sizes(table).iter().copied().min().unwrap_or(1)
    }
}

/// The sets of every table of frame rates, timed where their volumes are there and `checked` is a device; a picture of each from
/// the first direction.
///
/// # Errors
/// When a volume cannot be read, or the driver fails.
pub fn time_rates(
    checked: Option<&Checked>,
    data: DataFolder,
    plan: &TimingPlan,
    host: &Host,
) -> Result<Vec<CountedSet>> {
    let mut all = Vec::new();
    for table in RATE_TABLES {
        let data = plan.of(table, data);
        let mut columns: Vec<CountedSet> = table.sets.iter().map(|set| (untimed(table, set, data), None)).collect();
        if let Some(checked) = checked {
            let timing = Timing { table, checked, data, plan, host, volumes: RefCell::default() };
            timing.choice(&mut columns, &("main", table.main, |_| {}), plan.sizes(table))?;
            for choice in table.choices.iter().filter(|_| plan.sweep) {
                timing.choice(&mut columns, choice, &[plan.smallest(table)])?;
            }
        }
        all.extend(columns);
    }
    Ok(all)
}

/// What is needed to time a table.
struct Timing<'a> {
    table: &'static RateTable,
    checked: &'a Checked,
    data: DataFolder<'a>,
    plan: &'a TimingPlan,
    host: &'a Host<'a>,
    volumes: RefCell<KeptVolumes>,
}

/// Volumes that were read, and what was asked for of each: choices that are made otherwise hardly ever ask for another one, and that of a
/// mesh takes its time.
#[derive(Default)]
struct KeptVolumes(Vec<(VolumeSettings, Content)>);

impl KeptVolumes {
    /// The scene of settings, whose volume is read where it is not there.
    fn scene(&mut self, settings: &Settings) -> Result<Scene> {
        // Voxels are the same whatever range is shown of them.
        let asked = VolumeSettings { range: None, ..settings.volume.clone() };
        let place = match self.0.iter().position(|(of, _)| *of == asked) {
            Some(place) => place,
            None => {
                self.0.push((asked, read::content::content(&settings.volume)?));
                self.0.len() - 1
            }
        };
        read::scene_of(settings, |_| Ok(self.0[place].1.clone()))
    }
}

impl Timing<'_> {
    /// All data sets in turn, from every direction in every viewport, by each renderer.
    fn choice(&self, columns: &mut [CountedSet], (choice, value, change): &TimedChoice, sizes: &[u32]) -> Result<()> {
        let Self { table, data, plan, .. } = *self;
        let mut timed: Vec<(Scene, &mut CountedSet)> = Vec::new();
        let mut volumes = self.volumes.borrow_mut();
        for (place, (set, column)) in table.sets.iter().zip(columns).enumerate() {
            let Some(settings) = settings_of(table, set, data, *change) else { continue };
            // What a choice leaves as it was is not timed again, but for the set that the others are told in: frames that are
            // compared take turns.
            let main = settings_of(table, set, data, |_| {});
            let again = !column.0.variants.is_empty() && Some(&settings) == main.as_ref();
            if again && Some(place) != table.base_set {
                continue;
            }
            let variant = Variant { choice: (*choice).to_owned(), value: (*value).to_owned(), runs: Vec::new() };
            column.0.variants.push(variant);
            timed.push((volumes.scene(&settings)?, column));
        }
        let directions = || 0..plan.directions;
        for (size, direction) in sizes.iter().flat_map(|size| directions().map(move |direction| (*size, direction))) {
            let place = format!("{size}^2, direction {} of {}", direction + 1, plan.directions);
            (self.host.say)(&format!("{}, frame rates, {choice}: {value}, {place}", table.paper));
            self.direction(&mut timed, direction, size)?;
        }
        Ok(())
    }

    /// All data sets in turn by each renderer, from one direction in one viewport.
    fn direction(&self, timed: &mut [(Scene, &mut CountedSet)], direction: u32, size: u32) -> Result<()> {
        let renderers = self.table.renderers;
        let mut runners = Vec::new();
        for (scene, column) in timed.iter() {
            for renderer in renderers {
                let mut scene = turned(scene, self.plan, direction, size);
                scene.settings.method.name = renderer.method.name();
                (renderer.adapt)(&mut scene.settings);
                runners.push(Runner::new(Some(self.checked), scene, column.0.name.clone()));
            }
        }
        for (i, one) in measure_abreast(&mut runners, effort(self.plan))?.into_iter().enumerate() {
            let (column, picture) = &mut *timed[i / renderers.len()].1;
            column.variants.last_mut().into_iter().for_each(|variant| variant.runs.push(one.run.clone()));
            picture.get_or_insert(one.picture);
        }
        Ok(())
    }
}

/// A data set that nothing was timed of yet, and why nothing will be where that is so.
fn untimed(table: &RateTable, set: &RateSet, data: DataFolder) -> ReproducedSet {
    let file = file_of(set, data);
    ReproducedSet {
        name: set.name.to_owned(),
        source: table.source(set),
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
pub fn settings_of(table: &RateTable, set: &RateSet, data: DataFolder, change: fn(&mut Settings)) -> Option<Settings> {
    let (open, path) = (set.open.ok()?, file_of(set, data).ok()?);
    let mut settings = Settings::default();
    open(&mut settings, path);
    settings.transfer.preset = Some("ramp".to_owned());
    settings.camera.fov_y = FOV;
    settings.camera.eye = tilted(&settings, DISTANCE);
    settings.sampling.step = set.step;
    (table.common)(&mut settings);
    change(&mut settings);
    Some(settings)
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
