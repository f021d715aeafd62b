//! `reproduce.json` holds a [`Reproduction`]:
//!
//! | key | type | meaning |
//! | --- | --- | --- |
//! | `version` | integer | version of this format, [`FORMAT`] |
//! | `program`, `commit`, `command`, `date` | text | as in `results.json` |
//! | `columns` | array of {`name`, `source`, `file`, `absent`, `picture`, `variants`} | the tables' columns |
//! | `columns[].absent` | text or null | why nothing was counted for it |
//! | `columns[].picture` | text or null | a PNG file beside this one, of the main configuration, with polygons where the tables have them |
//! | `columns[].variants` | array of {`choice`, `value`, `runs`} | the first is the main configuration, each other changes one choice of it; `runs` as in `results.json`: where the tables have polygons, first without `settings.mesh` and then with it, the counts of each layer in `fragments.per_layer` |
//! | `figures` | array of {`scene`, `about`, `source`, `file`, `absent`, `picture`, `run`} | scenes like the papers' figures; absent in results of older programs |
//! | `figures[].scene` | text | the name of the built-in scene, or of its form on a volume, see [`crate::scene::scenes`] |
//! | `figures[].file` | text or null | the volume that was read; null for scenes that are built in |
//! | `figures[].absent` | text or null | why nothing was drawn |
//! | `figures[].picture` | text or null | a PNG file beside this one |
//! | `figures[].run` | run or null | as in `results.json` |
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
    #[serde(default)]
    pub figures: Vec<FigureRecord>,
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
    /// A PNG file of the main configuration, with polygons where the tables have them, seen from the folder of the results.
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

/// A scene like a figure of the papers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FigureRecord {
    /// The built-in scene that it is, or is a form of.
    pub scene: String,
    /// What is to be seen.
    pub about: String,
    /// The figure whose like it is.
    pub source: String,
    /// The volume that was read; none for a built-in scene.
    pub file: Option<String>,
    /// Why nothing was drawn.
    pub absent: Option<String>,
    /// A PNG file, seen from the folder of the results.
    pub picture: Option<String>,
    pub run: Option<Run>,
}
