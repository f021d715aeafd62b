//! The comparison as plain text.

use std::fmt::Write;

use super::embedded::Geometry;
use super::embedded_rows::{EmbeddedLine, embedded_lines, embedded_verdict};
use super::papers::{DATA_SETS, DataSet, OPEN};
use super::rates::{RATE_TABLES, absent_rates, rate_remarks, rates_sweep, rates_table};
use super::rows::{lines, verdict};
use super::stated::{STATED_TITLE, stated_table};
use super::termination_table::{TERMINATION_TITLE, gains_table};
use super::{FragmentLine, ReproducedSet, Reproduction, TimedRecord};
use crate::report::number::thousands;
use crate::report::table::{Column, Table, TextLayout};

/// The two passes, by what a table of the thesis counts.
pub const KINDS: [(&str, bool); 2] = [("main", true), ("intermediate", false)];

pub fn percent(ratio: Option<f64>) -> String {
    ratio.map_or_else(|| "-".to_owned(), |ratio| format!("{:.1}", 100.0 * ratio))
}

fn number(count: Option<u64>) -> String {
    count.map_or_else(|| "-".to_owned(), thousands)
}

fn range(sweep: Option<[f64; 2]>) -> String {
    sweep.map_or_else(|| "-".to_owned(), |[low, high]| format!("{:.1} to {:.1}", 100.0 * low, 100.0 * high))
}

/// Main or intermediate fragments, a row each.
fn table(lines: &[FragmentLine]) -> Table {
    let numbers = ["thesis", "% of block", "here", "% of block", "over the sweep"].map(Column::numbers);
    let mut table = Table::new([Column::words("")].into_iter().chain(numbers).collect());
    for line in lines {
        table.row([
            line.row.name().to_owned(),
            number(line.theirs),
            percent(line.their_ratio),
            number(line.ours),
            percent(line.our_ratio),
            range(line.sweep),
        ]);
    }
    table
}

/// Main or intermediate fragments with polygons and without, a row each.
fn embedded_table(geometry: &Geometry, lines: &[EmbeddedLine]) -> Table {
    let parts = 0..geometry.parts as usize;
    let heads = ["with, sum", "% of without", "over the sweep", "% of early z"].map(Column::numbers);
    let layers = parts.clone().map(|i| Column::numbers(format!("layer {i}")));
    let first = [Column::words(""), Column::numbers("without")];
    let mut table = Table::new(first.into_iter().chain(layers).chain(heads).collect());
    for line in lines {
        let name = if line.row.is_none() { format!("{} (thesis)", line.name) } else { line.name.to_owned() };
        let layers = parts.clone().map(|i| number(line.parts.get(i).copied()));
        let sums = [number(line.with), percent(line.ratio), range(line.sweep), percent(line.share)];
        table.row([name, number(line.without)].into_iter().chain(layers).chain(sums));
    }
    table
}

/// A table of a data set with what its ratios come to; none where nothing is counted for it.
pub fn kind_of_fragments(set: &DataSet, column: &ReproducedSet, main: bool) -> Option<(Table, Option<String>)> {
    if let Some(geometry) = &set.geometry {
        let lines = embedded_lines(geometry, column, main);
        return (!lines.is_empty()).then(|| (embedded_table(geometry, &lines), embedded_verdict(&lines)));
    }
    let lines = lines(set, column, main);
    (!lines.is_empty()).then(|| (table(&lines), verdict(&lines)))
}

/// Data sets that were counted, each with its column.
pub fn present(found: &Reproduction) -> impl Iterator<Item = (&'static DataSet, &ReproducedSet)> {
    DATA_SETS.iter().zip(&found.columns).filter(|(_, column)| column.absent.is_none())
}

