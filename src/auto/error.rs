//! `sampling.error`: the longest steps with which the picture of a scene is as near to the exact integral as it is asked to be, found by a
//! quick look: a small picture of the same view, drawn in f64 with one way of sampling after the other and held against the integral.

use std::time::Instant;

use serde::{Deserialize, Serialize};

use crate::error::{Error, Result};
use crate::frame::{Structures, cpu};
use crate::method::{self, CPU};
use crate::plan;
use crate::projection;
use crate::scene::Scene;
use crate::scene::settings::{Classification, Last, Offset, SamplingSettings};
use crate::truth::exact::ExactIntegrator;
use crate::truth::known;

/// A small picture: its pixels along the longer side, at the most, and how many times its largest error that of the picture is taken to be,
/// at the most. Large errors are rare, and where a few pixels have one a small picture may have none.
#[derive(Clone, Copy)]
struct Small {
    side: f64,
    safety: f64,
}

/// What steps are sought with, and what they are held against then.
const SEARCHED: Small = Small { side: 48.0, safety: 1.5 };
const CONFIRMED: Small = Small { side: 128.0, safety: 2.0 };

/// Steps that are tried, in voxels, the longest first.
const STEPS: [f64; 12] = [4.0, 3.0, 2.0, 1.5, 1.0, 0.75, 0.5, 0.35, 0.25, 0.18, 0.125, 0.0625];

/// No error falls faster than with the square of the step; by so much more it may.
const FASTER: f64 = 1.5;

/// The part of the error that rays may bring which end early.
const OF_ENDS: f64 = 0.25;

/// What meets an error.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ErrorChoice {
    /// The largest error that is asked for, of any channel.
    pub bound: f64,
    /// That of a small picture with what was chosen.
    pub found: f64,
    /// Its pixels.
    pub pixels: u32,
    /// What was chosen.
    pub step: f64,
    pub classification: Classification,
    pub offset: Offset,
    pub last: Last,
    pub termination: f64,
    /// What was tried, in that order.
    pub tried: Vec<Tried>,
    /// Time of all this, milliseconds.
    pub look_ms: f64,
}

/// The error of a small picture with a way of sampling.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Tried {
    pub classification: Classification,
    pub step: f64,
    pub largest: f64,
}

impl ErrorChoice {
    /// What was found, in words.
    pub fn words(&self) -> String {
        let Self { bound, found, pixels, step, classification, termination, .. } = self;
        let by = if *classification == Classification::Post { "post-classified" } else { "pre-integrated" };
        format!(
            "an error of at most {bound:.3e} is met by {by} samples {step} voxels apart with T = {termination}: of {pixels} pixels that \
             were looked at none is off by more than {found:.3e}"
        )
    }
}

/// The ways of sampling that meet the error of a scene, each with the record of how it was found: of each classification the longest steps.
/// What the scene has otherwise than by default stays as it is.
///
/// # Errors
/// When no exact integral of the scene is known, or no step that is tried meets the error.
pub fn meeting(scene: &Scene, bound: f64) -> Result<Vec<(SamplingSettings, ErrorChoice)>> {
    let begin = Instant::now();
    known::check(scene)?;
    let looks = Looks { search: SmallLook::of(scene, SEARCHED)?, confirm: SmallLook::of(scene, CONFIRMED)?, bound };
    let (mut found, mut tried, mut refused) = (Vec::new(), Vec::new(), None);
    for classification in classifications(scene) {
        // A sample that is pre-integrated takes no less time than another.
        let no_shorter = found.iter().map(|(sampling, _): &(SamplingSettings, f64)| sampling.step).fold(0.0, f64::max);
        let mut ways = steps(scene, classification, bound);
        ways.retain(|sampling| sampling.step >= no_shorter);
        found.extend(looks.longest(ways, &mut tried, &mut refused));
    }
    let least = tried.iter().map(|tried| tried.largest).fold(f64::INFINITY, f64::min);
    let record = |(sampling, largest): (SamplingSettings, f64)| {
        let record = ErrorChoice {
            bound,
            found: largest,
            pixels: looks.confirm.exact.len() as u32,
            step: sampling.step,
            classification: sampling.classification,
            offset: sampling.offset,
            last: sampling.last,
            termination: sampling.termination,
            tried: tried.clone(),
            look_ms: begin.elapsed().as_secs_f64() * 1e3,
        };
        (sampling, record)
    };
    let all: Vec<_> = found.into_iter().map(record).collect();
    if let Some(refused) = refused.filter(|_| tried.is_empty()) {
        return Err(refused);
    }
    if all.is_empty() {
        let shortest = tried.iter().map(|tried| tried.step).fold(f64::INFINITY, f64::min);
        return Err(Error::usage(
            format!("sampling.error (--error {bound})"),
            format!(
                "is met by no step that was tried, down to {shortest} voxels: the least error that was found is {least:.1e}"
            ),
            "ask for a larger error; surfaces and jumps of the transfer function are off by whole colours where a ray just misses them",
        ));
    }
    Ok(all)
}

