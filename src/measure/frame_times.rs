//! From the frames that were timed to the times of a run.

use super::record::PassTimes;
use super::timing::{HostTimes, Timing, Timings};
use crate::frame::FrameRun;
use crate::part::Group;

/// Of the host, from frames without queries.
pub fn host_times(plain: &[FrameRun], build: Option<Timing>) -> HostTimes {
    let of = |get: fn(&FrameRun) -> f64| Timing::of(&plain.iter().map(get).collect::<Vec<_>>());
    HostTimes { frame: of(|r| r.frame_ms), cpu: of(|r| r.cpu_ms), record: of(|r| r.record_ms), build }
}

/// Of the groups of passes on the device; none without timestamps.
pub fn gpu_times(timed: &[FrameRun]) -> Option<Timings> {
    let totals: Vec<f64> = timed.iter().filter_map(|r| r.gpu_total_ms).collect();
    let total = Timing::of(&totals)?;
    let mut timings = Timings::default();
    for group in Group::ALL {
        let sum = |r: &FrameRun| r.step_ms.iter().filter(|s| s.0 == group).map(|s| s.2).sum::<f64>();
        if timed.iter().any(|r| r.step_ms.iter().any(|s| s.0 == group))
            && let Some(timing) = Timing::of(&timed.iter().map(sum).collect::<Vec<_>>())
        {
            timings.push(group.name(), timing);
        }
    }
    timings.push("total", total);
    Some(timings)
}

/// The median time of each pass.
pub fn pass_times(timed: &[FrameRun], least: u32) -> Option<PassTimes> {
    timed.iter().find(|r| r.gpu_total_ms.is_some())?;
    let of = |group: Group| -> Vec<f64> {
        let passes = timed.iter().flat_map(|run| &run.step_ms).filter(|s| s.0 == Group::Main).map(|s| s.1 + 1);
        (0..passes.max().unwrap_or(0).max(least))
            .map(|pass| {
                // A pass runs once for each part of rays between layers.
                let here = |r: &FrameRun| {
                    r.step_ms.iter().filter(|s| s.0 == group && s.1 == pass).map(|s| s.2).reduce(|a, b| a + b)
                };
                let samples: Vec<f64> = timed.iter().filter_map(here).collect();
                Timing::of(&samples).map_or(0.0, |t| t.value)
            })
            .collect()
    };
    Some(PassTimes { main: of(Group::Main), intermediate: of(Group::Intermediate) })
}
