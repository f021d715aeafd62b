//! Frames of a camera that goes around the volume: which structure each of them read, and what it saved.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::hash::{DefaultHasher, Hash, Hasher};

use crate::error::Result;
use crate::frame::{Background, GpuFrame, Measure, plan_on};
use crate::measure::Measured;
use crate::measure::record::OrbitFrame;
use crate::measure::runner::{Runner, no_device};
use crate::plan;
use crate::scene::settings::MethodSettings;
use crate::scene::{Camera, Scene};

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
    let mut rules: BTreeMap<&str, Vec<u64>> = BTreeMap::new();
    for one in measured.iter_mut().filter(|one| one.method.on_device) {
        let orbit = orbit(runner, &one.run.settings.method, count, progress)?;
        one.run.orbit = Some(orbit.frames);
        // As in the law of skipping: methods that end no ray early have pictures of their own.
        if !one.method.under_the_law() {
            continue;
        }
        match rules.entry(one.method.unskipped().name) {
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

/// Goes once around the volume in `count` frames.
///
/// # Errors
/// As [`Runner::measure`].
pub fn orbit(runner: &mut Runner, method: &MethodSettings, count: usize, progress: &dyn Fn(&str)) -> Result<Orbit> {
    let (Some(checked), Some(resident)) = (runner.checked, runner.resident.as_mut()) else { return Err(no_device()) };
    let mut base = runner.scene.clone();
    base.settings.method = method.clone();
    let turned = |frame: usize| 360.0 * frame as f64 / count as f64;
    let scene_of = |frame: usize| -> Option<Scene> {
        let camera = Camera::from(&base.settings.camera).turned(turned(frame));
        (frame < count).then(|| base.clone().seen_by(camera))
    };
    let form = plan::form(&base, checked.check.automatic(method.name))?;
    let mut background = Background::new(&checked.device);
    let mut orbit = Orbit { frames: Vec::new(), pictures: Vec::new() };
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
        let picture = gpu.picture()?;
        let run = gpu.run(Measure::Nothing)?;
        let build_ms = if looks_up { background.go_on(frame, resident, &scene_of)? } else { 0.0 };
        orbit.pictures.push(hash(&picture));
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
        });
    }
    resident.keep_views(&[]);
    Ok(orbit)
}

fn hash(picture: &[[f32; 4]]) -> u64 {
    let mut hasher = DefaultHasher::new();
    picture.iter().for_each(|pixel| pixel.map(f32::to_bits).hash(&mut hasher));
    hasher.finish()
}
