//! The comparison as plain text and as CSV.

use std::fmt::Write;

use super::papers::{DATA_SETS, OPEN};
use super::rows::{lines, ratio, verdict};
use super::{FragmentLine, Reproduction};
use crate::error::{Error, Result};
use crate::report::number::thousands;

/// The two passes, by what a table of the thesis counts.
pub const KINDS: [(&str, bool); 2] = [("main", true), ("intermediate", false)];

pub fn percent(ratio: Option<f64>) -> String {
    ratio.map_or_else(|| "-".to_owned(), |ratio| format!("{:.1}", 100.0 * ratio))
}

pub fn number(count: Option<u64>) -> String {
    count.map_or_else(|| "-".to_owned(), thousands)
}

pub fn range(sweep: Option<[f64; 2]>) -> String {
    sweep.map_or_else(|| "-".to_owned(), |[low, high]| format!("{:.1} to {:.1}", 100.0 * low, 100.0 * high))
}

/// A line's cells, after its name.
pub fn cells(line: &FragmentLine) -> [String; 5] {
    [number(line.theirs), percent(line.their_ratio), number(line.ours), percent(line.our_ratio), range(line.sweep)]
}

pub const HEAD: [&str; 6] = ["", "thesis", "% of block", "here", "% of block", "over the sweep"];

/// All tables, the verdicts, and what was left open.
pub fn text(found: &Reproduction) -> String {
    let mut out = String::new();
    for (set, column) in DATA_SETS.iter().zip(&found.columns) {
        // Writing to a String cannot fail.
        let _ = writeln!(out, "{} ({})", set.name, set.source);
        if let Some(remark) = set.remark {
            let _ = writeln!(out, "  {remark}");
        }
        if let Some(absent) = &column.absent {
            let _ = writeln!(out, "  absent: {absent}");
        }
        for (kind, main) in KINDS {
            let lines = lines(set, column, main);
            if lines.is_empty() {
                continue;
            }
            let _ = writeln!(out, "  {kind} fragments");
            let rows: Vec<[String; 6]> = lines
                .iter()
                .map(|line| {
                    let [a, b, c, d, e] = cells(line);
                    [line.row.name().to_owned(), a, b, c, d, e]
                })
                .collect();
            for row in std::iter::once(&HEAD.map(str::to_owned)).chain(&rows) {
                let [name, a, b, c, d, e] = row;
                let _ = writeln!(out, "    {name:<23} {a:>11} {b:>10} {c:>11} {d:>10} {e:>16}");
            }
            if let Some(verdict) = verdict(&lines) {
                let _ = writeln!(out, "    {verdict}");
            }
        }
        out.push('\n');
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
    let failed = |e: csv::Error| Error::output("CSV", format!("cannot be written ({e})"), "use the JSON file instead");
    let mut writer = csv::Writer::from_writer(Vec::new());
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
    writer.write_record(head).map_err(failed)?;
    let or_empty = |number: Option<String>| number.unwrap_or_default();
    for (set, column) in DATA_SETS.iter().zip(&found.columns) {
        for (kind, main) in KINDS {
            for line in lines(set, column, main) {
                let mut put = |choice: &str, value: &str, ours: Option<u64>, our_ratio: Option<f64>| {
                    writer.write_record([
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
                    ])
                };
                match column.variants.as_slice() {
                    [] => put("", "", None, None).map_err(failed)?,
                    [base, others @ ..] => {
                        put(&base.choice, &base.value, line.ours, line.our_ratio).map_err(failed)?;
                        for variant in others {
                            let ratio = ratio(variant, line.row, main);
                            put(&variant.choice, &variant.value, None, ratio).map_err(failed)?;
                        }
                    }
                }
            }
        }
    }
    let bytes = writer.into_inner().map_err(|e| failed(e.into_error().into()))?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}
