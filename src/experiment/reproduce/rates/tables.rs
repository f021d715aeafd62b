//! A table of frame rates for text and page.

use super::super::{ReproducedSet, TimedRecord};
use super::rows::column_of;
use super::{RATE_TABLES, RateLine, RateRatio, RateSet, RateTable, explained, rate, rate_lines, rate_verdicts};
use crate::measure::Run;
use crate::measure::fragment_kind::FragmentKind;
use crate::measure::notes::triangles_in;
use crate::measure::record::Clock;
use crate::report::number::thousands;
use crate::report::table::{Column, Table};

/// What stands for a number that is not there.
const NONE: &str = "-";

fn or_none(text: Option<String>) -> String {
    text.unwrap_or_else(|| NONE.to_owned())
}

fn ratio(ratio: Option<f64>) -> String {
    or_none(ratio.map(|ratio| format!("{ratio:.2}")))
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

/// Frames per second as the papers print them.
fn published(rate: f64) -> String {
    format!("{rate:.1}")
}

/// Frames per second of every data set of a table that was timed, in every viewport, and what they come to; none where no set
/// was.
pub fn rates_table(timed: &TimedRecord, table: &'static RateTable) -> Option<(Table, Vec<String>)> {
    let lines = rate_lines(timed, table);
    lines.iter().find(|line| line.ours.is_some())?;
    let mut columns = vec![Column::words("frames per second"), Column::words("method")];
    columns.extend(["paper", "here", "slowest", "fastest"].map(Column::numbers));
    let told_in = table.told_in().map(|base| base.name);
    for base in told_in.into_iter().chain([table.base_renderer().name]) {
        let clock = timed.clock.map_or("", clock_name);
        let heads = ["paper", "here", clock, "over the sweep"].map(str::to_owned);
        columns.extend(heads.map(|second| Column { head: vec![format!("to {base}"), second], right: true }));
    }
    columns.extend(["main fragments", "intermediate"].map(Column::numbers));
    let mut shown = Table::new(columns);
    for line in lines.iter().filter(|line| is_present(timed, table, line.set)) {
        shown.row(cells(line));
    }
    let kinds = table.renderers.iter().filter_map(|renderer| {
        let words = FragmentKind::of(renderer.method.name)?.words()?;
        Some(format!("{}: {words}.", renderer.name))
    });
    let said = rate_verdicts(table, &lines).into_iter().chain(kinds).chain(explained(table, &lines));
    Some((shown, said.collect()))
}

/// The cells of a line.
fn cells(line: &RateLine) -> Vec<String> {
    let ours = |rate: fn(&super::Rate) -> f64| or_none(line.ours.as_ref().map(rate).map(per_second));
    let name = format!("{}, {}^2, {}", line.set.name, line.size, line.renderer.name);
    let mut cells = vec![name, line.renderer.method.name.to_owned(), or_none(line.theirs.map(published))];
    cells.extend([ours(|rate| rate.average), ours(|rate| rate.least), ours(|rate| rate.greatest)]);
    cells.extend(line.to_set.iter().chain([&line.to_renderer]).flat_map(ratio_cells));
    let counts = line.fragments.map(|counts| counts.map(|count| thousands(count.round() as u64)));
    cells.extend(counts.unwrap_or_else(|| [NONE; 2].map(str::to_owned)));
    cells
}

fn ratio_cells(of: &RateRatio) -> [String; 4] {
    let sweep = of.sweep.map(|[low, high]| format!("{low:.2} to {high:.2}"));
    [ratio(of.theirs), ratio(of.ours), ratio(of.clock), or_none(sweep)]
}

/// What a clock measures, in a word or two.
fn clock_name(clock: Clock) -> &'static str {
    match clock {
        Clock::Cpu => "CPU time",
        Clock::Gpu => "device time",
        Clock::Wall => "wall time",
    }
}

fn is_present(timed: &TimedRecord, table: &RateTable, set: &RateSet) -> bool {
    column_of(timed, table, set).is_some_and(|column| column.absent.is_none())
}