/// Each data set that was not counted in a line: why, and what the thesis counted for it.
pub fn absent(found: &Reproduction) -> Vec<String> {
    let line = |(set, column): (&DataSet, &ReproducedSet)| {
        let why = column.absent.as_ref()?;
        let pair = |name: &str, main, intermediate| format!("{name} {} / {}", thousands(main), thousands(intermediate));
        let counts = set.rows.iter().map(|row| pair(row.row.name(), row.main, row.intermediate));
        let embedded = set.geometry.iter().flat_map(|geometry| geometry.rows).filter_map(|row| {
            let [[main, intermediate], [main_with, intermediate_with]] = row.theirs.map(|t| [t.without, t.with])?;
            let with = pair("with geometry", main_with, intermediate_with);
            Some(format!("{}, {with}", pair(row.name, main, intermediate)))
        });
        let counts: Vec<String> = counts.chain(embedded).collect();
        let theirs = match counts.is_empty() {
            true => set.source.to_owned(),
            false => format!("{}, main / intermediate: {}", set.source, counts.join(", ")),
        };
        Some(format!("{}: {why} ({theirs})", set.name))
    };
    DATA_SETS.iter().zip(&found.columns).filter_map(line).collect()
}

/// Columns of all tables stand below each other.
const WIDTHS: [usize; 7] = [23, 11, 10, 11, 10, 16, 10];

/// All tables, the verdicts, what is absent, and what was left open.
pub fn text(found: &Reproduction) -> String {
    let layout = TextLayout { indent: 4, gap: 1, least: WIDTHS.to_vec(), rule: false };
    let mut out = String::new();
    for (set, column) in present(found) {
        // Writing to a String cannot fail.
        let _ = writeln!(out, "{} ({})", set.name, set.source);
        if let Some(remark) = set.remark {
            let _ = writeln!(out, "  {remark}");
        }
        for (kind, main) in KINDS {
            let Some((table, verdict)) = kind_of_fragments(set, column, main) else { continue };
            let _ = writeln!(out, "  {kind} fragments");
            out += &table.text(&layout);
            if let Some(verdict) = verdict {
                let _ = writeln!(out, "    {verdict}");
            }
        }
        out.push('\n');
    }
    found.timed.iter().for_each(|timed| out += &timed_text(timed));
    let clock = found.timed.as_ref().and_then(|timed| timed.clock);
    if let Some(table) = found.stated.as_ref().and_then(|stated| stated_table(stated, clock)) {
        let layout = TextLayout { indent: 4, ..TextLayout::default() };
        let _ = writeln!(out, "{STATED_TITLE}\n{}", table.text(&layout));
    }
    let absent: Vec<String> = absent(found).into_iter().chain(found.timed.iter().flat_map(absent_rates)).collect();
    if !absent.is_empty() {
        let _ = writeln!(out, "Absent\n  {}\n", absent.join("\n  "));
    }
    for (paper, open) in open_choices(found) {
        let _ = writeln!(out, "What {paper} leaves open");
        for (what, choice) in open {
            let _ = writeln!(out, "  {what}: {choice}.");
        }
    }
    out
}

/// What each paper leaves open of the tables that are shown.
pub fn open_choices(
    found: &Reproduction,
) -> impl Iterator<Item = (&'static str, &'static [(&'static str, &'static str)])> {
    let timed = found.timed.iter().flat_map(|_| RATE_TABLES).map(|table| (table.paper, table.open));
    std::iter::once(("the thesis", &OPEN[..])).chain(timed)
}

/// The tables of what was timed.
fn timed_text(timed: &TimedRecord) -> String {
    let layout = TextLayout { indent: 4, ..TextLayout::default() };
    let mut out = String::new();
    for rates in RATE_TABLES {
        let Some((table, said)) = rates_table(timed, rates) else { continue };
        let _ = writeln!(out, "{} ({}, Table 1)", rates.title, rates.paper);
        rate_remarks(timed, rates).iter().for_each(|remark| out += &format!("  {remark}\n"));
        out += &table.text(&layout);
        said.iter().for_each(|said| out += &format!("    {said}\n"));
        if let Some(sweep) = rates_sweep(timed, rates) {
            let _ = writeln!(out, "  each choice alone: frames per second");
            out += &sweep.text(&layout);
        }
        out.push('\n');
    }
    if let Some((table, verdict)) = gains_table(timed) {
        let _ = writeln!(out, "{TERMINATION_TITLE} (Stegmaier05 §7)");
        out += &table.text(&layout);
        let _ = writeln!(out, "    {verdict}\n");
    }
    out
}
