//! `sampling.error`: the longest steps with which the picture of a scene is as near to the exact integral as it is asked to be, found by a
//! quick look: a small picture of the same view, drawn in f64 with one way of sampling after the other and held against the integral.
//! Where the norm is a mean, rays may end the sooner the shorter steps are, and which of both is the cheaper is weighed later.

use std::time::Instant;

use serde::{Deserialize, Serialize};

use super::small::{CONFIRMED, SEARCHED, SmallLook};
use crate::error::{Error, Result};
use crate::method;
use crate::projection;
use crate::scene::Scene;
use crate::scene::settings::{Classification, ErrorNorm, Last, Offset, SamplingSettings};
use crate::truth::known;

/// Steps that are tried, in voxels, the longest first.
const STEPS: [f64; 18] =
    [4.0, 3.0, 2.5, 2.0, 1.75, 1.5, 1.25, 1.0, 0.85, 0.7, 0.6, 0.5, 0.42, 0.35, 0.25, 0.18, 0.125, 0.0625];

/// No error falls faster than with the square of the step; by so much more it may.
const FASTER: f64 = 1.5;

/// How many times the error of the larger small picture may be that of the smaller one: what is more is something that the latter has not seen.
const LARGER: f64 = 4.0;

/// The part of what one step was missed by that the next one is taken to be missed by: it is a matter of chance.
const HOPE: f64 = 0.7;

/// The part of the largest error that rays may bring which end early.
const OF_ENDS: f64 = 0.25;

/// Of a mean error, how many times of it the rays may miss which end early, the fewest first: most pixels have none such.
const OF_ENDS_IN_THE_MEAN: [f64; 4] = [0.25, 1.0, 2.0, 4.0];

/// Rays end no earlier than by default, whatever error is allowed.
const EARLIEST: f64 = 0.95;

/// What meets an error.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ErrorChoice {
    /// The error that is asked for, and what it is.
    pub bound: f64,
    #[serde(default)]
    pub norm: ErrorNorm,
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
    pub termination: f64,
    /// By the norm that was asked for.
    pub error: f64,
}

impl ErrorChoice {
    /// What was found, in words.
    pub fn words(&self) -> String {
        let Self { bound, norm, found, pixels, step, classification, termination, .. } = self;
        let by = if *classification == Classification::Post { "post-classified" } else { "pre-integrated" };
        let looked = match norm {
            ErrorNorm::Largest => {
                format!("of {pixels} pixels that were looked at none is off by more than {found:.3e}")
            }
            ErrorNorm::Rmse => format!("the rmse of {pixels} pixels that were looked at is {found:.3e}"),
        };
        format!(
            "an error of at most {bound:.3e} is met by {by} samples {step} voxels apart with T = {termination}: {looked}"
        )
    }
}

