//! The comparison as CSV.

use super::embedded_rows::{EmbeddedLine, embedded_lines, embedded_ratio};
use super::papers::{DATA_SETS, DataSet};
use super::rows::{FragmentLine, lines, ratio};
use super::text::KINDS;
use super::{ReproducedSet, Reproduction, Variant};
use crate::error::Result;
use crate::report::table::{Column, Table};

/// What all lines of a table have, and what each has of its own.
#[derive(Clone, Default)]
struct CsvLine {
    row: String,
    fragments: &'static str,
    choice: String,
    value: String,
    theirs: Option<u64>,
    their_ratio: Option<f64>,
    ours: Option<u64>,
    our_ratio: Option<f64>,
    geometry: &'static str,
    layer: String,
}

/// The fields of a line.
const HEAD: [&str; 13] = [
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
    "geometry",
    "layer",
];

/// One line for each number: `set`, `source`, `file`, `row`, `fragments` (main or intermediate), `choice`, `value`,
/// `thesis`, `thesis_ratio`, `ours`, `ours_ratio`, and of the tables with polygons `geometry` (`with`, `without`) and `layer`
/// (0 from the front; empty for their sum), where the thesis' counts have lines of their own; empty fields where there is
/// none. Ratios are to block skipping, with `geometry` those of the sum to the fragments without.
///
/// # Errors
/// When a row cannot be written, which only a fault of this program explains.
pub fn csv(found: &Reproduction) -> Result<String> {
    let mut table = Table::new(HEAD.map(Column::words).to_vec());
    for (set, column) in DATA_SETS.iter().zip(&found.columns) {
        for (kind, main) in KINDS {
            let lines = match &set.geometry {
                Some(geometry) => {
                    let lines = embedded_lines(geometry, column, main);
                    lines.iter().flat_map(|line| embedded(line, column, main)).collect::<Vec<_>>()
                }
                None => lines(set, column, main).iter().flat_map(|line| plain(line, column, main)).collect(),
            };
            lines.into_iter().for_each(|line| put(&mut table, set, column, CsvLine { fragments: kind, ..line }));
        }
    }
    table.csv()
}

fn put(table: &mut Table, set: &DataSet, column: &ReproducedSet, line: CsvLine) {
    let count = |number: Option<u64>| number.map_or_else(String::new, |n| n.to_string());
    let ratio = |ratio: Option<f64>| ratio.map_or_else(String::new, |r| format!("{r:.6}"));
    table.row([
        set.name.to_owned(),
        set.source.to_owned(),
        column.file.clone().unwrap_or_default(),
        line.row,
        line.fragments.to_owned(),
        line.choice,
        line.value,
        count(line.theirs),
        ratio(line.their_ratio),
        count(line.ours),
        ratio(line.our_ratio),
        line.geometry.to_owned(),
        line.layer,
    ]);
}

/// `line` once in the main configuration, and with the ratio of each other choice.
fn of_each_choice(line: CsvLine, column: &ReproducedSet, ratio: impl Fn(&Variant) -> Option<f64>) -> Vec<CsvLine> {
    let Some((base, others)) = column.variants.split_first() else { return vec![line] };
    let other = |variant: &Variant| CsvLine { ours: None, our_ratio: ratio(variant), ..line.clone() }.of(variant);
    std::iter::once(line.clone().of(base)).chain(others.iter().map(other)).collect()
}

impl CsvLine {
    /// With the choice of a variant.
    fn of(self, variant: &Variant) -> Self {
        Self { choice: variant.choice.clone(), value: variant.value.clone(), ..self }
    }
}

/// A line of a table without polygons.
fn plain(line: &FragmentLine, column: &ReproducedSet, main: bool) -> Vec<CsvLine> {
    let whole = CsvLine {
        row: line.row.name().to_owned(),
        theirs: line.theirs,
        their_ratio: line.their_ratio,
        ours: line.ours,
        our_ratio: line.our_ratio,
        ..CsvLine::default()
    };
    of_each_choice(whole, column, |variant| ratio(variant, line.row, main))
}

/// A line of a table with polygons: without them, of each layer, and the sum.
fn embedded(line: &EmbeddedLine, column: &ReproducedSet, main: bool) -> Vec<CsvLine> {
    let of = |count: Option<u64>, ratio: Option<f64>, geometry: &'static str, layer: String| {
        let whole = CsvLine { row: line.name.to_owned(), geometry, layer, ..CsvLine::default() };
        match (line.row, column.variants.first()) {
            (Some(_), Some(base)) => CsvLine { ours: count, our_ratio: ratio, ..whole }.of(base),
            _ => CsvLine { theirs: count, their_ratio: ratio, ..whole },
        }
    };
    let without = of(line.without, None, "without", String::new());
    let layers = line.parts.iter().enumerate().map(|(i, count)| of(Some(*count), None, "with", i.to_string()));
    let sum = of(line.with, line.ratio, "with", String::new());
    let sums = match line.row {
        Some(row) => of_each_choice(sum, column, |variant| embedded_ratio(variant, row, main)),
        None => vec![sum],
    };
    std::iter::once(without).chain(layers).chain(sums).collect()
}
