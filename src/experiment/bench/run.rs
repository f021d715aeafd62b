//! Runs every method on every scene, and keeps what comes of it.

use std::path::Path;

use crate::error::Result;
use crate::experiment::Host;
use crate::experiment::folder::{keep_picture, settings_in};
use crate::experiment::orbit::orbits;
use crate::frame::Verdict;
use crate::measure::Checked;
use crate::measure::error::difference;
use crate::measure::record::{DifferenceRecord, FORMAT, PictureRecord};
use crate::measure::runner::{Effort, Runner};
use crate::measure::write::{create_folder, write_json};
use crate::measure::{Measured, Results, Run};
use crate::method;
use crate::part::form::Form;
use crate::part::rows::Method;
use crate::provenance::Provenance;
use crate::read;
use crate::scene::Scene;
use crate::scene::settings::{Cull, MethodName, MethodSettings, Settings};

/// Differences are shown so many times as large: one of 1/255 is a grey that the eye sees.
const GAIN: f64 = 100.0;

/// What is to be run.
pub struct BenchJob {
    /// Each with its name.
    pub scenes: Vec<(String, Settings)>,
    pub methods: Vec<MethodName>,
    /// Whether nobody asked for these methods: a mesh of cells is drawn by those that go through cells then.
    pub by_default: bool,
    /// Whether methods that do not draw a scene are left out of it; else they are refused.
    pub where_drawn: bool,
    /// Every form of culling and marking that the device has, instead of the scene's.
    pub all_forms: bool,
    /// Sides of cells for near-neighbor skipping; those of the scene where there are none.
    pub cells: Vec<u32>,
    /// Frames timed, and frames run before any is.
    pub repeats: usize,
    pub warmups: usize,
    /// Whether each picture is compared with the f64 reference.
    pub reference: bool,
    /// Frames of an orbit.
    pub orbit: Option<usize>,
    /// The most extra fetches that a sample takes.
    pub most_fetches: Option<u32>,
}

impl BenchJob {
    /// # Errors
    /// When a scene or a method is refused, or the driver fails.
    pub fn run(&self, host: &Host) -> Result<Vec<Measured>> {
        // Every scene is read and planned before the first is run: a wrong one costs nobody minutes.
        let mut opened: Option<Checked> = None;
        for (name, settings) in &self.scenes {
            let scene = read::scene(settings)?;
            if opened.is_none() && self.methods.iter().any(|name| method::find(*name).is_some_and(|row| row.on_device))
            {
                opened = Some((host.open)()?);
            }
            let runner = Runner::new(opened.as_ref(), scene, name.clone());
            runner.check(&self.variants(opened.as_ref(), runner.scene()))?;
        }
        let effort = Effort { warmups: self.warmups, repeats: self.repeats, reference: self.reference };
        let mut measured = Vec::new();
        for (name, settings) in &self.scenes {
            let mut runner = Runner::new(opened.as_ref(), read::scene(settings)?, name.clone());
            let methods = self.variants(opened.as_ref(), runner.scene());
            let mut here = runner.measure(&methods, effort, host.say)?;
            if let Some(count) = self.orbit {
                orbits(&mut runner, &mut here, count, host.say)?;
            }
            measured.extend(here);
            for cost in self.costs() {
                runner.vary(|settings| settings.sampling.extra_fetches = cost);
                measured.extend(runner.measure(&methods, Effort { reference: false, ..effort }, host.say)?);
            }
        }
        opened.map_or(Ok(()), host.close)?;
        Ok(measured)
    }

    /// Extra fetches beyond those of the scene: doubled up to the most.
    fn costs(&self) -> Vec<u32> {
        let Some(most) = self.most_fetches else { return Vec::new() };
        let mut costs: Vec<u32> = std::iter::successors(Some(1u32), |cost| cost.checked_mul(2)).collect();
        costs.retain(|cost| *cost < most);
        costs.push(most);
        costs
    }

    /// `auto` for one scene: an orbit is a view that moves, for so many frames.
    fn chosen_freely(&self, settings: &Settings) -> MethodSettings {
        let base = MethodSettings { name: MethodName::AUTO, ..settings.method.clone() };
        match self.orbit.and_then(|count| u32::try_from(count).ok()) {
            Some(frames) => MethodSettings { frames, moving: true, ..base },
            None => base,
        }
    }

    /// The methods of one scene, in every form that is asked for.
    fn variants(&self, checked: Option<&Checked>, scene: &Scene) -> Vec<MethodSettings> {
        let (mut variants, settings) = (Vec::new(), &scene.settings);
        let of_cells = (self.by_default && scene.tetrahedra.is_some()).then(method::of_cells);
        for &name in of_cells.as_ref().unwrap_or(&self.methods) {
            if name.is_auto() {
                variants.push(self.chosen_freely(settings));
                continue;
            }
            if self.where_drawn && !method::takes(name, scene) {
                continue;
            }
            let forms: Vec<Form> = match self.all_forms {
                false => Vec::new(),
                true => method::forms(name).into_iter().filter(|form| available(checked, *form)).collect(),
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
}

fn available(checked: Option<&Checked>, form: Form) -> bool {
    checked.is_some_and(|checked| {
        let missing = matches!(checked.check.forms.get(&form), Some(Verdict::Missing(_)));
        !missing && (form.cull != Cull::Bounds || checked.device.info.depth_bounds)
    })
}

/// Keeps results and pictures in `folder`.
///
/// # Errors
/// When a file cannot be written.
pub fn keep(folder: &Path, measured: Vec<Measured>) -> Result<Results> {
    create_folder(folder)?;
    let (mut runs, mut pictures) = (Vec::new(), Vec::new());
    for (i, one) in measured.into_iter().enumerate() {
        let run = &one.run;
        let (place, form) = (format!("{i:03}"), run.form().unwrap_or_default());
        let words = ["bench", &place, &run.scene, &run.method, &form];
        let file = keep_picture(folder, &words, &one.picture, run.settings.image.background)?;
        let difference = one.reference.as_ref().map(|reference| {
            let picture = difference(&one.picture, reference, GAIN)?;
            let file = keep_picture(folder, &["bench", &place, "difference"], &picture, [0.0; 3])?;
            Ok(DifferenceRecord { file, gain: GAIN })
        });
        pictures.push(PictureRecord { run: i, file, difference: difference.transpose()? });
        let settings = settings_in(folder, one.run.settings);
        runs.push(Run { settings, ..one.run });
    }
    let results = Results { provenance: Provenance::now(FORMAT), runs, pictures };
    write_json(&folder.join("results.json"), &results)?;
    Ok(results)
}
