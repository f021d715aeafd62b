//! `probe.json`: every number that was measured, and the reference of its format. Keys are those of the structures here
//! and of [`CaseFault`], [`Cost`], [`CullingVerdict`](super::CullingVerdict), [`MarkCost`]; times are milliseconds, one for each repetition.

use serde::{Deserialize, Serialize};

use super::case::Case;
use super::correct::CaseFault;
use super::decide::Culling;
use super::marks::MarkCost;
use super::measure::{Cost, ProbeClock};
use super::rule::Promise;
use crate::error::Result;
use crate::provenance::{self, DocumentFormat, Provenance};
use crate::vulkan::DeviceInfo;

/// The version of the format written here.
pub const FORMAT: u32 = 1;

/// All that was found of a device.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Probe {
    #[serde(flatten)]
    pub provenance: Provenance,
    pub device: DeviceRecord,
    /// What `ms` are.
    pub clock: ProbeClock,
    /// Why the driver's counts of shader invocations are not believed; null where they are.
    pub statistics: Option<String>,
    /// Rounds of work in a shader that is timed.
    pub work: u32,
    /// Pixels of a side of the pictures that are checked, timed, and used for rates.
    pub sides: [u32; 3],
    pub quick: bool,
    /// Depth formats asked for; the first is that of `cost` (a stencil test: the first that has a stencil).
    pub formats: Vec<String>,
    pub lines: Vec<MechanismRecord>,
    pub marks: MarkCost,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct DeviceRecord {
    pub name: String,
    pub driver: String,
    pub driver_version: String,
    pub api_version: String,
    pub depth_bounds: bool,
    pub occlusion_precise: bool,
    pub pipeline_statistics: bool,
    pub timestamp_valid_bits: u32,
}

impl From<&DeviceInfo> for DeviceRecord {
    fn from(info: &DeviceInfo) -> Self {
        Self {
            name: info.name.clone(),
            driver: format!("{} {}", info.driver_name, info.driver_info).trim().to_owned(),
            driver_version: info.driver_version.clone(),
            api_version: info.api_version.clone(),
            depth_bounds: info.depth_bounds,
            occlusion_precise: info.occlusion_precise,
            pipeline_statistics: info.pipeline_statistics,
            timestamp_valid_bits: info.timestamp_valid_bits,
        }
    }
}

/// A mechanism with a shader.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MechanismRecord {
    #[serde(flatten)]
    pub case: Case,
    pub promise: Promise,
    /// What the device lacks for it; null where it was asked.
    pub missing: Option<String>,
    /// The formats that were asked for, with the first fault of each kind.
    pub correct: Vec<Correct>,
    pub cost: Option<Cost>,
    /// In the other formats.
    pub others: Vec<Other>,
    /// Fragments rejected in a second; null where they are not rejected early.
    pub rejected_per_second: Option<f64>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Correct {
    pub format: String,
    pub faults: Vec<CaseFault>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Other {
    pub format: String,
    pub cost: Cost,
}

impl MechanismRecord {
    pub fn culling(&self) -> Option<Culling> {
        self.cost.as_ref().map(|cost| cost.verdict.culling)
    }

    pub fn faults(&self) -> impl Iterator<Item = &CaseFault> {
        self.correct.iter().flat_map(|correct| &correct.faults)
    }

    /// `yes`, `wrong in D16_UNORM`, `not available`.
    pub fn right(&self) -> String {
        if self.missing.is_some() {
            return "not available".to_owned();
        }
        let wrong: Vec<&str> =
            self.correct.iter().filter(|c| !c.faults.is_empty()).map(|c| c.format.as_str()).collect();
        match wrong.len() {
            0 => "yes".to_owned(),
            n if n == self.correct.len() && n > 1 => "WRONG in all formats".to_owned(),
            _ => format!("WRONG in {}", wrong.join(", ")),
        }
    }

    /// `early, from 4 px`, `late`, `partly`; of a shader that rejects, `work skipped`.
    pub fn culled(&self) -> String {
        let Some(cost) = &self.cost else { return "-".to_owned() };
        let word = match cost.verdict.culling {
            Culling::Early if self.case.mechanism.in_shader() => "work skipped",
            Culling::Late if self.case.mechanism.in_shader() => "work done",
            culling => culling.word(),
        };
        match (cost.tile, cost.mixed.is_empty()) {
            (Some(tile), _) if cost.verdict.culling != Culling::Late => format!("{word}, from {tile} px"),
            (None, false) => format!("{word}, in one piece only"),
            _ => word.to_owned(),
        }
    }
}

/// Reads a `probe.json`.
///
/// # Errors
/// When it is none, or one of another version.
pub fn read(text: &str, name: &str) -> Result<Probe> {
    const REMEDY: &str = "give a probe.json that this program wrote";
    let expected = DocumentFormat { what: "a result of a probe", version: FORMAT, remedies: [REMEDY; 2] };
    provenance::read(name, text, &expected)
}
