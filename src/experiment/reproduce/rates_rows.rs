//! The rows of the frame rates: the paper's, ours, and the ratios of both among the data sets.

use super::rates::{RATE_BASE, RATE_SETS, RATE_SIZES, RENDERERS, RateSet, Renderer};
use super::rows::{Finding, judged, sweep};
use super::{ReproducedSet, TimedRecord, Variant};
use crate::measure::Run;
use crate::measure::record::Clock;

/// A data set in a viewport.
#[derive(Clone, Debug)]
pub struct RateLine {
    pub set: &'static RateSet,
    /// Side of the viewport, pixels.
    pub size: u32,
    /// By each of [`RENDERERS`].
    pub cells: Vec<RateCell>,
}

/// What one way of rendering comes to.
#[derive(Clone, Debug, PartialEq)]
pub struct RateCell {
    /// Frames per second in the paper.
    pub theirs: f64,
    /// Frames per second here, by the wall clock.
    pub ours: Option<Rate>,
    /// To the set [`RATE_BASE`] in the same viewport.
    pub their_ratio: f64,
    pub our_ratio: Option<f64>,
    /// The same by the clock that times are compared by on this device.
    pub clock_ratio: Option<f64>,
    /// Least and greatest `our_ratio` of all choices.
    pub sweep: Option<[f64; 2]>,
}

/// Frames per second over all directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rate {
    /// Of all frames together: their number divided by their time.
    pub average: f64,
    pub least: f64,
    pub greatest: f64,
}

impl Rate {
    /// Of frames that took so many milliseconds each; none without any, or where a time is none.
    pub fn of(milliseconds: &[f64]) -> Option<Self> {
        let shortest = milliseconds.iter().copied().reduce(f64::min).filter(|ms| *ms > 0.0)?;
        let longest = milliseconds.iter().copied().reduce(f64::max)?;
        let per_second = |ms: f64| MILLISECONDS / ms;
        let mean = milliseconds.iter().sum::<f64>() / milliseconds.len() as f64;
        Some(Self { average: per_second(mean), least: per_second(longest), greatest: per_second(shortest) })
    }
}

/// In a second.
const MILLISECONDS: f64 = 1000.0;

/// A line for each data set and viewport, in the order of the paper's table.
pub fn rate_lines(timed: &TimedRecord) -> Vec<RateLine> {
    let sizes = || RATE_SIZES.into_iter().enumerate();
    let line = |set: &'static RateSet, (place, size): (usize, u32)| {
        let cells = RENDERERS.iter().enumerate().map(|(half, renderer)| {
            let [theirs, base] = [set, &RATE_SETS[RATE_BASE]].map(|set| set.theirs[half][place]);
            cell(timed, set, renderer, size, [theirs, theirs / base])
        });
        RateLine { set, size, cells: cells.collect() }
    };
    RATE_SETS.iter().flat_map(|set| sizes().map(move |size| (set, size))).map(|(set, size)| line(set, size)).collect()
}

/// What a data set came to by one way of rendering, beside the paper's rate and ratio.
fn cell(
    timed: &TimedRecord,
    set: &RateSet,
    renderer: &Renderer,
    size: u32,
    [theirs, their_ratio]: [f64; 2],
) -> RateCell {
    let column = column_of(timed, set);
    let main = column.and_then(|column| column.variants.first());
    let ratio = |variant: &Variant, clock| rate_ratio(timed, variant, renderer, size, clock);
    RateCell {
        theirs,
        ours: main.and_then(|variant| rate(variant, renderer, size, Clock::Wall)),
        their_ratio,
        our_ratio: main.and_then(|variant| ratio(variant, Clock::Wall)),
        clock_ratio: main.and_then(|variant| ratio(variant, timed.clock?)),
        sweep: column.and_then(|column| sweep(column, |variant| ratio(variant, Clock::Wall))),
    }
}

/// What was timed of a data set.
pub fn column_of<'a>(timed: &'a TimedRecord, set: &RateSet) -> Option<&'a ReproducedSet> {
    timed.rates.iter().find(|column| column.name == set.name)
}

/// Frames per second to those of [`RATE_BASE`] with the same choice; none where that was not timed.
pub fn rate_ratio(timed: &TimedRecord, variant: &Variant, renderer: &Renderer, size: u32, clock: Clock) -> Option<f64> {
    let average = |variant| rate(variant, renderer, size, clock).map(|rate| rate.average);
    let base = &column_of(timed, &RATE_SETS[RATE_BASE])?.variants;
    let same = base.iter().find(|other| (&other.choice, &other.value) == (&variant.choice, &variant.value));
    Some(average(variant)? / average(same?)?)
}

/// Frames per second of a variant by one way of rendering in one viewport; none where it was not timed.
pub fn rate(variant: &Variant, renderer: &Renderer, size: u32, clock: Clock) -> Option<Rate> {
    let of = |run: &&Run| run.method == renderer.method.name && run.settings.image.size == [size; 2];
    let times: Option<Vec<f64>> = variant.runs.iter().filter(of).map(|run| run.milliseconds(clock)).collect();
    Rate::of(&times?)
}

/// What the ratios of one way of rendering, by its place in [`RENDERERS`], come to; none without any of ours.
pub fn rate_verdict(lines: &[RateLine], half: usize) -> Option<String> {
    let base = RATE_SETS[RATE_BASE].name;
    let findings = lines.iter().filter(|line| line.set.name != base).filter_map(|line| {
        let cell = line.cells.get(half)?;
        let name = format!("{} {}^2", line.set.name, line.size);
        Some(Finding { name, theirs: cell.their_ratio, ours: cell.our_ratio?, sweep: cell.sweep })
    });
    judged(findings, &format!("{base}'s frames per second"))
}
