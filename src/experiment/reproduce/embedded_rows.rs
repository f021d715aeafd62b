//! The rows of a column with polygons: the thesis' counts, ours below them, of each part of the rays and of all.

use super::embedded::{Fragments, Geometry};
use super::paper_row::PaperRow;
use super::rows::{Finding, judged, run_of, sweep};
use super::{ReproducedSet, Variant};

/// Main or intermediate fragments of one method.
#[derive(Clone, Debug, PartialEq)]
pub struct EmbeddedLine {
    /// The name in the thesis, or that of our row.
    pub name: &'static str,
    /// The row of ours; none for the thesis' own numbers.
    pub row: Option<PaperRow>,
    /// Fragments without polygons.
    pub without: Option<u64>,
    /// Of each part of the rays, front to back; empty where the thesis gives their sum alone.
    pub parts: Vec<u64>,
    /// With polygons, of all parts.
    pub with: Option<u64>,
    /// With polygons to without.
    pub ratio: Option<f64>,
    /// To early z with polygons: the thesis' lines to its own, ours to block skipping.
    pub share: Option<f64>,
    /// `ratio` of the thesis, where this is a row of ours.
    pub their_ratio: Option<f64>,
    /// Least and greatest ratio of all variants.
    pub sweep: Option<[f64; 2]>,
}

/// The thesis' lines, each with those of ours that it may be below it; `main` fragments, or those of intermediate passes.
pub fn embedded_lines(geometry: &Geometry, column: &ReproducedSet, main: bool) -> Vec<EmbeddedLine> {
    let kind = |fragments: Fragments| fragments[usize::from(!main)];
    let early_z = geometry.rows.first().and_then(|row| row.theirs).map(|theirs| kind(theirs.with));
    let mut lines = Vec::new();
    for row in geometry.rows {
        let their_ratio = row.theirs.map(|theirs| kind(theirs.with) as f64 / kind(theirs.without) as f64);
        lines.extend(row.theirs.map(|theirs| EmbeddedLine {
            name: row.name,
            row: None,
            without: Some(kind(theirs.without)),
            parts: theirs.parts.iter().copied().map(kind).collect(),
            with: Some(kind(theirs.with)),
            ratio: their_ratio,
            share: early_z.map(|whole| kind(theirs.with) as f64 / whole as f64),
            their_ratio: None,
            sweep: None,
        }));
        let counted = |ours: &PaperRow| our_line(column, *ours, main).map(|line| EmbeddedLine { their_ratio, ..line });
        lines.extend(row.ours.iter().filter_map(counted));
    }
    lines
}

/// A line of ours; none where it was not counted.
fn our_line(column: &ReproducedSet, row: PaperRow, main: bool) -> Option<EmbeddedLine> {
    let base = column.variants.first()?;
    let [without, with] = counts(base, row, main)?;
    let block = counts(base, PaperRow::Block, main).map(|[_, with]| with).filter(|whole| *whole > 0);
    let layers = &run_of(base, row, true)?.fragments.per_layer;
    Some(EmbeddedLine {
        name: row.name(),
        row: Some(row),
        without: Some(without),
        parts: layers.iter().map(|part| if main { part.main } else { part.intermediate }).collect(),
        with: Some(with),
        ratio: embedded_ratio(base, row, main),
        share: block.map(|whole| with as f64 / whole as f64),
        their_ratio: None,
        sweep: sweep(column, |variant| embedded_ratio(variant, row, main)),
    })
}

/// Fragments without polygons and with them.
fn counts(variant: &Variant, row: PaperRow, main: bool) -> Option<[u64; 2]> {
    let count = |polygons: bool| {
        let fragments = &run_of(variant, row, polygons)?.fragments;
        Some(if main { fragments.main } else { fragments.intermediate })
    };
    Some([count(false)?, count(true)?])
}

/// Fragments with polygons to those without.
pub fn embedded_ratio(variant: &Variant, row: PaperRow, main: bool) -> Option<f64> {
    let [without, with] = counts(variant, row, main)?;
    (without > 0).then(|| with as f64 / without as f64)
}

/// What the comparison of a column comes to; none without both sides.
pub fn embedded_verdict(lines: &[EmbeddedLine]) -> Option<String> {
    let findings = lines.iter().filter_map(|line| {
        let (theirs, ours) = line.their_ratio.zip(line.ratio)?;
        Some(Finding { name: line.name.to_owned(), theirs, ours, sweep: line.sweep })
    });
    judged(findings, "those without geometry")
}
