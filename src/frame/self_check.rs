//! Which forms of culling are right on this very device: a small frame is run in each, and counts and picture are
//! held against the rule. Drivers get the depth bounds test wrong; a wrong one is named and never trusted.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::cpu::{self, Counts};
use super::gpu::{GpuFrame, Measure};
use super::resident::Resident;
use super::structures::Structures;
use crate::error::Result;
use crate::pass::cull::Form;
use crate::plan;
use crate::scene::builtin;
use crate::scene::field::{Field, NanPolicy};
use crate::scene::settings::{Cull, Filter, Mark, MethodName, Settings};
use crate::scene::{Camera, Scene, TransferFunction};
use crate::vulkan::Device;

/// What was found for one form.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Verdict {
    Right,
    /// What differs from the rule.
    Wrong(String),
    /// The device lacks the feature.
    Missing(String),
}

/// What was found for the device.
#[derive(Clone, Debug)]
pub struct SelfCheck {
    pub forms: BTreeMap<Form, Verdict>,
    /// Why its count of shader invocations is not believed; none where it is.
    pub statistics: Option<String>,
}

impl SelfCheck {
    /// The form `auto` stands for [DESIGN 2.3]: what the papers did where the device does it right.
    pub fn automatic(&self, method: MethodName) -> Option<Form> {
        let papers = plan::papers_form(method)?;
        if method.distance().is_none() {
            return Some(papers);
        }
        let order = [papers, Form { cull: Cull::Bounds, mark: Mark::Copy }];
        let right = |form: &Form| self.forms.get(form) == Some(&Verdict::Right);
        Some(order.into_iter().find(right).unwrap_or(Form { cull: Cull::Ztest, mark: Mark::Copy }))
    }

    /// Form names and verdicts in words.
    pub fn words(&self) -> BTreeMap<String, String> {
        let word = |verdict: &Verdict| match verdict {
            Verdict::Right => "right".to_owned(),
            Verdict::Wrong(what) => format!("wrong: {what}"),
            Verdict::Missing(what) => format!("not available: {what}"),
        };
        self.forms.iter().map(|(form, verdict)| (form.name(), word(verdict))).collect()
    }
}

/// The forms of `nn-omni` as the device would run them.
fn forms() -> Vec<Form> {
    Form::all(MethodName::NnOmni)
}

/// Runs the check: a few views of a small built-in volume, every form.
///
/// # Errors
/// What the driver reports.
pub fn self_check(device: &Arc<Device>) -> Result<SelfCheck> {
    let scenes = [check_scene(20.0, 10.0, 1.9)?, check_scene(110.0, -35.0, 1.4)?];
    let mut found: BTreeMap<Form, Verdict> = BTreeMap::new();
    // The scenes differ in their view only.
    let mut resident = Resident::new(device);
    let mut statistics = (!device.info.pipeline_statistics).then(|| "the device has none".to_owned());
    for scene in &scenes {
        let rule = Rule::new(scene, device.info.sub_pixel_bits)?;
        for form in forms() {
            let verdict = found.entry(form).or_insert(Verdict::Right);
            if *verdict != Verdict::Right {
                continue;
            }
            if form.cull == Cull::Bounds && !device.info.depth_bounds {
                *verdict = Verdict::Missing("no depth bounds test".to_owned());
                continue;
            }
            let run = run_form(&mut resident, device, scene, form, &rule.structures)?;
            if let Some(difference) = rule.difference(&run) {
                *verdict = Verdict::Wrong(difference);
            } else if form.cull == Cull::Ztest && statistics.is_none() {
                statistics = run.invocations.as_ref().and_then(|i| doubt(i, &run.fragments));
            }
        }
    }
    Ok(SelfCheck { forms: found, statistics })
}

/// A small scene with empty space, seen through many main passes.
fn check_scene(azimuth: f64, elevation: f64, distance: f64) -> Result<Scene> {
    let mut settings = Settings::default();
    settings.image.size = [96, 96];
    settings.sampling.samples_per_pass = 2;
    settings.sampling.filter = Filter::Exact;
    let camera = Camera::orbit(azimuth, elevation, distance, settings.camera.fov_y);
    settings.camera.eye = camera.eye.to_array();
    let field = Field::new(builtin::volume("shells:24")?, None, NanPolicy::Replace)?;
    let transfer =
        TransferFunction::preset("ramp", 1.0).unwrap_or_else(|| TransferFunction::new("none", vec![], 1.0))?;
    Ok(Scene { settings, field: Arc::new(field), transfer, camera })
}

struct Run {
    picture: Vec<[f32; 4]>,
    fragments: Counts,
    invocations: Option<Counts>,
}

fn run_form(
    resident: &mut Resident,
    device: &Arc<Device>,
    scene: &Scene,
    form: Form,
    structures: &Structures,
) -> Result<Run> {
    let plan = plan::plan(scene, Some(form))?;
    resident.prepare(scene, &plan, structures)?;
    let mut frame = GpuFrame::new(device, scene, &plan, resident, None)?;
    let run = frame.run(Measure::Counts { statistics: true })?;
    Ok(Run { picture: frame.picture()?, fragments: run.fragments.unwrap_or_default(), invocations: run.invocations })
}

/// What every form has to give: the f64 twins' picture and counts.
struct Rule {
    frame: cpu::CpuFrame,
    structures: Structures,
}

impl Rule {
    fn new(scene: &Scene, sub_pixel_bits: u32) -> Result<Self> {
        let plan = plan::plan(scene, plan::papers_form(MethodName::NnOmni))?;
        let mut structures = Structures::default();
        structures.prepare(scene, &plan);
        Ok(Self { frame: cpu::run(scene, &plan, &structures, sub_pixel_bits), structures })
    }

    /// What a run has different from the rule, but for rays that f32 cannot decide.
    fn difference(&self, run: &Run) -> Option<String> {
        /// Largest difference of a channel that rounding of some hundred f32 samples explains.
        const PICTURE: f64 = 1e-4;
        let undecided = self.frame.undecided.iter().filter(|u| **u).count() as u64;
        let lists = [
            ("main", &self.frame.counts.main, &run.fragments.main),
            ("intermediate", &self.frame.counts.intermediate, &run.fragments.intermediate),
        ];
        for (name, rule, got) in lists {
            for (pass, (&rule, &got)) in rule.iter().zip(got).enumerate() {
                if rule.abs_diff(got) > undecided {
                    return Some(format!("{name} pass {pass} counts {got} fragments where the rule has {rule}"));
                }
            }
        }
        for (i, (rule, got)) in self.frame.pixels.iter().zip(&run.picture).enumerate() {
            let off = (0..4).any(|c| (rule[c] - f64::from(got[c])).abs() > PICTURE);
            if off && !self.frame.undecided[i] {
                return Some(format!("pixel {i} of the check picture is {got:?} where the rule has {rule:?}"));
            }
        }
        None
    }
}

/// A count of invocations is believed when early culled fragments are missing from it.
fn doubt(invocations: &Counts, fragments: &Counts) -> Option<String> {
    // Shaders run in groups of up to some dozen fragments; culled passes still run a good deal fewer than all.
    let (ran, passed): (u64, u64) = (invocations.main.iter().sum(), fragments.main.iter().sum());
    let box_fragments = fragments.intermediate.first().copied().unwrap_or(0) * fragments.main.len() as u64;
    if ran < passed {
        return Some(format!("{ran} invocations are counted for {passed} fragments"));
    }
    let midway = passed + (box_fragments.saturating_sub(passed)) / 2;
    (ran > midway).then(|| format!("{ran} invocations are counted where early tests leave {passed} fragments"))
}
