//! Frames of a camera that goes around the volume: which structure each of them read, and what it saved.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::hash::{DefaultHasher, Hash, Hasher};

use crate::error::Result;
use crate::frame::{Background, GpuFrame, Measure, plan_on};
use crate::measure::no_device;
use crate::measure::record::{ChangeRecord, OrbitFrame};
use crate::measure::runner::Runner;
use crate::measure::{Measured, Picture, compare};
use crate::plan;
use crate::scene::{Camera, Scene, Settings};

/// An orbit by one method.
#[derive(Clone, Debug)]
pub struct Orbit {
    pub frames: Vec<OrbitFrame>,
    /// What each frame's picture hashes to: equal pictures have equal ones.
    pub pictures: Vec<u64>,
}

/// Goes once around the volume in `count` frames by each method of `measured`, which gets the frames.
///
/// # Errors
/// As [`Runner::measure`].
pub fn orbits(runner: &mut Runner, measured: &mut [Measured], count: usize, progress: &dyn Fn(&str)) -> Result<()> {
    // By the method with the same samples that skips nothing.
    let mut rules: BTreeMap<(&str, u32), Vec<u64>> = BTreeMap::new();
    for one in measured.iter_mut().filter(|one| one.method.on_device) {
        let orbit = orbit(runner, &one.run.settings, count, progress)?;
        one.run.orbit = Some(orbit.frames);
        // As in the law of skipping: methods that end no ray early have pictures of their own.
        if !one.method.under_the_law() {
            continue;
        }
        match rules.entry((one.method.unskipped().name, one.run.settings.sampling.samples_per_pass)) {
            Entry::Vacant(place) => {
                place.insert(orbit.pictures);
            }
            Entry::Occupied(rule) => {
                let differing = rule.get().iter().zip(&orbit.pictures).filter(|(a, b)| a != b).count() as u64;
                one.differing_frames = Some(differing);
            }
        }
    }
    Ok(())
}

/// Goes once around the volume in `count` frames, by the method and with the M of `settings`.
///
/// # Errors
/// As [`Runner::measure`].
pub fn orbit(runner: &mut Runner, settings: &Settings, count: usize, progress: &dyn Fn(&str)) -> Result<Orbit> {
    let (Some(checked), Some(resident)) = (runner.checked, runner.resident.as_mut()) else { return Err(no_device()) };
    let mut base = runner.scene.clone();
    let method = &settings.method;
    base.settings.method = method.clone();
    base.settings.sampling.samples_per_pass = settings.sampling.samples_per_pass;
    let turned = |frame: usize| 360.0 * frame as f64 / count as f64;
    let scene_of = |frame: usize| -> Option<Scene> {
        let camera = Camera::from(&base.settings.camera).turned(turned(frame));
        (frame < count).then(|| base.clone().seen_by(camera))
    };
    let form = plan::form(&base, checked.check.automatic(method.name))?;
    let mut background = Background::new(&checked.device);
    let mut orbit = Orbit { frames: Vec::new(), pictures: Vec::new() };
    let mut before: Option<Picture> = None;
    for frame in 0..count {
        let Some(scene) = scene_of(frame) else { break };
        progress(&format!("{}: {}, frame {} of {count}", runner.name, method.name.name(), frame + 1));
        let mut plan = plan_on(&checked.device, &scene, form, None)?;
        // Nothing is built where the plan looks nothing up.
        let looks_up = plan.distance.is_some();
        let served = if looks_up { background.serve(frame, &scene, resident)? } else { None };
        if let Some(served) = served.filter(|served| plan.distance != Some(served.lookup)) {
            plan = plan_on(&checked.device, &scene, form, Some(served.lookup))?;
        }
        resident.prepare(&scene, &plan)?;
        let mut gpu = GpuFrame::new(&checked.device, &scene, &plan, resident, checked.early_end)?;
        let counts = gpu.run(Measure::Counts { statistics: false })?.fragments.unwrap_or_default();
        let picture = Picture::new(scene.settings.image.size, gpu.picture()?)?;
        let change = before.as_ref().map(|before| change(before, &picture)).transpose()?;
        let run = gpu.run(Measure::Nothing)?;
        let build_ms = if looks_up { background.go_on(frame, resident, &scene_of)? } else { 0.0 };
        orbit.pictures.push(hash(&picture.pixels));
        before = Some(picture);
        orbit.frames.push(OrbitFrame {
            frame,
            turned: turned(frame),
            structure: served.map(|served| served.lookup.distance.name().to_owned()),
            age: served.and_then(|served| served.age),
            main: counts.main.iter().sum(),
            intermediate: counts.intermediate.iter().sum(),
            frame_ms: run.frame_ms,
            cpu_ms: run.cpu_ms,
            build_ms,
            stack: plan.view.stack_axis().map(|axis| AXES[axis].to_owned()),
            change,
        });
    }
    resident.keep_views(&[]);
    Ok(orbit)
}

/// Names of the axes of a volume.
const AXES: [&str; 3] = ["x", "y", "z"];

fn change(before: &Picture, picture: &Picture) -> Result<ChangeRecord> {
    let compared = compare(picture, before, None)?;
    Ok(ChangeRecord { largest: compared.max, rms: compared.rmse })
}

fn hash(picture: &[[f32; 4]]) -> u64 {
    let mut hasher = DefaultHasher::new();
    picture.iter().for_each(|pixel| pixel.map(f32::to_bits).hash(&mut hasher));
    hasher.finish()
}
