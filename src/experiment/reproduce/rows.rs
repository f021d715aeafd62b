//! The rows of a column: the thesis' counts, ours, the ratios of both to block skipping, and how far ours go when what the
//! thesis leaves open is chosen otherwise.

use super::papers::{DataSet, PaperRow};
use super::{ReproducedSet, Variant};
use crate::measure::record::Run;
use crate::scene::settings::PartialSegments;

/// Main or intermediate fragments of one row.
#[derive(Clone, Debug, PartialEq)]
pub struct FragmentLine {
    pub row: PaperRow,
    pub theirs: Option<u64>,
    pub ours: Option<u64>,
    /// To block skipping in KW03's order.
    pub their_ratio: Option<f64>,
    pub our_ratio: Option<f64>,
    /// Least and greatest ratio of all variants.
    pub sweep: Option<[f64; 2]>,
}

/// A line for each row that has anything; `main` fragments, or those of intermediate passes.
pub fn lines(set: &DataSet, column: &ReproducedSet, main: bool) -> Vec<FragmentLine> {
    let theirs = |row: PaperRow| {
        let found = set.rows.iter().find(|published| published.row == row)?;
        Some(if main { found.main } else { found.intermediate })
    };
    let base = column.variants.first();
    let line = |row: PaperRow| {
        let their_ratio = theirs(row).zip(theirs(PaperRow::Block)).map(|(part, whole)| part as f64 / whole as f64);
        FragmentLine {
            row,
            theirs: theirs(row),
            ours: base.and_then(|variant| count(variant, row, main)),
            their_ratio,
            our_ratio: base.and_then(|variant| ratio(variant, row, main)),
            sweep: sweep(column, |variant| ratio(variant, row, main)),
        }
    };
    // Without geometry no segment ends at a surface.
    let lines = PaperRow::ALL.into_iter().filter(|row| row.within().is_none()).map(line);
    lines.filter(|line| line.theirs.is_some() || line.ours.is_some()).collect()
}

/// Least and greatest of what the variants have; none where nothing was swept.
pub fn sweep(column: &ReproducedSet, ratio: impl Fn(&Variant) -> Option<f64>) -> Option<[f64; 2]> {
    let ratios = || column.variants.iter().filter_map(&ratio);
    let ends = ratios().reduce(f64::min).zip(ratios().reduce(f64::max));
    ends.map(|(low, high)| [low, high]).filter(|_| ratios().count() > 1)
}

/// The ratio of a row in one variant.
pub fn ratio(variant: &Variant, row: PaperRow, main: bool) -> Option<f64> {
    let (part, whole) = (count(variant, row, main)?, count(variant, PaperRow::Block, main)?);
    (whole > 0).then(|| part as f64 / whole as f64)
}

fn count(variant: &Variant, row: PaperRow, main: bool) -> Option<u64> {
    if row == PaperRow::Ideal {
        return variant.runs.iter().find_map(|run| run.ideal).map(|ideal| ideal.main).filter(|_| main);
    }
    let run = run_of(variant, row, false)?;
    Some(if main { run.fragments.main } else { run.fragments.intermediate })
}

/// The run of a row, with polygons or without, where all segments are drawn within their passes.
pub fn run_of(variant: &Variant, row: PaperRow, polygons: bool) -> Option<&Run> {
    let row = if polygons { row } else { row.within().unwrap_or(row) };
    variant.runs.iter().find(|run| run.settings.meshes.is_empty() != polygons && row_of(run) == Some(row))
}

fn row_of(run: &Run) -> Option<PaperRow> {
    let row = row_within(run)?;
    if run.settings.layers.partial == PartialSegments::Apart { row.apart() } else { Some(row) }
}

/// The row of a run, wherever it draws segments that end at a surface.
fn row_within(run: &Run) -> Option<PaperRow> {
    let block_first = run.settings.method.block_first;
    let each = run.settings.method.lookups > 1;
    match run.method.as_str() {
        "rc-ert" => Some(PaperRow::Ert),
        "rc-block" if block_first => Some(PaperRow::BlockFirst),
        "rc-block" => Some(PaperRow::Block),
        "nn-optimal" if each => Some(PaperRow::OptimalEach),
        "nn-omni" if each => Some(PaperRow::OmniEach),
        "nn-optimal" => Some(PaperRow::Optimal),
        "nn-omni" => Some(PaperRow::Omni),
        "nn-directional" => Some(PaperRow::Directional),
        _ => None,
    }
}

/// Ratios within this factor of the thesis' count as the same finding.
const ALIKE: f64 = 1.5;

/// A ratio of ours beside theirs.
pub struct Finding {
    /// The name of our row.
    pub name: String,
    /// The ratio of the paper.
    pub theirs: f64,
    /// The ratio of the main configuration.
    pub ours: f64,
    /// Least and greatest of ours over all variants.
    pub sweep: Option<[f64; 2]>,
}

/// What the comparison of a column comes to, in words made from its numbers; none without both sides.
pub fn verdict(lines: &[FragmentLine]) -> Option<String> {
    let findings = lines.iter().filter(|line| line.row != PaperRow::Block).filter_map(|line| {
        let (theirs, ours) = line.their_ratio.zip(line.our_ratio)?;
        Some(Finding { name: line.row.name().to_owned(), theirs, ours, sweep: line.sweep })
    });
    judged(findings, "block skipping")
}

/// What ratios to `whole` come to; none where there are none.
pub fn judged(findings: impl Iterator<Item = Finding>, whole: &str) -> Option<String> {
    let (mut alike, mut apart) = (Vec::new(), Vec::new());
    for Finding { name, theirs, ours, sweep } in findings {
        let factor = ours / theirs;
        let text = format!("{name} {:.1} % of {whole}, theirs {:.1} %", 100.0 * ours, 100.0 * theirs);
        if (1.0 / ALIKE..=ALIKE).contains(&factor) {
            alike.push(text);
        } else {
            let reached = sweep.is_some_and(|[low, high]| (low..=high).contains(&theirs));
            let reach = if reached { "; within the sweep" } else { "" };
            apart.push(format!("{text} (a factor of {factor:.2}{reach})"));
        }
    }
    let list = |title: &str, texts: Vec<String>| (!texts.is_empty()).then(|| format!("{title}: {}", texts.join("; ")));
    let found: Vec<String> = [list(&format!("within a factor of {ALIKE}"), alike), list("further apart", apart)]
        .into_iter()
        .flatten()
        .collect();
    (!found.is_empty()).then(|| format!("{}.", found.join(". ")))
}
