//! `accuracy.json`: curves of error and time by the step.

use serde::{Deserialize, Serialize};

use crate::measure::record::Clock;
use crate::measure::timing::Timing;
use crate::provenance::Provenance;
use crate::scene::Settings;

/// The version of the format written here.
pub const FORMAT: u32 = 1;

/// `accuracy.json`. Errors are of premultiplied linear RGBA against the emission-absorption integral in f64; of iso-surfaces,
/// against the roots of the interpolant and its gradient there.
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
    /// The exact integral as a PNG file, seen from this one.
    #[serde(default)]
    pub picture: Option<String>,
}

/// A method with one way of sampling, by its steps or their tolerance, shells by their number, or ways through cells by their tables.
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
    /// The orders of a surface's errors; absent where there is no surface, or where nothing is known of it alone.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub surface: Option<SurfaceOrders>,
}

/// Orders in the step of the errors of [`SurfaceError`]; null where an error does not fall with the step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SurfaceOrders {
    pub position: Option<Fit>,
    pub normal: Option<Fit>,
    pub color: Option<Fit>,
    /// The order of places that theory gives; null where nothing but rounding is left of their error.
    pub expected_position: Option<f64>,
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Fit {
    pub order: f64,
    /// The longest and the shortest step, voxels.
    pub steps: [f64; 2],
    pub points: usize,
}

/// A picture of one step, of so many shells, or of a table.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// Voxels of the finest spacing; of shells the part of the scalar range from level to level, the inverse of their number; of
    /// tables the part of their axes from node to node; of adaptive steps the shortest there may be; where ways through cells are integrated
    /// exactly, nothing.
    pub step: f64,
    /// M, so that a pass goes about as far along a ray whatever the step; 0 of shells.
    pub samples_per_pass: u32,
    /// The number of shells; absent where samples are taken.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shells: Option<u32>,
    /// Nodes along a side of the table of ways through cells; absent where there is none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub table: Option<u32>,
    /// The error that adaptive steps are made for; absent where steps are all alike.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tolerance: Option<f64>,
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
    /// Samples that the main fragments take, those beyond the end of a ray included; of shells the fragments.
    pub samples: u64,
    /// No other picture is both faster and nearer to the truth.
    pub pareto: bool,
    /// Of a surface; absent where there is none, or where nothing is known of it alone.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub surface: Option<SurfaceError>,
}

/// How far an iso-surface is from the exact one: root mean squares over the pixels in which both rays meet the same sheet of it, null
/// where there are none.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SurfaceError {
    /// Distance of the places, volume units.
    pub position: Option<f64>,
    /// Angle between the lines that the normals lie on, radians; where the exact surface has a normal.
    pub normal: Option<f64>,
    /// Difference of a channel of the colours, premultiplied and linear.
    pub color: Option<f64>,
    /// Pixels in which one of the two rays meets the surface alone, or another sheet of it: places are more than a step apart.
    pub missed: u64,
    /// Pixels in which one of the two rays meets the surface, or both do.
    pub pixels: u64,
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
