//! Pictures of a case against what it must give.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

use serde::{Deserialize, Serialize};

use super::case::{Expect, StabilityCase, beer};
use crate::error::Result;
use crate::frame::{CpuFrame, Structures, cpu};
use crate::method;
use crate::plan;
use crate::scene::settings::MethodName;
use crate::scene::{Field, Scene};
use crate::truth::exact::ExactIntegrator;

/// A picture, with what is known of how it came.
#[derive(Clone, Debug, Default)]
pub struct Rendered {
    /// Premultiplied RGBA, row 0 on top.
    pub pixels: Vec<[f64; 4]>,
    /// Steps of the frame.
    pub steps: usize,
}

/// Whatever makes pictures of scenes.
pub trait Integrator {
    /// Another case begins.
    fn begin(&mut self) {}

    /// Bits of its raster, see [`cpu::run`].
    fn sub_pixel_bits(&self) -> u32;

    /// The picture of a scene by its method; none where it lacks what the scene asks for, with the reason.
    ///
    /// # Errors
    /// When the scene is refused.
    fn render(&mut self, scene: &Scene) -> Result<std::result::Result<Rendered, String>>;
}

/// What is to be said of a case by one method.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum StabilityVerdict {
    Right,
    Wrong,
    /// Not run, since the device lacks something.
    Missing,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Outcome {
    pub method: String,
    pub verdict: StabilityVerdict,
    /// The largest difference from what is expected, as a share of what is allowed; null where nothing was compared.
    pub share: Option<f64>,
    /// The largest difference itself.
    pub off: Option<f64>,
    /// Pixels left out: f32, or the rasteriser, may decide them either way.
    pub undecided: u64,
    /// What is wrong, or missing.
    pub remark: Option<String>,
}

/// What a picture is compared with.
struct ExpectedPicture {
    pixels: Vec<[f64; 4]>,
    undecided: Vec<bool>,
    /// How far f32 may be from each pixel besides.
    rounding: Vec<f64>,
}

/// Every one of `methods` on one case. Rays that end early give one picture, bit for bit, whatever is skipped.
///
/// # Errors
/// When there is no rule for the case; what is wrong with a picture is an outcome.
pub fn judge(case: &StabilityCase, methods: &[MethodName], integrator: &mut dyn Integrator) -> Result<Vec<Outcome>> {
    let scene = case.scene();
    let wanted = |method: &&MethodName| case.is_for(**method, scene.as_ref().ok());
    integrator.begin();
    let mut outcomes = Vec::new();
    // By the method with the same samples that skips nothing.
    let mut law: BTreeMap<&str, (MethodName, Vec<[f64; 4]>)> = BTreeMap::new();
    let mut rules: BTreeMap<&str, ExpectedPicture> = BTreeMap::new();
    for &method in methods.iter().filter(wanted) {
        let blank = Outcome {
            method: method.name().to_owned(),
            verdict: StabilityVerdict::Right,
            share: None,
            off: None,
            undecided: 0,
            remark: None,
        };
        let wrong =
            |remark: String| Outcome { verdict: StabilityVerdict::Wrong, remark: Some(remark), ..blank.clone() };
        let rendered = match &scene {
            Ok(scene) => {
                let mut scene = scene.clone();
                scene.settings.method.name = method;
                integrator.render(&scene)
            }
            Err(error) => Err(crate::error::Error::usage("scene", error.to_string(), "")),
        };
        outcomes.push(match (&case.expect, rendered) {
            (Expect::Refused(part), Err(error)) => match error.to_string() {
                text if text.contains(part) => blank.clone(),
                text => wrong(format!("is refused for another reason: {text}")),
            },
            (Expect::Refused(_), Ok(Ok(_))) => wrong("is not refused".to_owned()),
            (_, Err(error)) => wrong(format!("is refused: {error}")),
            (_, Ok(Err(missing))) => {
                Outcome { verdict: StabilityVerdict::Missing, remark: Some(missing), ..blank.clone() }
            }
            (expect, Ok(Ok(rendered))) => {
                let Ok(scene) = &scene else { continue };
                let samples = method::of(method)?.unskipped().name;
                let rule = match rules.entry(samples) {
                    Entry::Occupied(made) => made.into_mut(),
                    Entry::Vacant(place) => {
                        place.insert(rule(case, expect, scene, method, integrator.sub_pixel_bits())?)
                    }
                };
                let mut outcome = compared(case, &rendered, rule, blank.clone());
                // In f64 it is the same to rounding only.
                if method::of(method)?.under_the_law() && outcome.verdict == StabilityVerdict::Right {
                    let (first, pixels) = law.entry(samples).or_insert_with(|| (method, rendered.pixels.clone()));
                    let bits = |pixels: &[[f64; 4]]| pixels.iter().map(|p| p.map(f64::to_bits)).collect::<Vec<_>>();
                    if bits(pixels) != bits(&rendered.pixels) {
                        outcome.verdict = StabilityVerdict::Wrong;
                        outcome.remark =
                            Some(format!("skipping changes the picture: it is not that of {}", first.name()));
                    }
                }
                outcome
            }
        });
    }
    Ok(outcomes)
}

