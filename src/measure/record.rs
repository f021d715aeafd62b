//! The results file. `render --json FILE` writes one [`Run`], `bench` a [`Results`] with an array of them. This page
//! is the reference for scripts that read either; numbers are JSON numbers, absent things are `null`.
//!
//! # The document (`results.json`)
//!
//! | key | type | meaning |
//! | --- | --- | --- |
//! | `version` | integer | version of this format, [`FORMAT`] |
//! | `program` | text | program and version, `depthleap 0.1.0` |
//! | `commit` | text | commit the program was built from, `unknown` outside a checkout |
//! | `command` | text | the command line |
//! | `date` | text | when the runs began, ISO 8601 |
//! | `runs` | array | the runs, in the order they were made |
//! | `pictures` | array of {`run`, `file`, `difference`} | PNG files beside this one, by the places of their runs: see [`PictureRecord`] |
//!
//! # A run
//!
//! | key | type, unit | meaning |
//! | --- | --- | --- |
//! | `version` | integer | version of this format |
//! | `scene` | text | name of the scene |
//! | `view` | text | the camera in words |
//! | `method` | text | `rc`, `rc-block`, `nn-omni`, ... |
//! | `cull`, `mark` | text or null | what `auto` became; null where the method has no such choice |
//! | `passes` | integer | N, main passes of the plan |
//! | `fragments` | counts | samples that passed every per-fragment test, by precise occlusion query; of a method `single-pass...` each is a ray, and of compute shaders (`...+compute`), which no query counts, an invocation: one for each pixel that the box may cover |
//! | `invocations` | counts or null | fragment-shader invocations, by pipeline statistics; of compute shaders those of all tiles of 8 x 8 pixels; null where the driver has none that can be believed |
//! | `gpu_ms` | times or null | device time of each group of passes and `total`, milliseconds, by timestamps; null where the device has none |
//! | `gpu_ms_per_pass` | {`main`, `intermediate`} of arrays, or null | the same, milliseconds for each pass |
//! | `frame_ms` | number or null, ms | wall time of a frame |
//! | `cpu_ms` | number or null, ms | CPU time of the process for a frame, all threads together |
//! | `record_ms` | number or null, ms | CPU time for recording and submitting a frame |
//! | `build_ms` | number or null, ms | building the structures, from the volume on: CPU time of the process where the host or a CPU device builds, else device time; null where the method has none |
//! | `bytes` | integer, bytes | size of the structures |
//! | `memory` | map text to integer, bytes | size of every resource of the frame by its name |
//! | `ideal` | {`main`} or null | main fragments no skipping can go below: those whose segment holds a contributing sample |
//! | `error` | error or null | how far the picture is from the reference; null where none was made, or none can be (`effect`) |
//! | `device`, `driver` | text | the device and its driver, with versions |
//! | `self_check` | map text to text | each form of the bounds test: `right`, what is wrong with it, or `not available` |
//! | `left_out` | array of {`what`, `why`} | what the scene did not need |
//! | `plan` | array of text | the frame's steps, one a line |
//! | `notes` | array of text | what a reader of the numbers should know |
//! | `warnings` | array of text | what may make the picture mislead: empty, imprecise, reoriented |
//! | `texture` | texture or null | how the volume was kept on the device: see [`TextureRecord`]; null for `cpu` and where no ray meets the volume |
//! | `orbit` | array of frames or null | of `bench --orbit`: see [`OrbitFrame`]; the other keys are those of the first view |
//! | `effect` | {`file`, `hash`} or null | the user's effect that samples and surfaces went through: see [`EffectRecord`]; with one `error` is null |
//! | `saved` | saving or null | fragments and time saved against `rc-ert`: see [`Saved`]; its `fragments` is null for methods `single-pass...`, whose fragments are rays; null for `rc-ert` itself, `cpu`, and where no `rc-ert` was run |
//! | `auto` | choice or null | where the method was `auto`, or an error was asked for: what was chosen, why, what else was weighed and what the look took: see [`AutoRecord`]; else null |
//! | `settings` | object | the keys of a scene file, from which alone the run can be repeated; relative paths are relative to this file, as in a scene file |
//!
//! *counts*: {`main`, `intermediate`: totals; `main_per_pass`, `intermediate_per_pass`: arrays in the order of the
//! passes, with an entry more at their end where `layers.partial` is `apart`, that of the pass of segments that end at a
//! surface (0 in the intermediate one); where there are polygons `per_layer`: array of {`pixels`, `main`, `intermediate`}
//! of the parts of rays that end at each layer, without `pixels` where layers have no colours}. *times*: each a number, the median where it was repeated, with `NAME_stats` {`min`, `max`, `mad`, `n`}
//! beside it: smallest, largest, median absolute deviation (milliseconds) and number of samples. So has every
//! `..._ms` of a run. *error*: see [`ErrorRecord`].

use std::collections::BTreeMap;

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

pub use super::entries::{
    ChangeRecord, Clock, CountsRecord, DifferenceRecord, EffectRecord, ErrorRecord, Ideal, LayerRecord, LeftOutRecord,
    OrbitFrame, PassTimes, PictureRecord, Saved, TextureRecord,
};
use super::fragment_kind::FragmentKind;
use super::timing::{HostTimes, Timing, Timings};
use crate::auto::AutoRecord;
use crate::error::{Error, Result};
use crate::feature::tiles;
use crate::method;
use crate::part::rows::Method;
use crate::provenance::{self, DocumentFormat, Provenance};
use crate::scene::Settings;
use crate::scene::settings::Tiles;