/// The ways of sampling that meet the error of a scene, each with the record of how it was found: the longest steps of each classification
/// and each T, but for those of which another has steps as long and ends rays as early. What the scene has otherwise than by default stays
/// as it is.
///
/// # Errors
/// When no exact integral of the scene is known, or no step that is tried meets the error.
pub fn meeting(scene: &Scene, bound: f64) -> Result<Vec<(SamplingSettings, ErrorChoice)>> {
    let begin = Instant::now();
    known::check(scene)?;
    let norm = scene.settings.sampling.error_norm;
    let [search, confirm] = SmallLook::both(scene)?;
    let mut looks = Looks { search, confirm, bound, norm, tried: Vec::new(), refused: None };
    let mut found: Vec<(SamplingSettings, f64)> = Vec::new();
    for classification in classifications(scene) {
        // A sample that is pre-integrated takes no less time than another.
        let no_shorter = found.iter().map(|(sampling, _)| sampling.step).fold(0.0, f64::max);
        let mut longest = f64::INFINITY;
        for termination in terminations(scene, bound) {
            let mut ways = steps(scene, classification, termination);
            ways.retain(|sampling| sampling.step >= no_shorter && sampling.step <= longest);
            let Some(way) = looks.longest(ways) else { break };
            longest = way.0.step;
            // Rays that end earlier take no more samples of the same step.
            found.retain(|(before, _)| before.classification != classification || before.step > longest);
            found.push(way);
        }
    }
    if found.is_empty() {
        return Err(looks.unmet());
    }
    let Looks { confirm, tried, .. } = looks;
    let record = |(sampling, found): (SamplingSettings, f64)| {
        let record = ErrorChoice {
            bound,
            norm,
            found,
            pixels: confirm.exact.len() as u32,
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
    Ok(found.into_iter().map(record).collect())
}

/// What steps are sought with, and what they are held against.
struct Looks {
    search: SmallLook,
    confirm: SmallLook,
    bound: f64,
    norm: ErrorNorm,
    tried: Vec<Tried>,
    /// Why the first way was refused that the scene cannot have.
    refused: Option<Error>,
}

impl Looks {
    /// The first of some ways of sampling that meets the bound, and its error in a small picture; none where none does, or the scene cannot
    /// have them. Those that cannot meet it, by what the ones before them are off by, are left out.
    fn longest(&mut self, ways: Vec<SamplingSettings>) -> Option<(SamplingSettings, f64)> {
        let mut longest = f64::INFINITY;
        // How many times the error of the picture that is sought with that of the one it is held against has been, where that missed the bound.
        let mut larger = 0.0f64;
        for sampling in ways {
            if sampling.step > longest {
                continue;
            }
            let mut error = match self.search.error(&sampling, self.norm) {
                Ok(error) => error,
                Err(e) => {
                    self.refused.get_or_insert(e);
                    return None;
                }
            };
            let safety = SEARCHED.safety(self.norm).max(HOPE * larger * CONFIRMED.safety(self.norm));
            let mut over = safety * error / self.bound;
            if over <= 1.0 {
                let found = self.confirm.error(&sampling, self.norm).ok()?;
                over = CONFIRMED.safety(self.norm) * found / self.bound;
                if over > 1.0 {
                    larger = larger.max(found / error.max(f64::MIN_POSITIVE)).min(LARGER);
                }
                error = found;
            }
            let SamplingSettings { classification, step, termination, .. } = sampling;
            self.tried.push(Tried { classification, step, termination, error });
            if over <= 1.0 {
                return Some((sampling, error));
            }
            longest = FASTER * step / over.sqrt();
        }
        None
    }

    /// Why nothing that was tried will do.
    fn unmet(self) -> Error {
        if let Some(refused) = self.refused.filter(|_| self.tried.is_empty()) {
            return refused;
        }
        let least = self.tried.iter().map(|tried| tried.error).fold(f64::INFINITY, f64::min);
        let shortest = self.tried.iter().map(|tried| tried.step).fold(f64::INFINITY, f64::min);
        Error::usage(
            format!("sampling.error (--error {})", self.bound),
            format!(
                "is met by no step that was tried, down to {shortest} voxels: the least error that was found is {least:.1e}"
            ),
            "ask for a larger error; surfaces and jumps of the transfer function are off by whole colours where a ray just misses them",
        )
    }
}

/// The classifications that are tried.
fn classifications(scene: &Scene) -> Vec<Classification> {
    match (scene.settings.sampling.classification, projection::of(&scene.settings).shows_values()) {
        (Classification::Post, false) => vec![Classification::Post, Classification::PreIntegrated],
        (asked, _) => vec![asked],
    }
}

/// Opacities at which rays end that are tried, the greatest first.
fn terminations(scene: &Scene, bound: f64) -> Vec<f64> {
    let (asked, default) = (&scene.settings.sampling, SamplingSettings::default());
    let missed: &[f64] = match asked.error_norm {
        ErrorNorm::Largest => &[OF_ENDS],
        ErrorNorm::Rmse => &OF_ENDS_IN_THE_MEAN,
    };
    let mut all: Vec<f64> = match asked.termination == default.termination {
        true => missed.iter().map(|part| (1.0 - part * bound).max(EARLIEST)).collect(),
        false => vec![asked.termination],
    };
    all.dedup();
    all
}

/// Ways of sampling of a classification that end rays at an opacity, the longest steps first.
fn steps(scene: &Scene, classification: Classification, termination: f64) -> Vec<SamplingSettings> {
    let (asked, default) = (&scene.settings.sampling, SamplingSettings::default());
    let all: Vec<f64> = if asked.step == default.step { STEPS.to_vec() } else { vec![asked.step] };
    // Slices have no parts of steps.
    let on_slices = method::find(scene.settings.method.name).is_some_and(|method| method.stack().is_some());
    let of_step = |step: f64| {
        // What is chosen is written down as if it had been asked for, and drawn again as it is.
        let mut sampling = SamplingSettings { step, classification, termination, error: None, ..asked.clone() };
        // A sample in the middle of its step is of the second order, and the last one stands for what there is.
        if asked.offset == default.offset && classification == Classification::Post && scene.surface.is_none() {
            sampling.offset = Offset::Midpoint;
        }
        if asked.last == default.last && !on_slices {
            sampling.last = Last::Partial;
        }
        sampling
    };
    all.into_iter().map(of_step).collect()
}
