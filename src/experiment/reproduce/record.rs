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
//! | `timed` | {`clock`, `rates`, `termination`} or null | frames of [Stegmaier05], [KW03] and [Heidrich95 §5] that were timed; absent in results of older programs |
//! | `timed.clock` | `cpu`, `gpu`, `wall` or null | what times are compared by on this device; null where nothing was timed |
//! | `timed.rates` | array like `columns` | data sets of its Table 1, and of those of [KW03] and [Heidrich95 §5], told apart by `source`: of each variant a run for each method, viewport (`settings.image`) and direction (`settings.camera`), with `frame_ms`, `cpu_ms` and `gpu_ms`; variants other than the first in the smallest viewport alone |
//! | `stated` | {`slices`, `propagation`} or null | what [KW03] and [Weiler03] state in words: volumes in slices, a run of all of them and one front to back whose `ideal` are the fragments that contribute; a mesh by ray propagation, with counts of rays and without; absent in results of older programs |
//! | `timed.termination` | one like those of `columns` | early ray termination: the variants are transfer functions, with two runs for each direction: `settings.sampling.termination` below 1, and 1 |
//!
//! The papers' own numbers are data of the program ([`papers`](super::papers), [`rates`](super::rates),
//! [`termination`](super::termination)) and stand in `reproduce.csv` and `reproduce-rates.csv` beside ours.

use serde::{Deserialize, Serialize};

use crate::measure::Run;
use crate::measure::record::Clock;
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
    #[serde(default)]
    pub timed: Option<TimedRecord>,
    #[serde(default)]
    pub stated: Option<StatedRecord>,
}

/// What the papers state of passes and fragments in words.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StatedRecord {
    /// Volumes in slices, all of them and front to back, a pass each.
    pub slices: Vec<ReproducedSet>,
    /// A mesh of tetrahedra by ray propagation, with counts of the rays left and without.
    pub propagation: ReproducedSet,
}

/// Frames that were timed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TimedRecord {
    /// What times are compared by on this device; none where nothing was timed.
    pub clock: Option<Clock>,
    /// The data sets of the frame rates, table after table in the order of [`super::rates::RATE_TABLES`].
    pub rates: Vec<ReproducedSet>,
    /// Frames with early ray termination and without.
    pub termination: ReproducedSet,
}

/// One data set; those of counts in the order of [`super::papers::DATA_SETS`].
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
    /// What is chosen, as in [`super::papers::OPEN`] and the tables of [`super::rates`]; `main` for the main configuration.
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
