//! The rows of a column: the thesis' counts, ours, the ratios of both to block skipping, and how far ours go when what the
//! thesis leaves open is chosen otherwise.

use super::papers::{DataSet, PaperRow};
use super::{ReproducedSet, Variant};
use crate::measure::record::Run;

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
        let ratios = column.variants.iter().filter_map(|variant| ratio(variant, row, main));
        let sweep = ratios.clone().reduce(f64::min).zip(ratios.reduce(f64::max)).map(|(low, high)| [low, high]);
        let their_ratio = theirs(row).zip(theirs(PaperRow::Block)).map(|(part, whole)| part as f64 / whole as f64);
        FragmentLine {
            row,
            theirs: theirs(row),
            ours: base.and_then(|variant| count(variant, row, main)),
            their_ratio,
            our_ratio: base.and_then(|variant| ratio(variant, row, main)),
            sweep: sweep.filter(|_| column.variants.len() > 1),
        }
    };
    let lines = PaperRow::ALL.map(line);
    lines.into_iter().filter(|line| line.theirs.is_some() || line.ours.is_some()).collect()
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
    let run = variant.runs.iter().find(|run| row_of(run) == Some(row))?;
    Some(if main { run.fragments.main } else { run.fragments.intermediate })
}

fn row_of(run: &Run) -> Option<PaperRow> {
    let block_first = run.settings.method.block_first;
    let each = run.settings.method.lookups > 1;
    match run.method.as_str() {
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

/// What the comparison of a column comes to, in words made from its numbers; none without both sides.
pub fn verdict(lines: &[FragmentLine]) -> Option<String> {
    let (mut alike, mut apart) = (Vec::new(), Vec::new());
    for line in lines.iter().filter(|line| line.row != PaperRow::Block) {
        let (Some(theirs), Some(ours)) = (line.their_ratio, line.our_ratio) else { continue };
        let factor = ours / theirs;
        let text =
            format!("{} {:.1} % of block skipping, theirs {:.1} %", line.row.name(), 100.0 * ours, 100.0 * theirs);
        if (1.0 / ALIKE..=ALIKE).contains(&factor) {
            alike.push(text);
        } else {
            let reached = line.sweep.is_some_and(|[low, high]| (low..=high).contains(&theirs));
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
