//! The table of early ray termination for text and page.

use super::TimedRecord;
use super::termination::{GainLine, PUBLISHED_GAIN, gain_lines, gain_verdict, signed_percent};
use crate::report::table::{Column, Table};

/// The title of that table.
pub const TERMINATION_TITLE: &str = "Early ray termination in the single pass";

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
