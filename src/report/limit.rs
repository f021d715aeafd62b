//! How far frames are from what skipping could leave of them at best: the segments that show something and nothing else, each at what one
//! of `rc` takes, and the main passes at what an empty one takes.

use crate::measure::record::{Clock, Run};
use crate::report::number::milliseconds;

/// The method that draws every segment.
const ALL: &str = "rc";

/// Nanoseconds of a millisecond.
const NANOSECONDS: f64 = 1e6;

/// The limit of a group of runs.
#[derive(Clone, Debug, PartialEq)]
pub struct Limit {
    pub clock: Clock,
    /// Of a frame.
    pub ms: f64,
    /// Segments that show something.
    pub segments: u64,
    /// Milliseconds of one segment.
    pub segment_ms: f64,
    pub passes: u32,
    /// Milliseconds of an empty pass, and whether any pass was empty, else of the shortest.
    pub pass_ms: f64,
    pub any_is_empty: bool,
    /// The runs that draw the same segments, by what tells them apart, and how many times the limit their frames take.
    pub distances: Vec<(String, f64)>,
}

impl Limit {
    /// The limit of main fragments that no skipping goes below, of runs of one scene, each with what tells it apart; none without one of
    /// `rc` that was timed pass by pass.
    pub fn of(runs: &[(String, &Run)], ideal: u64) -> Option<Self> {
        let m = |run: &Run| run.settings.sampling.samples_per_pass;
        // The runs that skip have a bound, of segments as long as theirs; that of all segments has none.
        let bounds =
            |of: &Run| runs.iter().any(|(_, run)| run.ideal.is_some_and(|own| own.main == ideal) && m(run) == m(of));
        let all = runs.iter().map(|(_, run)| *run).find(|run| run.method == ALL && bounds(run))?;
        let same = || {
            let alike = |run: &Run| m(run) == m(all) && run.passes == all.passes && run.gpu_ms_per_pass.is_some();
            runs.iter().filter(move |(_, run)| alike(run))
        };
        let clock = runs.iter().find_map(|(_, run)| run.saved.as_ref()?.clock).unwrap_or(Clock::Gpu);
        // Passes in live tiles are no whole ones.
        let whole = same().map(|(_, run)| *run).filter(|run| !run.draws_live_tiles());
        let (pass_ms, any_is_empty) = empty_pass(whole, clock)?;
        let rest = all.milliseconds(clock)? - f64::from(all.passes) * pass_ms;
        let segment_ms = rest.max(0.0) / all.fragments.main.max(1) as f64;
        let ms = ideal as f64 * segment_ms + f64::from(all.passes) * pass_ms;
        let distances =
            same().filter_map(|(label, run)| Some((label.clone(), run.milliseconds(clock)? / ms))).collect();
        let limit =
            Self { clock, ms, segments: ideal, segment_ms, passes: all.passes, pass_ms, any_is_empty, distances };
        (ms > 0.0).then_some(limit)
    }

    /// How it is found, and how far the runs are from it.
    pub fn words(&self) -> String {
        let pass = if self.any_is_empty { "an empty one" } else { "the shortest one, none being empty," };
        let distances: Vec<String> =
            self.distances.iter().map(|(label, times)| format!("{label} {times:.2}")).collect();
        format!(
            "the limit: {} segments at {:.0} ns, which one of {ALL} takes, and {} main passes at {} ms, which {pass} takes; frames take so \
             many times that: {}",
            self.segments,
            NANOSECONDS * self.segment_ms,
            self.passes,
            milliseconds(self.pass_ms),
            distances.join(", ")
        )
    }
}

/// Milliseconds by a clock of a main pass without fragments, the median of those of some runs, and true; else of the shortest. Passes are
/// timed by the device: by another clock each has its part of the frame.
fn empty_pass<'a>(runs: impl Iterator<Item = &'a Run>, clock: Clock) -> Option<(f64, bool)> {
    let passes = runs.flat_map(|run| {
        let device = run.milliseconds(Clock::Gpu).unwrap_or(f64::NAN);
        let scale = run.milliseconds(clock).unwrap_or(f64::NAN) / device;
        // Those behind the last one with fragments may not have been run: no ray was left.
        let fragments = &run.fragments.main_per_pass;
        let begun = fragments.iter().rposition(|count| *count > 0).map_or(0, |last| last + 1);
        let times = run.gpu_ms_per_pass.iter().flat_map(|times| &times.main).map(move |ms| ms * scale);
        times.zip(fragments.iter().copied()).take(begun)
    });
    let (mut empty, mut shortest) = (Vec::new(), f64::INFINITY);
    for (ms, fragments) in passes {
        shortest = shortest.min(ms);
        empty.extend((fragments == 0).then_some(ms));
    }
    empty.sort_by(f64::total_cmp);
    let median = empty.get(empty.len() / 2).map(|ms| (*ms, true));
    median.or_else(|| shortest.is_finite().then_some((shortest, false)))
}
