//! What `auto` chose, beside the best of what was run: in a sentence for all scenes, and in full for one.

use crate::auto::{AutoRecord, Estimate};
use crate::measure::Statistics;
use crate::measure::record::{Clock, Run};
use crate::report::comparison::{RunGroup, label};
use crate::report::cost::{extra_fetches, least_cost};
use crate::report::number::milliseconds;
use crate::report::table::{Column, Table};

/// A run of `auto` beside the fastest of the other runs of its scene.
#[derive(Clone, Debug, PartialEq)]
pub struct ChoiceLine {
    /// The method that was chosen.
    pub chosen: String,
    /// Milliseconds of a frame, with its part of what is built and of the look.
    pub ms: f64,
    /// The fastest of the others, and its milliseconds.
    pub best: String,
    pub best_ms: f64,
}

/// The run of `auto` in a group; none where it has none, or nothing beside it.
pub fn choice_line(group: &RunGroup) -> Option<ChoiceLine> {
    let free = group.runs.iter().map(|(_, run)| *run).find(|run| run.is_chosen_freely());
    let (run, auto) = free.and_then(|run| Some((run, run.auto.as_ref()?)))?;
    let clock = clock(group);
    let others = group.runs.iter().map(|(_, other)| *other).filter(|other| !other.is_chosen_freely());
    let timed = others.filter_map(|other| Some((label(other), whole_ms(other, auto, clock)?)));
    let (best, best_ms) = timed.min_by(|a, b| a.1.total_cmp(&b.1))?;
    let look = auto.look_ms / f64::from(auto.frames.max(1));
    Some(ChoiceLine { chosen: run.method.clone(), ms: whole_ms(run, auto, clock)? + look, best, best_ms })
}

/// What times of a group are compared by, which its runs say: device time where it was taken and the device is not the CPU, whose own
/// time is the steadier.
fn clock(group: &RunGroup) -> Clock {
    group.runs.iter().find_map(|(_, run)| run.saved.as_ref()?.clock).unwrap_or(Clock::Cpu)
}

/// Milliseconds of a frame, with its part of what is built for so many frames.
fn whole_ms(run: &Run, auto: &AutoRecord, clock: Clock) -> Option<f64> {
    let build = run.host.build.as_ref().map_or(0.0, |build| build.value);
    Some(run.milliseconds(clock)? + build / f64::from(auto.served(&run.method)))
}

/// How far the choices were from the best, in a sentence; none where none was made beside other runs.
pub fn choices(groups: &[RunGroup]) -> Option<String> {
    let plain = groups.iter().filter(|group| extra_fetches(group) == least_cost(group, groups));
    let lines: Vec<ChoiceLine> = plain.filter_map(choice_line).collect();
    let ratios: Vec<f64> = lines.iter().map(|line| line.ms / line.best_ms).collect();
    let Statistics { min, median, max, n, .. } = Statistics::of(&ratios)?;
    let scenes = if n == 1 { "1 scene".to_owned() } else { format!("{n} scenes") };
    let worst = lines.iter().max_by(|a, b| (a.ms / a.best_ms).total_cmp(&(b.ms / b.best_ms)))?;
    Some(format!(
        "auto took {median:.2} times as long as the best method of a scene in the median of {scenes}, {min:.2} to {max:.2}, its look \
         and what is built included; where it was furthest off it chose {} ({} ms) and {} took {} ms.",
        worst.chosen,
        milliseconds(worst.ms),
        worst.best,
        milliseconds(worst.best_ms),
    ))
}

/// What was weighed: a row for each method, by rising time.
pub fn weighed(auto: &AutoRecord) -> Table {
    let heads = ["M", "look-ups", "cell", "frame ms", "build ms", "ms in all", "main", "intermediate", "samples"];
    let columns = std::iter::once(Column::words("estimated")).chain(heads.map(Column::numbers));
    let mut table = Table::new(columns.collect());
    for estimate in &auto.weighed {
        let Estimate { method, samples_per_pass, lookups, cell, frame_ms, build_ms, ms, .. } = estimate;
        let work = &estimate.work;
        let counts = [work.main, work.intermediate, work.samples].map(|count| format!("{count:.0}"));
        let times = [*frame_ms, *build_ms, *ms].map(milliseconds);
        let settings = [*samples_per_pass, *lookups, *cell].map(|number| number.to_string());
        table.row(std::iter::once(method.clone()).chain(settings).chain(times).chain(counts));
    }
    table
}
