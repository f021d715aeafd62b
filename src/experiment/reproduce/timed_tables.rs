//! The tables of what was timed, for text and page: frame rates among the data sets, and early ray termination.

use super::rates::{RATE_BASE, RATE_SETS, RATE_SIZES, RENDERERS, RateSet, Renderer};
use super::rates_rows::{RateCell, RateLine, column_of, rate, rate_lines, rate_verdict};
use super::termination::{GainLine, PUBLISHED_GAIN, gain_lines, gain_verdict, signed_percent};
use super::{ReproducedSet, TimedRecord};
use crate::measure::record::Clock;
use crate::report::table::{Column, Table};

/// The titles of both.
pub const RATES_TITLE: &str = "Frame rates of the single pass";
pub const TERMINATION_TITLE: &str = "Early ray termination in the single pass";

fn ratio(ratio: Option<f64>) -> String {
    ratio.map_or_else(|| "-".to_owned(), |ratio| format!("{ratio:.2}"))
}

/// Frames per second with three digits where the paper has two or three, but never finer than a thousandth.
fn per_second(rate: f64) -> String {
    let decimals = match rate {
        rate if rate >= 10.0 => 1,
        rate if rate >= 1.0 => 2,
        _ => 3,
    };
    format!("{rate:.decimals$}")
}

/// Frames per second as the paper prints them.
fn published(rate: f64) -> String {
    format!("{rate:.1}")
}

/// Frames per second of every data set that was timed, in every viewport; none where no set was.
pub fn rates_table(timed: &TimedRecord) -> Option<(Table, Vec<String>)> {
    let lines = rate_lines(timed);
    lines.iter().flat_map(|line| &line.cells).find(|cell| cell.ours.is_some())?;
    let base = RATE_SETS[RATE_BASE].name;
    let clock = timed.clock.map_or("", clock_name);
    let mut columns = vec![Column::words("frames per second")];
    for renderer in RENDERERS {
        let method = renderer.method.name;
        let [paper, here, by_clock] = ["paper", "here", clock].map(|whose| format!("to {base}, {whose}"));
        let heads = ["paper", "here", &paper, &here, &by_clock, "over the sweep"].map(str::to_owned);
        columns.extend(heads.map(|second| Column { head: vec![method.to_owned(), second], right: true }));
    }
    let mut table = Table::new(columns);
    for line in lines.iter().filter(|line| is_present(timed, line.set)) {
        let cells = line.cells.iter().flat_map(rate_cells);
        table.row(std::iter::once(format!("{}, {}^2", line.set.name, line.size)).chain(cells));
    }
    Some((table, verdicts(&lines)))
}

fn rate_cells(cell: &RateCell) -> [String; 6] {
    [
        published(cell.theirs),
        cell.ours.map_or_else(|| "-".to_owned(), |rate| per_second(rate.average)),
        ratio(Some(cell.their_ratio)),
        ratio(cell.our_ratio),
        ratio(cell.clock_ratio),
        cell.sweep.map_or_else(|| "-".to_owned(), |[low, high]| format!("{low:.2} to {high:.2}")),
    ]
}

/// What the ratios of each renderer come to.
fn verdicts(lines: &[RateLine]) -> Vec<String> {
    let verdict = |(half, renderer): (usize, &Renderer)| {
        Some(format!("{} by {}: {}", renderer.name, renderer.method.name, rate_verdict(lines, half)?))
    };
    RENDERERS.iter().enumerate().filter_map(verdict).collect()
}

/// What a clock measures, in a word or two.
fn clock_name(clock: Clock) -> &'static str {
    match clock {
        Clock::Cpu => "CPU time",
        Clock::Gpu => "device time",
        Clock::Wall => "wall time",
    }
}

fn is_present(timed: &TimedRecord, set: &RateSet) -> bool {
    column_of(timed, set).is_some_and(|column| column.absent.is_none())
}

/// Data sets that were timed, each with its column.
pub fn present_rates(timed: &TimedRecord) -> impl Iterator<Item = (&'static RateSet, &ReproducedSet)> {
    let present = RATE_SETS.iter().filter(|set| is_present(timed, set));
    present.filter_map(|set| Some((set, column_of(timed, set)?)))
}

/// Each data set that was not timed in a line: why, and the rates of the paper.
pub fn absent_rates(timed: &TimedRecord) -> Vec<String> {
    let line = |set: &RateSet| {
        let why = column_of(timed, set)?.absent.as_ref()?;
        let halves = RENDERERS.iter().zip(set.theirs).map(|(renderer, rates)| {
            let rates = RATE_SIZES.iter().zip(rates).map(|(size, rate)| format!("{} at {size}^2", published(rate)));
            format!("{} {}", renderer.name, rates.collect::<Vec<_>>().join(", "))
        });
        let rates = halves.collect::<Vec<_>>().join("; ");
        Some(format!("{}: {why} ({}, frames per second: {rates})", set.name, set.source()))
    };
    RATE_SETS.iter().filter_map(line).collect()
}

/// Frames per second with each choice alone, in the smallest viewport that the paper has; none without a sweep.
pub fn rates_sweep(timed: &TimedRecord) -> Option<Table> {
    let (size, renderer) = (RATE_SIZES[0], &RENDERERS[0]);
    let columns: Vec<(&RateSet, &ReproducedSet)> = present_rates(timed).collect();
    let mut choices: Vec<(&str, &str)> = Vec::new();
    for variant in columns.iter().flat_map(|(_, column)| &column.variants) {
        let choice = (variant.choice.as_str(), variant.value.as_str());
        if !choices.contains(&choice) {
            choices.push(choice);
        }
    }
    let heads = columns.iter().map(|(set, _)| Column::numbers(set.name));
    let mut table = Table::new(std::iter::once(Column::words(format!("{size}^2"))).chain(heads).collect());
    for (choice, value) in choices.iter().copied() {
        let cells = columns.iter().map(|(_, column)| {
            let variant = column.variants.iter().find(|v| (v.choice.as_str(), v.value.as_str()) == (choice, value));
            let rate = variant.and_then(|variant| rate(variant, renderer, size, Clock::Wall));
            rate.map_or_else(|| "-".to_owned(), |r| per_second(r.average))
        });
        table.row(std::iter::once(format!("{choice}: {value}")).chain(cells));
    }
    (choices.len() > 1).then_some(table)
}

/// The gain of early ray termination by each transfer function, and what it comes to; none where nothing was timed.
pub fn gains_table(timed: &TimedRecord) -> Option<(Table, String)> {
    let lines = gain_lines(&timed.termination, timed.clock?);
    let verdict = gain_verdict(&lines)?;
    let numbers = ["directions", "least, %", "median, %", "greatest, %"].map(Column::numbers);
    let mut table = Table::new([Column::words("gain in frames per second")].into_iter().chain(numbers).collect());
    let [low, high] = PUBLISHED_GAIN.map(signed_percent);
    table.row(["paper, semi-transparent", "-", &low, "-", &high].map(str::to_owned));
    lines.iter().for_each(|line| table.row(gain_cells(line)));
    Some((table, verdict))
}

fn gain_cells(line: &GainLine) -> [String; 5] {
    let of = &line.statistics;
    let [least, median, greatest] = [of.min, of.median, of.max].map(signed_percent);
    [line.value.clone(), of.n.to_string(), least, median, greatest]
}
