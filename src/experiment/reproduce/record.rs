//! `reproduce.json` holds a [`Reproduction`]:
//!
//! | key | type | meaning |
//! | --- | --- | --- |
//! | `version` | integer | version of this format, [`FORMAT`] |
//! | `program`, `commit`, `command`, `date` | text | as in `results.json` |
//! | `columns` | array of {`name`, `source`, `file`, `absent`, `picture`, `variants`} | the tables' columns |
//! | `columns[].absent` | text or null | why nothing was counted for it |
//! | `columns[].picture` | text or null | a PNG file beside this one, of the main configuration |
//! | `columns[].variants` | array of {`choice`, `value`, `runs`} | the first is the main configuration, each other changes one choice of it; `runs` as in `results.json` |
//!
//! The papers' own numbers are data of the program ([`papers`](super::papers)) and stand in `reproduce.csv` beside ours.

use serde::{Deserialize, Serialize};

use crate::measure::Run;
use crate::provenance::Provenance;

/// The version of the format written here.
pub const FORMAT: u32 = 1;

/// What was counted.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Reproduction {
    #[serde(flatten)]
    pub provenance: Provenance,
    pub columns: Vec<ReproducedSet>,
}

/// One data set, in the order of [`super::papers::DATA_SETS`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ReproducedSet {
    pub name: String,
    pub source: String,
    /// The file that was read.
    pub file: Option<String>,
    /// Why nothing was counted.
    pub absent: Option<String>,
    /// A PNG file of the main configuration, seen from the folder of the results.
    #[serde(default)]
    pub picture: Option<String>,
    pub variants: Vec<Variant>,
}

/// The main configuration, or one choice of it made otherwise.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Variant {
    /// What is chosen, as in [`super::papers::OPEN`]; `main` for the main configuration.
    pub choice: String,
    pub value: String,
    pub runs: Vec<Run>,
}