fn compared(case: &StabilityCase, rendered: &Rendered, rule: &ExpectedPicture, blank: Outcome) -> Outcome {
    let wrong = |remark: String| Outcome { verdict: StabilityVerdict::Wrong, remark: Some(remark), ..blank.clone() };
    if let Some(i) = rendered.pixels.iter().position(|p| p.iter().any(|c| !c.is_finite())) {
        return wrong(format!("pixel {i} is {:?}", rendered.pixels[i]));
    }
    if rendered.pixels.len() != rule.pixels.len() {
        return wrong(format!("has {} pixels of {}", rendered.pixels.len(), rule.pixels.len()));
    }
    if matches!(case.expect, Expect::Nothing) && rendered.steps > 0 {
        return wrong(format!("runs {} passes for nothing", rendered.steps));
    }
    let (mut share, mut off, mut worst) = (0.0f64, 0.0f64, 0);
    for (i, (found, expected)) in rendered.pixels.iter().zip(&rule.pixels).enumerate() {
        if rule.undecided[i] {
            continue;
        }
        for c in 0..4 {
            let difference = (found[c] - expected[c]).abs();
            let allowed = case.tolerance.absolute + case.tolerance.relative * expected[c].abs() + rule.rounding[i];
            if difference / allowed > share {
                (share, worst) = (difference / allowed, i);
            }
            off = off.max(difference);
        }
    }
    let undecided = rule.undecided.iter().filter(|u| **u).count() as u64;
    let outcome = Outcome { share: Some(share), off: Some(off), undecided, ..blank };
    if share <= 1.0 {
        return outcome;
    }
    let (found, expected) = (rendered.pixels[worst], rule.pixels[worst]);
    let remark = format!("pixel {worst} is {found:?}, and {expected:?} is expected");
    Outcome { verdict: StabilityVerdict::Wrong, remark: Some(remark), ..outcome }
}

/// What a method that ends rays early, or one that does not, has to give.
fn rule(
    case: &StabilityCase,
    expect: &Expect,
    scene: &Scene,
    method: MethodName,
    sub_pixel_bits: u32,
) -> Result<ExpectedPicture> {
    let twin = twin(scene, method, sub_pixel_bits)?;
    let [width, height] = scene.settings.image.size;
    let each = |value: &dyn Fn([u32; 2]) -> [f64; 4]| -> Vec<[f64; 4]> {
        (0..height).flat_map(|row| (0..width).map(move |column| [column, row])).map(value).collect()
    };
    let pixels = match expect {
        Expect::Beer { color, opacity, steps } => each(&|pixel| beer(scene, pixel, *color, *opacity, *steps)),
        Expect::Constant(value) => {
            let covered = each(&|pixel| beer(scene, pixel, [0.0; 3], 0.5, None));
            covered.iter().map(|ray| if ray[3] > 0.0 { *value } else { [0.0; 4] }).collect()
        }
        Expect::Exact => {
            let rays = scene.camera.rays(scene.settings.image.size)?;
            ExactIntegrator::of(scene).picture(&rays, scene.settings.image.size)
        }
        Expect::Sum | Expect::Refused(_) => twin.pixels,
        Expect::Nothing => each(&|_| [0.0; 4]),
        Expect::SumOf(volume) => {
            let mut other = scene.clone();
            let field = Field::of(volume.clone(), &case.settings.volume.normalisation())?;
            other.field = std::sync::Arc::new(field);
            self::twin(&other, method, sub_pixel_bits)?.pixels
        }
    };
    Ok(ExpectedPicture { pixels, undecided: twin.undecided, rounding: twin.rounding })
}

/// The same samples in f64.
fn twin(scene: &Scene, method: MethodName, sub_pixel_bits: u32) -> Result<CpuFrame> {
    let mut scene = scene.clone();
    let rule = method::of(method)?.unskipped();
    scene.settings.method.name = rule.name();
    let plan = plan::plan(&scene, method::papers_form(scene.settings.method.name))?;
    Ok(cpu::run(&scene, &plan, &Structures::default(), sub_pixel_bits))
}
