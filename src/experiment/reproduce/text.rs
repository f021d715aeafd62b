//! The comparison as plain text and as CSV.

use std::fmt::Write;

use super::papers::{DATA_SETS, DataSet, OPEN, Published};
use super::rows::{lines, ratio, verdict};
use super::{FragmentLine, ReproducedSet, Reproduction};
use crate::error::Result;
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
pub fn table(lines: &[FragmentLine]) -> Table {
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

/// Data sets that were counted, each with its column.
pub fn present(found: &Reproduction) -> impl Iterator<Item = (&'static DataSet, &ReproducedSet)> {
    DATA_SETS.iter().zip(&found.columns).filter(|(_, column)| column.absent.is_none())
}

/// Each data set that was not counted in a line: why, and what the thesis counted for it.
pub fn absent(found: &Reproduction) -> Vec<String> {
    let line = |(set, column): (&DataSet, &ReproducedSet)| {
        let why = column.absent.as_ref()?;
        let count =
            |row: &Published| format!("{} {} / {}", row.row.name(), thousands(row.main), thousands(row.intermediate));
        let counts: Vec<String> = set.rows.iter().map(count).collect();
        let theirs = match counts.is_empty() {
            true => set.source.to_owned(),
            false => format!("{}, main / intermediate: {}", set.source, counts.join(", ")),
        };
        Some(format!("{}: {why} ({theirs})", set.name))
    };
    DATA_SETS.iter().zip(&found.columns).filter_map(line).collect()
}

/// Columns of all tables stand below each other.
const WIDTHS: [usize; 6] = [23, 11, 10, 11, 10, 16];

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
            let lines = lines(set, column, main);
            if lines.is_empty() {
                continue;
            }
            let _ = writeln!(out, "  {kind} fragments");
            out += &table(&lines).text(&layout);
            if let Some(verdict) = verdict(&lines) {
                let _ = writeln!(out, "    {verdict}");
            }
        }
        out.push('\n');
    }
    let absent = absent(found);
    if !absent.is_empty() {
        let _ = writeln!(out, "Absent\n  {}\n", absent.join("\n  "));
    }
    out += "What the thesis leaves open\n";
    for (what, choice) in OPEN {
        let _ = writeln!(out, "  {what}: {choice}.");
    }
    out
}

/// One line for each number: `set`, `source`, `file`, `row`, `fragments` (main or intermediate), `choice`, `value`,
/// `thesis`, `thesis_ratio`, `ours`, `ours_ratio`; empty fields where there is none.
///
/// # Errors
/// When a row cannot be written, which only a fault of this program explains.
pub fn csv(found: &Reproduction) -> Result<String> {
    let head = [
        "set",
        "source",
        "file",
        "row",
        "fragments",
        "choice",
        "value",
        "thesis",
        "thesis_ratio",
        "ours",
        "ours_ratio",
    ];
    let mut table = Table::new(head.map(Column::words).to_vec());
    let or_empty = |number: Option<String>| number.unwrap_or_default();
    for (set, column) in DATA_SETS.iter().zip(&found.columns) {
        for (kind, main) in KINDS {
            for line in lines(set, column, main) {
                let mut put = |choice: &str, value: &str, ours: Option<u64>, our_ratio: Option<f64>| {
                    table.row([
                        set.name.to_owned(),
                        set.source.to_owned(),
                        column.file.clone().unwrap_or_default(),
                        line.row.name().to_owned(),
                        kind.to_owned(),
                        choice.to_owned(),
                        value.to_owned(),
                        or_empty(line.theirs.map(|n| n.to_string())),
                        or_empty(line.their_ratio.map(|r| format!("{r:.6}"))),
                        or_empty(ours.map(|n| n.to_string())),
                        or_empty(our_ratio.map(|r| format!("{r:.6}"))),
                    ]);
                };
                match column.variants.as_slice() {
                    [] => put("", "", None, None),
                    [base, others @ ..] => {
                        put(&base.choice, &base.value, line.ours, line.our_ratio);
                        for variant in others {
                            let ratio = ratio(variant, line.row, main);
                            put(&variant.choice, &variant.value, None, ratio);
                        }
                    }
                }
            }
        }
    }
    table.csv()
}
