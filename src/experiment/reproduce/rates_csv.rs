//! The frame rates as CSV.

use super::rates::{RENDERERS, Renderer};
use super::rates_rows::{column_of, rate, rate_lines, rate_ratio};
use super::{Reproduction, TimedRecord, Variant};
use crate::error::Result;
use crate::measure::record::Clock;
use crate::report::table::{Column, Table};

/// The fields of a line.
const HEAD: [&str; 15] = [
    "set",
    "source",
    "file",
    "renderer",
    "method",
    "size",
    "choice",
    "value",
    "paper_fps",
    "paper_ratio",
    "clock",
    "fps",
    "fps_least",
    "fps_greatest",
    "ratio",
];

/// The clocks a frame was timed by.
const CLOCKS: [(&str, Clock); 3] = [("wall", Clock::Wall), ("cpu", Clock::Cpu), ("gpu", Clock::Gpu)];

/// Of each data set, renderer and viewport a line with the paper's frames per second, and one of ours for each clock in the
/// main configuration and with each choice made otherwise: over all directions, with those of the slowest and of the fastest
/// one; `ratio` and `paper_ratio` are to the engine. Empty fields where there is none.
///
/// # Errors
/// When a row cannot be written, which only a fault of this program explains.
pub fn rates_csv(found: &Reproduction) -> Result<String> {
    let mut table = Table::new(HEAD.map(Column::words).to_vec());
    let Some(timed) = &found.timed else { return table.csv() };
    for line in rate_lines(timed) {
        let column = column_of(timed, line.set);
        let file = column.and_then(|column| column.file.clone()).unwrap_or_default();
        for (renderer, cell) in RENDERERS.iter().zip(&line.cells) {
            let names = [line.set.name, &line.set.source(), &file, renderer.name, renderer.method.name];
            let head: Vec<String> = names.map(str::to_owned).into_iter().chain([line.size.to_string()]).collect();
            let paper = ["", "", &number(cell.theirs), &number(cell.their_ratio), "", "", "", "", ""];
            table.row(head.iter().cloned().chain(paper.map(str::to_owned)));
            let variants = column.iter().flat_map(|column| &column.variants);
            let ours = variants.flat_map(|variant| of_clocks(timed, variant, renderer, line.size));
            ours.for_each(|ours| table.row(head.iter().cloned().chain(ours)));
        }
    }
    table.csv()
}

/// The fields of a variant's lines from `choice` on, a line for each clock it was timed by.
fn of_clocks(timed: &TimedRecord, variant: &Variant, renderer: &Renderer, size: u32) -> Vec<[String; 9]> {
    let of_clock = |(name, clock): (&str, Clock)| {
        let rate = rate(variant, renderer, size, clock)?;
        let [fps, least, greatest] = [rate.average, rate.least, rate.greatest].map(number);
        let ratio = rate_ratio(timed, variant, renderer, size, clock).map_or_else(String::new, number);
        let (choice, value, none) = (variant.choice.clone(), variant.value.clone(), String::new());
        Some([choice, value, none.clone(), none, name.to_owned(), fps, least, greatest, ratio])
    };
    CLOCKS.into_iter().filter_map(of_clock).collect()
}

fn number(value: f64) -> String {
    format!("{value:.6}")
}
