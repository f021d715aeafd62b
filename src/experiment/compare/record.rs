//! Two results side by side: other devices, drivers or commits. CountsRecord are compared exactly, times with their spread.

use std::collections::BTreeMap;

use serde::Serialize;
use serde_json::Value;

use crate::measure::record::{CountsRecord, OrbitFrame, Results, Run};
use crate::measure::timing::Timing;

/// The version of the JSON that `compare --json` writes.
pub const FORMAT: u32 = 1;

/// What differs between two results.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Comparison {
    pub version: u32,
    /// Where each comes from: program, commit, devices, date.
    pub a: String,
    pub b: String,
    /// Runs that only the first, or only the second has.
    pub only_in_a: Vec<String>,
    pub only_in_b: Vec<String>,
    pub runs: Vec<RunComparison>,
}

/// One run of both.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RunComparison {
    pub run: String,
    /// Settings whose values differ; files count by their names, since folders differ between machines.
    pub settings: Vec<Difference>,
    /// CountsRecord that differ, and how many main passes there are.
    pub counts: Vec<Difference>,
    pub times: Vec<TimeDifference>,
}

/// Two values of one thing.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Difference {
    pub what: String,
    pub a: Value,
    pub b: Value,
}

/// Two times of one thing.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TimeDifference {
    pub what: String,
    /// Medians, milliseconds.
    pub a: f64,
    pub b: f64,
    /// Whether all samples of the one lie beyond all of the other.
    pub apart: bool,
}

impl Comparison {
    /// Whether every run is in both, with the same counts.
    pub fn same_counts(&self) -> bool {
        self.only_in_a.is_empty() && self.only_in_b.is_empty() && self.runs.iter().all(|run| run.counts.is_empty())
    }
}

/// Compares run by run: those of one scene, view, method and form are of each other, several of these in their order.
pub fn compare(a: &Results, b: &Results) -> Comparison {
    let mut others: Vec<Option<&Run>> = b.runs.iter().map(Some).collect();
    let (mut runs, mut only_in_a) = (Vec::new(), Vec::new());
    for run in &a.runs {
        let name = name(run);
        let partner = others.iter_mut().find(|other| other.is_some_and(|other| self::name(other) == name));
        match partner.and_then(Option::take) {
            Some(other) => runs.push(compare_run(name, run, other)),
            None => only_in_a.push(name),
        }
    }
    let only_in_b = others.into_iter().flatten().map(name).collect();
    Comparison { version: FORMAT, a: source(a), b: source(b), only_in_a, only_in_b, runs }
}

/// `fuel, ramp: nn-omni (ztest + copy), eye ...`
fn name(run: &Run) -> String {
    let form = run.form().map_or_else(String::new, |form| format!(" ({form})"));
    format!("{}: {}{form}, {}", run.scene, run.method, run.view)
}

fn source(results: &Results) -> String {
    let mut devices: Vec<String> = Vec::new();
    for run in &results.runs {
        let device = format!("{}, {}", run.device, run.driver);
        if !devices.contains(&device) {
            devices.push(device);
        }
    }
    let made = &results.provenance;
    format!("{}, {} ({})", made.made_by(), made.date, devices.join("; "))
}

fn compare_run(name: String, a: &Run, b: &Run) -> RunComparison {
    let mut counts = Vec::new();
    let mut count = |what: &str, a: Value, b: Value| {
        if a != b {
            counts.push(Difference { what: what.to_owned(), a, b });
        }
    };
    count("passes", a.passes.into(), b.passes.into());
    for (what, get) in COUNTS {
        count(what, get(&a.fragments).into(), get(&b.fragments).into());
        // Some devices have no count of invocations; what one lacks does not differ.
        if let (Some(a), Some(b)) = (&a.invocations, &b.invocations) {
            count(&what.replace("fragments", "invocations"), get(a).into(), get(b).into());
        }
    }
    let frames = |run: &Run, get: fn(&OrbitFrame) -> u64| -> Value {
        run.orbit.iter().flatten().map(get).collect::<Vec<u64>>().into()
    };
    for (what, get) in FRAME_COUNTS {
        count(what, frames(a, get), frames(b, get));
    }
    RunComparison { run: name, settings: settings(a, b), counts, times: times(a, b) }
}

/// A count by its name.
type Count = (&'static str, fn(&CountsRecord) -> Vec<u64>);

const COUNTS: [Count; 2] = [
    ("main fragments, pass by pass", |counts| counts.main_per_pass.clone()),
    ("intermediate fragments, pass by pass", |counts| counts.intermediate_per_pass.clone()),
];

/// A count of a frame of an orbit by its name.
type FrameCount = (&'static str, fn(&OrbitFrame) -> u64);

const FRAME_COUNTS: [FrameCount; 2] = [
    ("main fragments of the orbit, frame by frame", |frame| frame.main),
    ("intermediate fragments of the orbit, frame by frame", |frame| frame.intermediate),
];

fn times(a: &Run, b: &Run) -> Vec<TimeDifference> {
    let mut times = Vec::new();
    let mut time = |what: String, a: Option<&Timing>, b: Option<&Timing>| {
        let (Some(a), Some(b)) = (a, b) else { return };
        let ([a_least, a_most], [b_least, b_most]) = (a.range(), b.range());
        let apart = a_most < b_least || b_most < a_least;
        times.push(TimeDifference { what, a: a.value, b: b.value, apart });
    };
    time("frame_ms".to_owned(), a.host.frame.as_ref(), b.host.frame.as_ref());
    time("cpu_ms".to_owned(), a.host.cpu.as_ref(), b.host.cpu.as_ref());
    time("build_ms".to_owned(), a.host.build.as_ref(), b.host.build.as_ref());
    for (group, timing) in a.gpu_ms.iter().flat_map(|times| &times.0) {
        time(format!("gpu_ms.{group}"), Some(timing), b.gpu_ms.as_ref().and_then(|times| times.get(group)));
    }
    times
}

fn settings(a: &Run, b: &Run) -> Vec<Difference> {
    let flat = |run: &Run| {
        let mut flat = BTreeMap::new();
        let value = serde_json::to_value(&run.settings).unwrap_or_default();
        flatten("", &value, &mut flat);
        flat
    };
    let (a, b) = (flat(a), flat(b));
    let keys: std::collections::BTreeSet<&String> = a.keys().chain(b.keys()).collect();
    let of = |settings: &BTreeMap<String, Value>, key: &String| settings.get(key).cloned().unwrap_or_default();
    keys.into_iter()
        .map(|key| Difference { what: key.clone(), a: of(&a, key), b: of(&b, key) })
        .filter(|difference| file_name(&difference.a) != file_name(&difference.b))
        .collect()
}

/// The entries of an object by their keys with points between: `sampling.step`.
fn flatten(prefix: &str, value: &Value, into: &mut BTreeMap<String, Value>) {
    match value {
        Value::Object(entries) => {
            for (key, value) in entries {
                let name = if prefix.is_empty() { key.clone() } else { format!("{prefix}.{key}") };
                flatten(&name, value, into);
            }
        }
        other => {
            into.insert(prefix.to_owned(), other.clone());
        }
    }
}

/// Text without the folders in front of it.
fn file_name(value: &Value) -> Value {
    match value {
        Value::String(text) => text.rsplit(['/', '\\']).next().unwrap_or(text).into(),
        other => other.clone(),
    }
}
