//! `stability.json`: every case by every method.

use serde::{Deserialize, Serialize};

use super::case::StabilityCase;
use super::judge::{Outcome, StabilityVerdict};
use crate::provenance::Provenance;

/// The version of the format written here.
pub const FORMAT: u32 = 1;

/// `stability.json`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Stability {
    #[serde(flatten)]
    pub provenance: Provenance,
    pub device: String,
    pub driver: String,
    pub cases: Vec<CaseRecord>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CaseRecord {
    pub group: String,
    pub name: String,
    /// What the picture was held against, and how far a channel may be from it: absolute, and of its value.
    pub expected: String,
    pub tolerance: [f64; 2],
    pub reason: String,
    pub outcomes: Vec<Outcome>,
    /// Milliseconds that the case took, reference included.
    pub ms: f64,
}

impl CaseRecord {
    pub fn new(case: &StabilityCase, outcomes: Vec<Outcome>, ms: f64) -> Self {
        Self {
            group: case.group.to_owned(),
            name: case.name.clone(),
            expected: case.expect.words().to_owned(),
            tolerance: [case.tolerance.absolute, case.tolerance.relative],
            reason: case.tolerance.reason.to_owned(),
            outcomes,
            ms,
        }
    }

    /// Wrong where any method is; missing where none was run.
    pub fn verdict(&self) -> StabilityVerdict {
        let any = |verdict: StabilityVerdict| self.outcomes.iter().any(|o| o.verdict == verdict);
        match () {
            () if any(StabilityVerdict::Wrong) => StabilityVerdict::Wrong,
            () if any(StabilityVerdict::Right) => StabilityVerdict::Right,
            () => StabilityVerdict::Missing,
        }
    }

    /// The largest difference as a share of what is allowed.
    pub fn share(&self) -> Option<f64> {
        self.outcomes.iter().filter_map(|o| o.share).reduce(f64::max)
    }
}

impl Stability {
    pub fn count(&self, verdict: StabilityVerdict) -> usize {
        self.cases.iter().filter(|case| case.verdict() == verdict).count()
    }

    /// How many cases came out right, in a sentence.
    pub fn summary(&self) -> String {
        let (right, wrong, missing) = (
            self.count(StabilityVerdict::Right),
            self.count(StabilityVerdict::Wrong),
            self.count(StabilityVerdict::Missing),
        );
        let runs: usize = self.cases.iter().map(|case| case.outcomes.len()).sum();
        let mut text = format!("{} cases, {runs} pictures: {right} right, {wrong} wrong", self.cases.len());
        if missing > 0 {
            text += &format!(", {missing} not run, since the device lacks something");
        }
        text
    }
}
