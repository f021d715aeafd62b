//! What a method saves against `rc-ert`, the claim in numbers: fragments, time, and how much of the one became the other.

use serde::{Deserialize, Serialize};

use super::comparison::forms;
use super::record::Run;
use super::timing::Timing;

/// The method whose fragments and time are saved: rays end early, nothing is skipped [KW03 §2.1].
pub const AGAINST: &str = "rc-ert";

/// What times are compared by.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Clock {
    /// CPU time of the process: the device is a CPU.
    Cpu,
    /// Timestamps of the device.
    Gpu,
    /// Wall time of a frame: the device has no timestamps.
    Wall,
}

impl Clock {
    pub fn words(self) -> &'static str {
        match self {
            Self::Cpu => "time is CPU time of the process, the device being a CPU",
            Self::Gpu => "time is the device's",
            Self::Wall => "time is wall time of a frame, the device having no timestamps",
        }
    }

    /// The best there is on a device.
    pub fn on(cpu: bool, timestamps: bool) -> Self {
        match (cpu, timestamps) {
            (true, _) => Self::Cpu,
            (_, true) => Self::Gpu,
            _ => Self::Wall,
        }
    }

    /// Of a frame.
    pub fn timing(self, run: &Run) -> Option<&Timing> {
        match self {
            Self::Cpu => run.host.cpu.as_ref(),
            Self::Gpu => run.gpu_ms.as_ref()?.total(),
            Self::Wall => run.host.frame.as_ref(),
        }
    }

    /// Medians of a frame, milliseconds.
    pub fn of(self, run: &Run) -> Option<f64> {
        self.timing(run).map(|timing| timing.value)
    }
}

/// Parts of what `rc-ert` takes; below 0 where a method takes more.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Saved {
    /// The run compared with: `rc-ert`, and its form of culling and marking.
    pub against: String,
    /// Of all fragments, those of main and of intermediate passes.
    pub fragments: f64,
    /// Of the time of a frame; null where it was not timed.
    pub time: Option<f64>,
    pub clock: Option<Clock>,
}

impl Saved {
    /// *Culling efficiency*: the part of the fragments saved that became time saved, 1 where all of it did. None where
    /// no fragments were saved.
    pub fn efficiency(&self) -> Option<f64> {
        (self.fragments > 0.0).then_some(self.time? / self.fragments)
    }
}

/// Fills in what each run saves against the `rc-ert` run of the same form, or else the first one. All are of one scene.
pub fn save(runs: &mut [&mut Run], on_cpu: bool) {
    let rules: Vec<Run> = runs.iter().filter(|run| run.method == AGAINST).map(|run| (**run).clone()).collect();
    for run in runs.iter_mut().filter(|run| run.method != AGAINST && run.method != "cpu") {
        let same = |rule: &&Run| (&rule.cull, &rule.mark) == (&run.cull, &run.mark);
        let Some(rule) = rules.iter().find(same).or_else(|| rules.first()) else { continue };
        let all = |run: &Run| run.fragments.main.saturating_add(run.fragments.intermediate) as f64;
        if all(rule) == 0.0 {
            continue;
        }
        let clock = Clock::on(on_cpu, rule.gpu_ms.is_some());
        let time = clock.of(run).zip(clock.of(rule).filter(|ms| *ms > 0.0)).map(|(ours, theirs)| 1.0 - ours / theirs);
        let form = forms(rule).map_or_else(String::new, |form| format!(" ({form})"));
        run.saved = Some(Saved {
            against: format!("{AGAINST}{form}"),
            fragments: 1.0 - all(run) / all(rule),
            time,
            clock: time.map(|_| clock),
        });
    }
}
