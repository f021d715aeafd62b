//! What `auto` has chosen, and why: `auto` of a run, and of a plan as JSON.

use serde::{Deserialize, Serialize};

use super::cost::served;
use super::error::ErrorChoice;
use super::work::Work;
use crate::method::METHODS;

/// A choice.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct AutoRecord {
    /// M of the settings that were asked for, or by default where it was left open; what was chosen stands in the run's settings.
    pub samples_per_pass: u32,
    /// Frames that what is built was taken to serve, and whether the view changes from one to the next.
    pub frames: u32,
    pub moving: bool,
    /// CPU time of the look and the choice, milliseconds.
    pub look_ms: f64,
    /// What was found, in sentences.
    pub reasons: Vec<String>,
    /// Whether the method was named, so that its settings alone were chosen.
    #[serde(default)]
    pub named: bool,
    /// Whether methods that leave out tiles of pixels behind which nothing shows were weighed as such.
    #[serde(default)]
    pub tiles: bool,
    /// How steps were chosen that meet an error; null where none was asked for.
    pub error: Option<ErrorChoice>,
    pub chosen: Estimate,
    /// The best of another method; null where no other draws the scene.
    pub runner_up: Option<Estimate>,
    /// What was weighed, the best of each method, by rising time.
    pub weighed: Vec<Estimate>,
}

/// What a method would take, estimated.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Estimate {
    pub method: String,
    /// M, look-ups in a segment and voxels along a side of a cell.
    pub samples_per_pass: u32,
    pub lookups: u32,
    pub cell: u32,
    /// Milliseconds of CPU time of a frame, and of what is built.
    pub frame_ms: f64,
    pub build_ms: f64,
    /// Of a frame with its part of what is built.
    pub ms: f64,
    /// What a frame does.
    pub work: Work,
}

impl AutoRecord {
    /// Frames that what a method builds was taken to serve.
    pub fn served(&self, method: &str) -> u32 {
        let row = METHODS.into_iter().find(|row| row.name == method);
        row.map_or(self.frames.max(1), |row| served(row, self.frames, self.moving))
    }

    /// The choice in sentences: what it is, the runner-up, and what was found.
    pub fn sentences(&self) -> Vec<String> {
        let frames = match (self.frames, self.moving) {
            (1, _) => "for one frame".to_owned(),
            (n, false) => format!("for {n} frames of one view"),
            (n, true) => format!("for {n} frames of a view that moves"),
        };
        let chosen = match self.named {
            true => format!("settings were chosen of {} {frames}", self.chosen.words()),
            false => format!("auto chose {} {frames}", self.chosen.words()),
        };
        let runner_up = self.runner_up.iter().map(|estimate| format!("the runner-up is {}", estimate.words()));
        let error = self.error.iter().map(ErrorChoice::words);
        std::iter::once(chosen).chain(error).chain(runner_up).chain(self.reasons.iter().cloned()).collect()
    }
}

impl Estimate {
    /// `nn-omni (M = 32, look-ups 16, cell 1): 20.0 ms a frame and 500 ms to build, estimated`.
    fn words(&self) -> String {
        let Self { method, samples_per_pass, lookups, cell, frame_ms, build_ms, .. } = self;
        let build = if *build_ms > 0.0 { format!(" and {build_ms:.0} ms to build") } else { String::new() };
        format!(
            "{method} (M = {samples_per_pass}, look-ups {lookups}, cell {cell}): {frame_ms:.1} ms a frame{build}, estimated"
        )
    }
}
