//! Which forms of culling are right on this very device. First what the form is made of is held against the probe's rule,
//! fragment by fragment ([`crate::probe`]); then a small frame is run in it, and counts and picture are held against the
//! f64 twins. Drivers get the depth bounds test wrong; a wrong one is named and never trusted.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::cpu::{self, Counts};
use super::gpu::GpuFrame;
use super::queries::Measure;
use super::resident::Resident;
use super::structures::Structures;
use super::texture_unit;
use crate::error::Result;
use crate::glsl;
use crate::method;
use crate::part::form::Form;
use crate::part::rows::Method;
use crate::plan::{self, Choice};
use crate::probe::correct::{Depth, faults};
use crate::probe::decide::Culling;
use crate::probe::known;
use crate::probe::run::missing;
use crate::probe::{Case, CaseShader, Compare, Mechanism, Rig, measure, pipelines};
use crate::scene::builtin;
use crate::scene::field::{Field, NanPolicy};
use crate::scene::settings::{Cull, Filter, Mark, MethodName, Settings};
use crate::scene::{Camera, Scene, TextureUnit, TransferFunction};
use crate::vulkan::{Device, vk};

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
    /// How precisely its texture unit interpolates.
    pub unit: TextureUnit,
}

impl SelfCheck {
    /// The form `auto` stands for [DESIGN 2.3]: what the papers did where the device does it right.
    pub fn automatic(&self, method: MethodName) -> Option<Form> {
        let papers = method::papers_form(method)?;
        if !method::find(method).is_some_and(Method::marks_sections) {
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
    method::forms(method::NN_OMNI.name())
}

/// Pixels of a side of the picture that is probed.
const PROBED: u32 = 64;

/// What the passes of a form that test only ask of the device.
fn tested(form: Form) -> Case {
    let (mechanism, shader) = match form.cull {
        Cull::Bounds | Cull::Auto => (Mechanism::BoundsRead, CaseShader::Early),
        Cull::Ztest => (Mechanism::DepthRead, CaseShader::Early),
        Cull::Discard => (Mechanism::Alive, CaseShader::Plain),
    };
    Case { mechanism, shader, compare: Compare::GreaterOrEqual }
}

/// Why fragments that a form culls are shaded all the same, by a probe of the device that was made before; none where they are not, or
/// nobody knows.
pub fn culls_late(device: &Device, form: Form) -> Option<String> {
    let probe = known::of(&device.info)?;
    let line = probe.lines.iter().find(|line| line.case == tested(form))?;
    let late = line.culling() == Some(Culling::Late);
    late.then(|| format!("the probe of {} found {} to cull late", probe.provenance.date, form.name()))
}

/// What the passes of a form ask of the device: of those that test only, and of those that mark.
fn cases(form: Form) -> Vec<Case> {
    let case = |mechanism, shader| Case { mechanism, shader, compare: Compare::GreaterOrEqual };
    let tested = tested(form);
    match form.mark {
        Mark::Fragdepth | Mark::Auto => vec![tested, case(Mechanism::BoundsCompare, CaseShader::DepthLess)],
        Mark::FragdepthAny => vec![tested, case(Mechanism::BoundsCompare, CaseShader::DepthAny)],
        Mark::Copy => vec![tested],
    }
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
    compile(device, &scenes[0], &resident)?;
    let mut rig = Rig::new(device, vk::Format::D32_SFLOAT, PROBED)?;
    let statistics = measure::statistics(&mut rig)?;
    for form in forms() {
        let cases = cases(form);
        let verdict = match cases.iter().find_map(|case| missing(device, case)) {
            Some(what) => Verdict::Missing(what),
            None => {
                let mut wrong = None;
                for case in &cases {
                    let first = faults(&mut rig, case, Depth::Quick)?.into_iter().next();
                    wrong = wrong.or(first.map(|fault| fault.line(case)));
                }
                wrong.map_or(Verdict::Right, Verdict::Wrong)
            }
        };
        found.insert(form, verdict);
    }
    for scene in &scenes {
        let rule = TwinRule::new(scene, device.info.sub_pixel_bits)?;
        for form in forms() {
            let verdict = found.entry(form).or_insert(Verdict::Right);
            if *verdict != Verdict::Right {
                continue;
            }
            let run = run_form(&mut resident, device, scene, form)?;
            if let Some(difference) = rule.difference(&run) {
                *verdict = Verdict::Wrong(difference);
            }
        }
    }
    let unit = texture_unit::measure(device, &mut resident.pipelines)?;
    Ok(SelfCheck { forms: found, statistics, unit })
}

/// Compiles what the check draws with, side by side: for the forms whose features the device has, in a scene of it.
fn compile(device: &Device, scene: &Scene, resident: &Resident) -> Result<()> {
    let possible = |form: &Form| cases(*form).iter().all(|case| missing(device, case).is_none());
    let forms: Vec<Form> = forms().into_iter().filter(possible).collect();
    let asked: Vec<Case> = forms.iter().flat_map(|form| cases(*form)).collect();
    glsl::prepare(pipelines::shaders(&asked).iter().chain([&texture_unit::shader()]))?;
    let plans = forms.iter().map(|form| plan::plan(scene, Some(*form))).collect::<Result<Vec<_>>>()?;
    resident.pipelines.prepare(plans.iter().flat_map(|plan| plan.frame()))
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
    Ok(Scene::of_volume(settings, Arc::new(field), transfer))
}

struct FormRun {
    picture: Vec<[f32; 4]>,
    fragments: Counts,
}

/// A frame in that form; the host builds what it looks up, since builds are not what is checked.
fn run_form(resident: &mut Resident, device: &Arc<Device>, scene: &Scene, form: Form) -> Result<FormRun> {
    let plan = plan::plan_for(scene, Choice { form: Some(form), on_host: true, ..Choice::default() })?;
    resident.prepare(scene, &plan)?;
    let mut frame = GpuFrame::new(device, scene, &plan, resident, None)?;
    let run = frame.run(Measure::Counts { statistics: false })?;
    Ok(FormRun { picture: frame.picture()?, fragments: run.fragments.unwrap_or_default() })
}

/// What every form has to give: the f64 twins' picture and counts.
struct TwinRule {
    frame: cpu::CpuFrame,
}

impl TwinRule {
    fn new(scene: &Scene, sub_pixel_bits: u32) -> Result<Self> {
        let plan = plan::plan(scene, method::papers_form(method::NN_OMNI.name()))?;
        let mut structures = Structures::default();
        structures.prepare(scene, &plan);
        Ok(Self { frame: cpu::run(scene, &plan, &structures, sub_pixel_bits) })
    }

    /// What a run has different from the rule, but for rays that f32 cannot decide.
    fn difference(&self, run: &FormRun) -> Option<String> {
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
