//! The comparison as plain text, after the tables of [Thesis §5.6]: rows are methods, numbers stand right.

use std::fmt::Write;

use crate::experiment::orbit::Summary;
use crate::measure::Run;
use crate::report::comparison::{COLUMNS, Cell, Grid, RunGroup, groups, label, note_mark};
use crate::report::cost::{Sweep, extra_fetches, least_cost};

/// One table a scene, with its footnotes; empty where there are no runs.
pub fn table(runs: &[Run]) -> String {
    let groups = groups(runs);
    let shown = groups.iter().filter(|group| extra_fetches(group) == least_cost(group, &groups));
    let text = |group: &RunGroup| {
        let sweep = Sweep::of(group, &groups).map(|sweep| cost_table(&sweep)).unwrap_or_default();
        group_table(group) + &sweep
    };
    shown.map(text).collect::<Vec<_>>().join("\n")
}

/// Times by the cost of a sample.
fn cost_table(sweep: &Sweep) -> String {
    let rows: Vec<Vec<String>> = std::iter::once(sweep.head()).chain(sweep.table()).collect();
    let width = |c: usize| rows.iter().map(|row| row[c].chars().count()).max().unwrap_or(0);
    let mut out = "\nTime by the cost of a sample, rc-ert = 1\n".to_owned();
    for row in &rows {
        let cells: Vec<String> = row
            .iter()
            .enumerate()
            .map(|(c, text)| {
                let w = width(c);
                if c == 0 || c + 1 == row.len() { format!("{text:<w$}") } else { format!("{text:>w$}") }
            })
            .collect();
        // Writing to a String cannot fail.
        let _ = writeln!(out, "{}", cells.join("  ").trim_end());
    }
    out
}

fn group_table(group: &RunGroup) -> String {
    let grid = Grid::of(group);
    // Where a cell of a column of numbers has a mark, the others leave room for it: digits stay below digits.
    let room: Vec<usize> = (0..COLUMNS.len())
        .map(|c| if COLUMNS[c].right { grid.rows.iter().map(|row| mark(&row[c]).len()).max().unwrap_or(0) } else { 0 })
        .collect();
    let text = |(cell, room): (&Cell, &usize)| format!("{}{:<room$}", cell.text, mark(cell));
    let rows: Vec<Vec<String>> = grid.rows.iter().map(|row| row.iter().zip(&room).map(text).collect()).collect();
    let width = |c: usize| {
        let head = COLUMNS[c].head.iter().map(|h| h.len());
        head.chain(rows.iter().map(|row| row[c].chars().count())).max().unwrap_or(0)
    };
    let widths: Vec<usize> = (0..COLUMNS.len()).map(width).collect();
    let line = |cells: &[&str]| {
        let padded: Vec<String> = cells
            .iter()
            .zip(COLUMNS.iter().zip(&widths))
            .map(|(text, (column, &w))| if column.right { format!("{text:>w$}") } else { format!("{text:<w$}") })
            .collect();
        format!("{}\n", padded.join("  ").trim_end())
    };

    let run = group.first();
    let between = if run.driver.is_empty() { "" } else { ", " };
    let mut out = format!("{}\n{}\n{}{between}{}\n\n", run.scene, group.subtitle(), run.device, run.driver);
    out += &line(&COLUMNS.map(|c| c.head[0]));
    out += &line(&COLUMNS.map(|c| c.head[1]));
    out += &format!("{}\n", "-".repeat(widths.iter().sum::<usize>() + 2 * (widths.len() - 1)));
    for row in &rows {
        out += &line(&row.iter().map(String::as_str).collect::<Vec<_>>());
    }
    for (i, note) in grid.notes.iter().enumerate() {
        // Writing to a String cannot fail.
        let _ = writeln!(out, "({}) {note}", note_mark(i));
    }
    let orbits: Vec<String> = group.runs.iter().filter_map(|(_, run)| orbit_line(run)).collect();
    if !orbits.is_empty() {
        let _ = writeln!(out, "\nOrbit, medians of a frame\n{}", orbits.join("\n"));
    }
    out
}

/// What an orbit was like, in a line.
fn orbit_line(run: &Run) -> Option<String> {
    let summary = Summary::of(run.orbit.as_deref()?)?;
    Some(format!("{:<21} {}", label(run), summary.words()))
}

/// ` (a)`, or nothing.
fn mark(cell: &Cell) -> String {
    cell.note.map(|note| format!(" ({})", note_mark(note))).unwrap_or_default()
}
