//! Error against run time: pictures of many steps, held against the exact integral, and how fast their error falls.

mod explain;
mod page;
mod plot;
mod text;

use serde::{Deserialize, Serialize};

use super::record::Clock;
use super::timing::Timing;
use crate::provenance::Provenance;
use crate::scene::Settings;

pub use explain::{expected_order, remarks};
pub use page::page;
pub use plot::{step_svg, time_svg};
pub use text::{csv, text};

/// The version of the format written here.
pub const FORMAT: u32 = 1;

/// `accuracy.json`. Errors are of premultiplied linear RGBA against the emission-absorption integral in f64.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Accuracy {
    #[serde(flatten)]
    pub provenance: Provenance,
    pub scene: String,
    pub view: String,
    pub device: String,
    pub driver: String,
    /// What times are taken with; null where nothing was timed.
    pub clock: Option<Clock>,
    pub curves: Vec<Curve>,
    /// What holds for every curve.
    pub remarks: Vec<String>,
    /// Of the scene, as a scene file has them; each curve says what it changes.
    pub settings: Settings,
}

/// A method with one way of sampling, by its steps.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Curve {
    pub method: String,
    /// What differs from the scene: `midpoint, partial`; empty for nothing.
    pub variation: String,
    pub settings: Settings,
    pub points: Vec<Point>,
    /// Order in the step of the root mean squared error, and the steps it was fitted over; null where too few points
    /// are above what does not fall with the step.
    pub order: Option<Fit>,
    /// The order that theory gives; null where it gives none.
    pub expected: Option<f64>,
    /// Why the two may differ.
    pub remarks: Vec<String>,
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Fit {
    pub order: f64,
    /// The longest and the shortest step, voxels.
    pub steps: [f64; 2],
    pub points: usize,
}

/// A picture of one step.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// Voxels of the finest spacing.
    pub step: f64,
    /// M, so that a pass goes about as far along a ray whatever the step.
    pub samples_per_pass: u32,
    /// Largest and root mean squared difference of a channel; null where it is not finite.
    pub max: Option<f64>,
    pub rmse: Option<f64>,
    /// Decibel against a peak of 1.
    pub psnr: Option<f64>,
    /// Structural similarity of the pictures as 8-bit grey over the background, 1 where they are equal.
    pub ssim: Option<f64>,
    /// Milliseconds of a frame: median, least, most, median absolute deviation, and how many were timed.
    pub ms: Option<[f64; 4]>,
    pub timed: usize,
    /// Samples that the main fragments take, those beyond the end of a ray included.
    pub samples: u64,
    /// No other picture is both faster and nearer to the truth.
    pub pareto: bool,
}

impl Point {
    pub fn time(&self) -> Option<f64> {
        self.ms.map(|ms| ms[0])
    }

    pub fn times(timing: Option<&Timing>) -> (Option<[f64; 4]>, usize) {
        let Some(timing) = timing else { return (None, 0) };
        let [least, most] = timing.range();
        (Some([timing.value, least, most, timing.stats.map_or(0.0, |s| s.mad)]), timing.stats.map_or(1, |s| s.n))
    }
}

impl Curve {
    pub fn name(&self) -> String {
        if self.variation.is_empty() { self.method.clone() } else { format!("{}, {}", self.method, self.variation) }
    }
}

/// Where half the step takes less than this order from the error, it has come down to what does not fall with the step:
/// rounding, the texture unit, rays that end early.
const STALLED: f64 = 0.4;

/// Longer steps than this do not meet a cell each.
const LONGEST: f64 = 2.0;

/// The order in the step: the slope of a line through log error over log step, by least squares, from the longest step
/// down to where the error stalls. `points` are steps and errors.
pub fn fit(points: &[(f64, f64)]) -> Option<Fit> {
    let mut sorted: Vec<(f64, f64)> = points
        .iter()
        .filter(|(step, error)| *step > 0.0 && *step <= LONGEST && error.is_finite() && *error > 0.0)
        .map(|(step, error)| (step.ln(), error.ln()))
        .collect();
    sorted.sort_by(|a, b| b.0.total_cmp(&a.0));
    let falls = |pair: &[(f64, f64)]| (pair[0].1 - pair[1].1) >= STALLED * (pair[0].0 - pair[1].0);
    let used = &sorted[..sorted.windows(2).position(|pair| !falls(pair)).map_or(sorted.len(), |at| at + 1)];
    if used.len() < 3 {
        return None;
    }
    let n = used.len() as f64;
    let mean = |of: &dyn Fn(&(f64, f64)) -> f64| used.iter().map(of).sum::<f64>() / n;
    let (x, y) = (mean(&|p| p.0), mean(&|p| p.1));
    let (xy, xx) = (mean(&|p| (p.0 - x) * (p.1 - y)), mean(&|p| (p.0 - x).powi(2)));
    let steps = [used[0].0.exp(), used[used.len() - 1].0.exp()];
    (xx > 0.0).then(|| Fit { order: xy / xx, steps, points: used.len() })
}

/// Marks the points that no other one beats in both time and error.
pub fn mark_pareto(curves: &mut [Curve]) {
    let all: Vec<(f64, f64)> = curves.iter().flat_map(|c| &c.points).filter_map(|p| p.time().zip(p.rmse)).collect();
    for point in curves.iter_mut().flat_map(|c| &mut c.points) {
        let Some((ms, rmse)) = point.time().zip(point.rmse) else { continue };
        point.pareto = !all.iter().any(|(t, e)| (*t < ms && *e <= rmse) || (*t <= ms && *e < rmse));
    }
}

/// The fastest picture whose largest error is at most that.
pub fn fastest(curves: &[Curve], error: f64) -> Option<(&Curve, &Point)> {
    let all = curves.iter().flat_map(|curve| curve.points.iter().map(move |point| (curve, point)));
    let good = all.filter(|(_, point)| point.max.is_some_and(|max| max <= error) && point.ms.is_some());
    good.min_by(|a, b| a.1.time().unwrap_or(f64::INFINITY).total_cmp(&b.1.time().unwrap_or(f64::INFINITY)))
}

/// What is asked in one line each: 1/255, which no 8-bit picture shows, and 1/1000.
pub fn answers(curves: &[Curve]) -> Vec<String> {
    [("1/255", 1.0 / 255.0), ("1/1000", 1e-3)]
        .into_iter()
        .map(|(name, error)| match fastest(curves, error) {
            Some((curve, point)) => format!(
                "For an error of at most {name}, {} at a step of {} voxels is the fastest: {:.2} ms, largest error {:.1e}.",
                curve.name(),
                point.step,
                point.time().unwrap_or_default(),
                point.max.unwrap_or_default()
            ),
            None => format!("No run comes within an error of {name}."),
        })
        .collect()
}