/// What steps are sought with, and what they are held against.
struct Looks {
    search: SmallLook,
    confirm: SmallLook,
    bound: f64,
}

impl Looks {
    /// The first of some ways of sampling that meets the bound, and its error in a small picture; none where none does, or the scene cannot
    /// have them. Those that cannot meet it, by what the ones before them are off by, are left out.
    fn longest(
        &self,
        ways: Vec<SamplingSettings>,
        tried: &mut Vec<Tried>,
        refused: &mut Option<Error>,
    ) -> Option<(SamplingSettings, f64)> {
        let mut longest = f64::INFINITY;
        for sampling in ways {
            if sampling.step > longest {
                continue;
            }
            let mut largest = match self.search.largest(&sampling) {
                Ok(largest) => largest,
                Err(e) => {
                    refused.get_or_insert(e);
                    return None;
                }
            };
            let mut over = SEARCHED.safety * largest / self.bound;
            if over <= 1.0 {
                largest = self.confirm.largest(&sampling).ok()?;
                over = CONFIRMED.safety * largest / self.bound;
            }
            tried.push(Tried { classification: sampling.classification, step: sampling.step, largest });
            if over <= 1.0 {
                return Some((sampling, largest));
            }
            longest = FASTER * sampling.step / over.sqrt();
        }
        None
    }
}

/// A small picture of the view of a scene, and what it ought to be.
struct SmallLook {
    scene: Scene,
    exact: Vec<[f64; 4]>,
}

impl SmallLook {
    fn of(scene: &Scene, small: Small) -> Result<Self> {
        let mut scene = scene.clone();
        let [width, height] = scene.settings.image.size.map(f64::from);
        let scale = (small.side / width.max(height)).min(1.0);
        scene.settings.image.size = [width, height].map(|side| (side * scale).round().max(1.0) as u32);
        scene.settings.method.name = CPU.name();
        let rays = scene.camera.rays(scene.settings.image.size)?;
        let exact = ExactIntegrator::of(&scene).picture(&rays, scene.settings.image.size);
        Ok(Self { scene, exact })
    }

    /// The largest error with a way of sampling.
    fn largest(&self, sampling: &SamplingSettings) -> Result<f64> {
        let mut scene = self.scene.clone();
        scene.settings.sampling = sampling.clone();
        plan::check(&scene)?;
        let plan = plan::plan(&scene, None)?;
        let drawn = cpu::run(&scene, &plan, &Structures::default(), cpu::SUB_PIXEL_BITS);
        let off = |(a, b): (&[f64; 4], &[f64; 4])| (0..4).map(|c| (a[c] - b[c]).abs()).fold(0.0, f64::max);
        Ok(drawn.pixels.iter().zip(&self.exact).map(off).fold(0.0, f64::max))
    }
}

/// The classifications that are tried.
fn classifications(scene: &Scene) -> Vec<Classification> {
    match (scene.settings.sampling.classification, projection::of(&scene.settings).shows_values()) {
        (Classification::Post, false) => vec![Classification::Post, Classification::PreIntegrated],
        (asked, _) => vec![asked],
    }
}

/// Ways of sampling of a classification, the longest steps first.
fn steps(scene: &Scene, classification: Classification, bound: f64) -> Vec<SamplingSettings> {
    let (asked, default) = (&scene.settings.sampling, SamplingSettings::default());
    let all: Vec<f64> = if asked.step == default.step { STEPS.to_vec() } else { vec![asked.step] };
    // Slices have no parts of steps.
    let on_slices = method::find(scene.settings.method.name).is_some_and(|method| method.stack().is_some());
    let of_step = |step: f64| {
        // What is chosen is written down as if it had been asked for, and drawn again as it is.
        let mut sampling = SamplingSettings { step, classification, error: None, ..asked.clone() };
        // A sample in the middle of its step is of the second order, and the last one stands for what there is.
        if asked.offset == default.offset && classification == Classification::Post && scene.surface.is_none() {
            sampling.offset = Offset::Midpoint;
        }
        if asked.last == default.last && !on_slices {
            sampling.last = Last::Partial;
        }
        if asked.termination == default.termination {
            sampling.termination = 1.0 - OF_ENDS * bound.min(1.0);
        }
        sampling
    };
    all.into_iter().map(of_step).collect()
}