/// The version of the format written here.
pub const FORMAT: u32 = 1;

/// One scene rendered by one method: all that was counted, timed and checked.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Run {
    pub version: u32,
    pub scene: String,
    pub view: String,
    pub method: String,
    pub cull: Option<String>,
    pub mark: Option<String>,
    /// N, main passes of the plan.
    pub passes: u32,
    pub fragments: CountsRecord,
    pub invocations: Option<CountsRecord>,
    /// Milliseconds by group of passes, with `total`.
    pub gpu_ms: Option<Timings>,
    pub gpu_ms_per_pass: Option<PassTimes>,
    #[serde(flatten)]
    pub host: HostTimes,
    /// Size of the structures.
    pub bytes: u64,
    /// Bytes of every resource by its name.
    pub memory: BTreeMap<String, u64>,
    pub ideal: Option<Ideal>,
    pub error: Option<ErrorRecord>,
    pub device: String,
    pub driver: String,
    /// Verdict by form of the bounds test: `right`, what is wrong, or `not available`.
    pub self_check: BTreeMap<String, String>,
    pub left_out: Vec<LeftOutRecord>,
    pub plan: Vec<String>,
    pub notes: Vec<String>,
    /// What may make the picture mislead.
    #[serde(default)]
    pub warnings: Vec<String>,
    /// How the volume was kept on the device.
    #[serde(default)]
    pub texture: Option<TextureRecord>,
    /// Frames of a camera that goes around the volume.
    #[serde(default)]
    pub orbit: Option<Vec<OrbitFrame>>,
    /// The user's effect.
    #[serde(default)]
    pub effect: Option<EffectRecord>,
    /// Against `rc-ert`.
    #[serde(default)]
    pub saved: Option<Saved>,
    /// What `auto` has chosen.
    #[serde(default)]
    pub auto: Option<AutoRecord>,
    pub settings: Settings,
}

/// The runs of one command.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Results {
    #[serde(flatten)]
    pub provenance: Provenance,
    pub runs: Vec<Run>,
    /// Pictures that were kept beside the file.
    #[serde(default)]
    pub pictures: Vec<PictureRecord>,
}

impl Run {
    /// Whether its method is one of near-neighbor skipping, which marks rays with the pass of their next work.
    pub fn marks_sections(&self) -> bool {
        self.method.parse().ok().and_then(method::find).is_some_and(Method::marks_sections)
    }

    /// Whether its method looks up distances, of cells of one size or another.
    pub fn looks_up_distances(&self) -> bool {
        self.method.parse().ok().and_then(method::find).is_some_and(|method| method.distance().is_some())
    }

    /// Whether `auto` has chosen its method, and not the numbers alone of one that is named.
    pub fn is_chosen_freely(&self) -> bool {
        self.auto.as_ref().is_some_and(|auto| !auto.named)
    }

    /// Whether it draws only tiles of pixels behind which something may show.
    pub fn draws_live_tiles(&self) -> bool {
        let leaves_out = self.method.parse().ok().and_then(method::find).is_some_and(tiles::are_left_out_by);
        leaves_out && self.settings.method.tiles == Tiles::Live
    }

    /// What its fragments stand for; none where it runs on no device.
    pub fn fragment_kind(&self) -> Option<FragmentKind> {
        FragmentKind::of(&self.method)
    }

    /// `bounds + copy`, or whichever of the two there is.
    pub fn form(&self) -> Option<String> {
        match (&self.cull, &self.mark) {
            (Some(cull), Some(mark)) => Some(format!("{cull} + {mark}")),
            (one, other) => one.clone().or_else(|| other.clone()),
        }
    }

    /// The time of a frame by a clock.
    pub fn timing(&self, clock: Clock) -> Option<&Timing> {
        match clock {
            Clock::Cpu => self.host.cpu.as_ref(),
            Clock::Gpu => self.gpu_ms.as_ref()?.total(),
            Clock::Wall => self.host.frame.as_ref(),
        }
    }

    /// The median time of a frame by a clock, milliseconds.
    pub fn milliseconds(&self, clock: Clock) -> Option<f64> {
        self.timing(clock).map(|timing| timing.value)
    }

    /// # Errors
    /// As [`Results::to_json`].
    pub fn to_json(&self) -> Result<String> {
        to_json(self)
    }

    /// Reads what [`Run::to_json`] wrote; `name` is the file, for the error.
    ///
    /// # Errors
    /// When the text is not JSON, a key is missing or of another type, or the format is of another version.
    pub fn from_json(name: &str, text: &str) -> Result<Self> {
        from_json(name, text)
    }
}

impl Results {
    /// # Errors
    /// When a value cannot be written as JSON.
    pub fn to_json(&self) -> Result<String> {
        to_json(self)
    }

    /// # Errors
    /// As [`Run::from_json`].
    pub fn from_json(name: &str, text: &str) -> Result<Self> {
        from_json(name, text)
    }
}

fn to_json(value: &impl Serialize) -> Result<String> {
    let mut text = serde_json::to_string_pretty(value).map_err(|e| {
        Error::output("results", format!("cannot be written as JSON ({e})"), "check paths for names that are not UTF-8")
    })?;
    text.push('\n');
    Ok(text)
}

fn from_json<T: DeserializeOwned>(name: &str, text: &str) -> Result<T> {
    let expected = DocumentFormat {
        what: "a results file",
        version: FORMAT,
        remedies: [
            "give a file that `render --json` or `bench` wrote",
            "read it with the program that wrote it, or make the runs again",
        ],
    };
    provenance::read(name, text, &expected)
}
