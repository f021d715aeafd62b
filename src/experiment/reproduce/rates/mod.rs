//! Frame rates that the papers publish: [`RATE_TABLES`] is the one list of their tables.
//!
//! To add a table: a file here with its row, and a line in [`RATE_TABLES`].

mod csv;
mod heidrich;
mod kw03;
mod rows;
mod run;
mod stegmaier;
mod tables;

use std::path::PathBuf;

use crate::part::rows::Method;
use crate::scene::Camera;
use crate::scene::settings::Settings;

pub use csv::rates_csv;
pub use heidrich::HEIDRICH;
pub use kw03::KW03;
pub use rows::{Rate, RateLine, RateRatio, explained, rate, rate_lines, rate_verdicts};
pub use run::{TimingPlan, effort, file_of, settings_of, time_rates, turned};
pub use stegmaier::STEGMAIER;
pub use tables::rate_remarks;
pub(super) use tables::{absent_rates, present_rates, rates_sweep, rates_table};

/// Every table of frame rates, in the order of reports.
pub const RATE_TABLES: [&RateTable; 3] = [&STEGMAIER, &KW03, &HEIDRICH];

/// A table of frame rates.
pub struct RateTable {
    /// As reports cite the paper.
    pub paper: &'static str,
    /// What it compares.
    pub title: &'static str,
    /// Columns of the table.
    pub renderers: &'static [Renderer],
    /// The place in `renderers` of the one that the others are told in.
    pub base: usize,
    /// Rows of the table, in its order.
    pub sets: &'static [RateSet],
    /// The place in `sets` of the one that the others are told in; none where the paper compares renderers alone.
    pub base_set: Option<usize>,
    /// Sides of its square viewports, pixels.
    pub sizes: &'static [u32],
    /// What all sets have in common: sampling, and what it takes for the paper's own terms.
    pub common: fn(&mut Settings),
    /// What the main configuration is, in words.
    pub main: &'static str,
    /// Choices that the paper leaves open, each made otherwise alone, in the smallest viewport.
    pub choices: &'static [TimedChoice],
    /// What the paper leaves open, and what that means here.
    pub open: &'static [(&'static str, &'static str)],
}

/// A choice made otherwise than in the main configuration: what is chosen, how, and the change.
pub type TimedChoice = (&'static str, &'static str, fn(&mut Settings));

/// A way of rendering that a table compares.
#[derive(Clone, Copy)]
pub struct Renderer {
    /// As the paper calls it.
    pub name: &'static str,
    /// The method of ours.
    pub method: &'static Method,
    /// What the method needs otherwise than the others; it changes nothing where it was done before.
    pub adapt: fn(&mut Settings),
}

/// Makes settings see the volume of a file.
pub type OpenVolume = fn(&mut Settings, PathBuf);

/// A row of a table.
#[derive(Clone, Copy, Debug)]
pub struct RateSet {
    /// As the paper calls it.
    pub name: &'static str,
    /// Voxels of the paper's volume.
    pub dims: [u32; 3],
    /// The file that is this volume, or the one that is nearest to it.
    pub file: &'static str,
    /// How the volume is made of the file, or why it cannot be.
    pub open: std::result::Result<OpenVolume, &'static str>,
    /// What a reader should know of that volume.
    pub remark: Option<&'static str>,
    /// One slice of the paper's volume, in voxels of the file's.
    pub step: f64,
    /// Frames per second by each renderer in each viewport; none in any where the paper has none.
    pub theirs: &'static [&'static [f64]],
}

impl RateTable {
    /// What the paper says of the volume of one of the table's sets.
    pub fn source(&self, set: &RateSet) -> String {
        let [x, y, z] = set.dims;
        format!("{}, Table 1: {x} x {y} x {z} voxels", self.paper)
    }

    /// The set that the others are told in.
    pub fn told_in(&self) -> Option<&'static RateSet> {
        self.base_set.map(|place| &self.sets[place])
    }

    /// The renderer that the others are told in.
    pub fn base_renderer(&self) -> &'static Renderer {
        &self.renderers[self.base]
    }
}

/// T of frames whose rays end early, and of those whose rays do not.
pub const TERMINATION: f64 = 0.95;
pub const NO_TERMINATION: f64 = 1.0;

/// The volume is the whole file.
fn whole_file(settings: &mut Settings, path: PathBuf) {
    settings.volume.path = Some(path);
}

/// The tilt of a volume, degrees; how far the eye is from its centre, in longest sides, and how far where it is nearer; and
/// the vertical field of view, degrees.
const TILT: f64 = 20.0;
const DISTANCE: f64 = 1.91;
const NEAR_DISTANCE: f64 = 1.4;
const FOV: f64 = 45.0;

/// Where a turn begins, degrees: no direction then lies along an axis of the volume.
const FIRST_TURN: f64 = 15.0;

/// The eye where a turn begins, at a distance from what is looked at.
fn tilted(settings: &Settings, distance: f64) -> [f64; 3] {
    let eye = Camera::orbit(FIRST_TURN, TILT, distance, FOV).eye;
    (eye + glam::DVec3::from(settings.camera.target)).to_array()
}

/// The view from nearer by.
fn seen_near(settings: &mut Settings) {
    settings.camera.eye = tilted(settings, NEAR_DISTANCE);
}
