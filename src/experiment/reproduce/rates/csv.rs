//! The frame rates as CSV.

use super::super::{Reproduction, TimedRecord, Variant};
use super::rows::{column_of, to_renderer, to_set};
use super::{RATE_TABLES, RateLine, RateTable, rate, rate_lines};
use crate::error::Result;
use crate::measure::record::Clock;
use crate::report::table::{Column, Table};

/// The fields of a line.
const HEAD: [&str; 17] = [
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
    "paper_ratio_renderers",
    "ratio_renderers",
];

/// The clocks a frame was timed by.
const CLOCKS: [(&str, Clock); 3] = [("wall", Clock::Wall), ("cpu", Clock::Cpu), ("gpu", Clock::Gpu)];

/// Of each data set, viewport and renderer of each table a line with the paper's frames per second, and one of ours for each clock
/// in the main configuration and with each choice made otherwise: over all directions, with those of the slowest and of the fastest
/// one. `ratio` and `paper_ratio` are to the set that the others are told in (the engine in Stegmaier05; KW03 has none), and the two
/// last to the renderer that the others are told in, of the same set. Empty fields where there is none.
///
/// # Errors
/// When a row cannot be written, which only a fault of this program explains.
pub fn rates_csv(found: &Reproduction) -> Result<String> {
    let mut table = Table::new(HEAD.map(Column::words).to_vec());
    let Some(timed) = &found.timed else { return table.csv() };
    for (rates, line) in RATE_TABLES.into_iter().flat_map(|rates| lines_of(timed, rates)) {
        let column = column_of(timed, rates, line.set);
        let file = column.and_then(|column| column.file.clone()).unwrap_or_default();
        let (renderer, source) = (line.renderer, rates.source(line.set));
        let names = [line.set.name, &source, &file, renderer.name, renderer.method.name];
        let head: Vec<String> = names.map(str::to_owned).into_iter().chain([line.size.to_string()]).collect();
        let [fps, ratio] = [line.theirs, line.to_set.and_then(|ratio| ratio.theirs)].map(number);
        let renderers = number(line.to_renderer.theirs);
        let paper = ["", "", &fps, &ratio, "", "", "", "", "", &renderers, ""].map(str::to_owned);
        if line.theirs.is_some() {
            table.row(head.iter().cloned().chain(paper));
        }
        let variants = column.iter().flat_map(|column| &column.variants);
        let ours = variants.flat_map(|variant| of_clocks(timed, rates, variant, &line));
        ours.for_each(|ours| table.row(head.iter().cloned().chain(ours)));
    }
    table.csv()
}

fn lines_of(timed: &TimedRecord, rates: &'static RateTable) -> Vec<(&'static RateTable, RateLine)> {
    rate_lines(timed, rates).into_iter().map(|line| (rates, line)).collect()
}

/// The fields of a variant's lines from `choice` on, a line for each clock it was timed by.
fn of_clocks(timed: &TimedRecord, rates: &RateTable, variant: &Variant, line: &RateLine) -> Vec<[String; 11]> {
    let of_clock = |(name, clock): (&str, Clock)| {
        let rate = rate(variant, line.renderer, line.size, clock)?;
        let [fps, least, greatest] = [rate.average, rate.least, rate.greatest].map(|rate| number(Some(rate)));
        let ratio = number(to_set(timed, rates, variant, line.renderer, line.size, clock));
        let renderers = number(to_renderer(rates, variant, line.renderer, line.size, clock));
        let (choice, value, none) = (variant.choice.clone(), variant.value.clone(), String::new());
        Some([choice, value, none.clone(), none.clone(), name.to_owned(), fps, least, greatest, ratio, none, renderers])
    };
    CLOCKS.into_iter().filter_map(of_clock).collect()
}

fn number(value: Option<f64>) -> String {
    value.map_or_else(String::new, |value| format!("{value:.6}"))
}