/// What is to be said of a table's sets: of shells the polygons that were drawn as well, in the main configuration and over the sweep.
pub fn rate_remarks(timed: &TimedRecord, table: &'static RateTable) -> Vec<String> {
    let of = |(set, found): (&RateSet, &ReproducedSet)| {
        let drawn = |run: &Run| run.notes.iter().find_map(|note| triangles_in(note));
        let all: Vec<u64> = found.variants.iter().flat_map(|variant| variant.runs.iter().filter_map(drawn)).collect();
        let polygons = all.first().map(|main| {
            let [least, most] = [all.iter().min(), all.iter().max()].map(|n| thousands(*n.unwrap_or(main)));
            let swept = (found.variants.len() > 1).then(|| format!(", over the sweep {least} to {most}"));
            format!("here {} triangles{}", thousands(*main), swept.unwrap_or_default())
        });
        let said: Vec<String> = set.remark.map(str::to_owned).into_iter().chain(polygons).collect();
        (!said.is_empty()).then(|| format!("{}: {}", set.name, said.join("; ")))
    };
    present_rates(timed, table).filter_map(of).collect()
}

/// Data sets of a table that were timed, each with its column.
pub fn present_rates<'a>(
    timed: &'a TimedRecord,
    table: &'static RateTable,
) -> impl Iterator<Item = (&'static RateSet, &'a ReproducedSet)> {
    let present = table.sets.iter().filter(move |set| is_present(timed, table, set));
    present.filter_map(move |set| Some((set, column_of(timed, table, set)?)))
}

/// Each data set that was not timed in a line: why, and the rates of the paper.
pub fn absent_rates(timed: &TimedRecord) -> Vec<String> {
    let line = |table: &RateTable, set: &RateSet| {
        let why = column_of(timed, table, set)?.absent.as_ref()?;
        let by_renderer = table.renderers.iter().zip(set.theirs).filter(|(_, rates)| !rates.is_empty());
        let rates = by_renderer.map(|(renderer, rates)| {
            let rates = table.sizes.iter().zip(*rates);
            let rates = rates.map(|(size, rate)| format!("{} at {size}^2", published(*rate)));
            format!("{} {}", renderer.name, rates.collect::<Vec<_>>().join(", "))
        });
        let rates = rates.collect::<Vec<_>>().join("; ");
        Some(format!("{}: {why} ({}, frames per second: {rates})", set.name, table.source(set)))
    };
    RATE_TABLES.into_iter().flat_map(|table| table.sets.iter().filter_map(move |set| line(table, set))).collect()
}

/// Frames per second by each renderer with each choice alone, in the smallest viewport that the paper has; none without a sweep.
pub fn rates_sweep(timed: &TimedRecord, table: &'static RateTable) -> Option<Table> {
    let size = *table.sizes.first()?;
    let columns: Vec<(&RateSet, &ReproducedSet)> = present_rates(timed, table).collect();
    let mut choices: Vec<(&str, &str)> = Vec::new();
    for variant in columns.iter().flat_map(|(_, column)| &column.variants) {
        let choice = (variant.choice.as_str(), variant.value.as_str());
        if !choices.contains(&choice) {
            choices.push(choice);
        }
    }
    let heads = columns.iter().map(|(set, _)| Column::numbers(set.name));
    let first = [Column::words(format!("{size}^2")), Column::words("")];
    let mut shown = Table::new(first.into_iter().chain(heads).collect());
    for ((choice, value), renderer) in
        choices.iter().flat_map(|choice| table.renderers.iter().map(move |renderer| (*choice, renderer)))
    {
        let cells = columns.iter().map(|(_, column)| {
            let variant = column.variants.iter().find(|v| (v.choice.as_str(), v.value.as_str()) == (choice, value));
            let rate = variant.and_then(|variant| rate(variant, renderer, size, Clock::Wall));
            or_none(rate.map(|rate| per_second(rate.average)))
        });
        shown.row([format!("{choice}: {value}"), renderer.name.to_owned()].into_iter().chain(cells));
    }
    (choices.len() > 1).then_some(shown)
}
