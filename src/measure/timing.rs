//! Times as the results file writes them: a number under its name, and how it spread under `NAME_stats`.

use std::fmt;

use serde::de::{self, MapAccess, Visitor};
use serde::ser::SerializeMap;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::statistics::Statistics;

/// What is put behind the name of a time to name its spread.
const STATS: &str = "_stats";

/// A time in milliseconds: the median where it was repeated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Timing {
    pub value: f64,
    /// `None` where only the one number is known.
    pub stats: Option<Statistics>,
}

impl Timing {
    /// A time measured once.
    pub fn once(milliseconds: f64) -> Self {
        Self { value: milliseconds, stats: None }
    }

    /// The median of repeated measurements in milliseconds; `None` as [`Statistics::of`].
    pub fn of(milliseconds: &[f64]) -> Option<Self> {
        Statistics::of(milliseconds).map(|stats| Self { value: stats.median, stats: Some(stats) })
    }

    /// Smallest and largest time seen; the value itself where it is the only one.
    pub fn range(&self) -> [f64; 2] {
        self.stats.map_or([self.value; 2], |s| [s.min, s.max])
    }

    fn spread(&self) -> Option<Spread> {
        self.stats.map(|s| Spread { min: s.min, max: s.max, mad: s.mad, n: s.n })
    }

    fn from_parts(value: f64, spread: Option<Spread>) -> Self {
        let stats = spread.map(|s| Statistics { median: value, min: s.min, max: s.max, mad: s.mad, n: s.n });
        Self { value, stats }
    }
}

/// [`Statistics`] without the median, which is the number it stands beside.
#[derive(Clone, Copy, Serialize, Deserialize)]
struct Spread {
    min: f64,
    max: f64,
    mad: f64,
    n: usize,
}

/// Times by name, in the order they were put in. Read and written as one flat map,
/// `{"setup": 0.1, "setup_stats": {"min", "max", "mad", "n"}, ...}`, so no name may end in `_stats`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Timings(pub Vec<(String, Timing)>);

impl Timings {
    pub fn get(&self, name: &str) -> Option<&Timing> {
        self.0.iter().find(|(n, _)| n == name).map(|(_, t)| t)
    }

    pub fn push(&mut self, name: impl Into<String>, timing: Timing) {
        self.0.push((name.into(), timing));
    }

    /// The time of the whole frame on the device.
    pub fn total(&self) -> Option<&Timing> {
        self.get("total")
    }

    /// The parts of the frame: every name but `total`.
    pub fn groups(&self) -> impl Iterator<Item = (&str, &Timing)> {
        self.0.iter().filter(|(name, _)| name != "total").map(|(name, timing)| (name.as_str(), timing))
    }
}

impl Serialize for Timings {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        for (name, timing) in &self.0 {
            map.serialize_entry(name, &timing.value)?;
            if let Some(spread) = timing.spread() {
                map.serialize_entry(&format!("{name}{STATS}"), &spread)?;
            }
        }
        map.end()
    }
}

impl<'de> Deserialize<'de> for Timings {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(TimingsVisitor)
    }
}

struct TimingsVisitor;

impl<'de> Visitor<'de> for TimingsVisitor {
    type Value = Timings;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a map of times in milliseconds, each with its NAME_stats")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Timings, A::Error> {
        let mut values: Vec<(String, f64)> = Vec::new();
        let mut spreads: Vec<(String, Spread)> = Vec::new();
        while let Some(key) = map.next_key::<String>()? {
            match key.strip_suffix(STATS) {
                Some(name) => spreads.push((name.to_string(), map.next_value()?)),
                None => values.push((key, map.next_value()?)),
            }
        }
        if let Some((name, _)) = spreads.iter().find(|(name, _)| values.iter().all(|(v, _)| v != name)) {
            return Err(de::Error::custom(format!("`{name}{STATS}` stands without `{name}`")));
        }
        let timing = |(name, value): (String, f64)| {
            let spread = spreads.iter().find(|(n, _)| *n == name).map(|(_, s)| *s);
            (name, Timing::from_parts(value, spread))
        };
        Ok(Timings(values.into_iter().map(timing).collect()))
    }
}

/// Times of the host, each `None` where it was not measured. Written as `frame_ms`, `frame_ms_stats`, ...
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(into = "FlatHostTimes", from = "FlatHostTimes")]
pub struct HostTimes {
    /// Wall time of a frame, from the begin of recording to the picture being complete.
    pub frame: Option<Timing>,
    /// CPU time of the whole process, all threads together, for a frame.
    pub cpu: Option<Timing>,
    /// CPU time for recording and submitting a frame.
    pub record: Option<Timing>,
    /// Building the structures the method skips with: CPU time of the process, device time where a GPU builds.
    pub build: Option<Timing>,
}

#[derive(Clone, Serialize, Deserialize)]
struct FlatHostTimes {
    frame_ms: Option<f64>,
    frame_ms_stats: Option<Spread>,
    cpu_ms: Option<f64>,
    cpu_ms_stats: Option<Spread>,
    record_ms: Option<f64>,
    record_ms_stats: Option<Spread>,
    build_ms: Option<f64>,
    build_ms_stats: Option<Spread>,
}

impl From<HostTimes> for FlatHostTimes {
    fn from(t: HostTimes) -> Self {
        let value = |t: Option<Timing>| t.map(|t| t.value);
        let stats = |t: Option<Timing>| t.and_then(|t| t.spread());
        Self {
            frame_ms: value(t.frame),
            frame_ms_stats: stats(t.frame),
            cpu_ms: value(t.cpu),
            cpu_ms_stats: stats(t.cpu),
            record_ms: value(t.record),
            record_ms_stats: stats(t.record),
            build_ms: value(t.build),
            build_ms_stats: stats(t.build),
        }
    }
}

impl From<FlatHostTimes> for HostTimes {
    fn from(t: FlatHostTimes) -> Self {
        let timing = |value: Option<f64>, stats| value.map(|value| Timing::from_parts(value, stats));
        Self {
            frame: timing(t.frame_ms, t.frame_ms_stats),
            cpu: timing(t.cpu_ms, t.cpu_ms_stats),
            record: timing(t.record_ms, t.record_ms_stats),
            build: timing(t.build_ms, t.build_ms_stats),
        }
    }
}
