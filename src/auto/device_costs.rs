//! What work costs on a device, beside what it costs by the constants of `cost`: a factor for each kind of work in each way of working,
//! found from a few frames that were timed there.

use serde::{Deserialize, Serialize};

use crate::method::METHODS;
use crate::part::rows::{Method, Traversal};

/// Ways of working that have costs of their own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// A loop holds a ray.
    Loops,
    /// Main passes, with intermediate ones between them.
    Passes,
    /// Main passes that decide where rays go on.
    Fused,
    Slices,
}

impl Way {
    pub const ALL: [Self; 4] = [Self::Loops, Self::Passes, Self::Fused, Self::Slices];

    pub fn of(method: &Method) -> Self {
        match method.traversal {
            Traversal::FragmentLoop | Traversal::ComputeLoop => Self::Loops,
            Traversal::Passes if method.fused => Self::Fused,
            // Nobody weighs shells, or cells.
            Traversal::Passes | Traversal::Shells | Traversal::Cells(_) => Self::Passes,
            Traversal::Slices(_) => Self::Slices,
        }
    }
}

/// Kinds of work.
pub const KINDS: usize = 4;

/// What kinds of work cost, as multiples of the constants.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Factors {
    /// A frame and its passes.
    pub passes: f64,
    /// Pixels that passes cover, and fragments, main and intermediate.
    pub fragments: f64,
    pub samples: f64,
    pub lookups: f64,
}

impl Factors {
    const ONE: Self = Self::all([1.0; KINDS]);

    const fn all([passes, fragments, samples, lookups]: [f64; KINDS]) -> Self {
        Self { passes, fragments, samples, lookups }
    }

    /// In the order in which frames are taken apart: what passes take, fragments, samples, look-ups.
    pub fn in_order(self) -> [f64; KINDS] {
        [self.passes, self.fragments, self.samples, self.lookups]
    }
}

/// What work costs on a device.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct DeviceCosts {
    /// When frames were timed there, UTC in RFC 3339; null where nothing is known of the device, and the constants stand as they are.
    pub measured: Option<String>,
    pub loops: Factors,
    pub passes: Factors,
    pub fused: Factors,
    pub slices: Factors,
    /// What building distances and ranges costs, as a multiple.
    pub builds: f64,
}

impl Default for DeviceCosts {
    fn default() -> Self {
        let one = Factors::ONE;
        Self { measured: None, loops: one, passes: one, fused: one, slices: one, builds: 1.0 }
    }
}

impl DeviceCosts {
    pub fn of(&self, way: Way) -> Factors {
        match way {
            Way::Loops => self.loops,
            Way::Passes => self.passes,
            Way::Fused => self.fused,
            Way::Slices => self.slices,
        }
    }

    /// From frames that were timed on a device at that date; ways without one have the factors of loops, and a device without any the
    /// constants as they are.
    pub fn fit(measured: String, frames: &[TimedFrame], builds: Option<f64>) -> Self {
        let of = |way: Way| {
            let rows: Vec<TimedFrame> = frames.iter().filter(|frame| frame.way() == way).cloned().collect();
            fit(&rows)
        };
        let loops = of(Way::Loops).unwrap_or(Factors::ONE);
        let [passes, fused, slices] = [Way::Passes, Way::Fused, Way::Slices].map(|way| of(way).unwrap_or(loops));
        let measured = frames.iter().any(TimedFrame::says).then_some(measured);
        Self { measured, loops, passes, fused, slices, builds: builds.unwrap_or(1.0) }
    }

    /// Where the costs come from, in words.
    pub fn words(&self) -> String {
        match &self.measured {
            Some(date) => format!("what work costs on this device was measured on {date}"),
            None => "what work costs is taken from lavapipe of Mesa 22.3".to_owned(),
        }
    }
}

/// A frame that was timed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TimedFrame {
    pub method: String,
    /// What it is made of, by the constants as they are: milliseconds of each kind of work.
    pub parts: [f64; KINDS],
    /// What it took.
    pub ms: f64,
}

impl TimedFrame {
    /// Whether it tells anything of what work costs.
    fn says(&self) -> bool {
        self.ms > 0.0 && self.parts.iter().sum::<f64>() > 0.0
    }

    fn way(&self) -> Way {
        let row = METHODS.into_iter().find(|row| row.name == self.method);
        row.map_or(Way::Loops, Way::of)
    }
}

/// How much it weighs that a kind of work is as many times the constants as all work is, against a frame that is off by all it takes: kinds
/// that few frames tell apart stay together.
const TOGETHER: f64 = 0.003;

/// A kind of work costs at least so much of what all work is off by.
const LEAST: f64 = 1e-3;

/// Rounds in which one factor after the other is set to the best beside the others.
const ROUNDS: usize = 500;

/// The factors by which estimates are off by least in the mean of the squares of their relative errors; none where there is no frame.
fn fit(frames: &[TimedFrame]) -> Option<Factors> {
    let frames: Vec<&TimedFrame> = frames.iter().filter(|frame| frame.says()).collect();
    let mut ratios: Vec<f64> = frames.iter().map(|frame| frame.ms / frame.parts.iter().sum::<f64>()).collect();
    ratios.sort_by(f64::total_cmp);
    let all = *ratios.get(ratios.len() / 2)?;
    let share = 1.0 / frames.len() as f64;
    let mut factors = [all; KINDS];
    for round in 0..ROUNDS * KINDS {
        let kind = round % KINDS;
        let (mut along, mut square) = (TOGETHER / all, TOGETHER / (all * all));
        for TimedFrame { parts, ms, .. } in &frames {
            let of_others: f64 = (0..KINDS).filter(|other| *other != kind).map(|i| parts[i] * factors[i]).sum();
            along += share * parts[kind] / ms * (1.0 - of_others / ms);
            square += share * (parts[kind] / ms).powi(2);
        }
        factors[kind] = (along / square).max(LEAST * all);
    }
    Some(Factors::all(factors))
}
