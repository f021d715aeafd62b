//! `reproduce.html`: the tables with their pictures, in the dress of the report.

use super::papers::{DATA_SETS, OPEN, PaperRow};
use super::rows::{lines, ratio, verdict};
use super::text::{HEAD, KINDS, cells, percent};
use super::{ReproducedSet, Reproduction, Shown};
use crate::error::Result;
use crate::report::html::{Html, escape};

/// The whole file.
///
/// # Errors
/// When a picture cannot be encoded.
pub fn page(found: &Reproduction, pictures: &[Shown]) -> Result<String> {
    let mut page = Html::page("Depthleap reproduces the thesis' tables");
    page.raw("<div class=\"lead\">\n");
    page.tag(
        "p",
        "Use of GPU Functionality in Volume Rendering (NTNU, 2005) counted fragments of near-neighbor skipping beside \
         those of empty block skipping. Its numbers stand beside ours, of the same volumes, views and steps; what it \
         leaves open is swept.",
    );
    page.raw("</div>\n<dl class=\"facts\">\n");
    page.provenance(&found.provenance);
    if let Some(run) = found.columns.iter().flat_map(|c| &c.variants).flat_map(|v| &v.runs).next() {
        page.fact("Device", &format!("{}, {}", run.device, run.driver));
    }
    page.raw("</dl>\n");
    for (i, (set, column)) in DATA_SETS.iter().zip(&found.columns).enumerate() {
        page.raw("<section>\n");
        page.tag("h2", set.name);
        let step = format!("step {} of the side, front face {} pixels", set.step, set.face);
        page.raw(&format!("<p class=\"sub\">{}; {}</p>\n", escape(set.source), escape(&step)));
        for remark in
            set.remark.iter().map(|r| (*r).to_owned()).chain(column.absent.iter().map(|a| format!("Absent: {a}.")))
        {
            page.tag("p", &remark);
        }
        for shown in pictures.iter().filter(|shown| shown.column == i) {
            page.raw("<div class=\"pictures\"><figure>");
            page.picture(&shown.picture, [0.0; 3], set.name)?;
            page.raw(&format!(
                "<figcaption>{}</figcaption></figure></div>\n",
                escape(column.file.as_deref().unwrap_or(""))
            ));
        }
        for (kind, main) in KINDS {
            let lines = lines(set, column, main);
            if lines.is_empty() {
                continue;
            }
            page.tag("h3", &format!("{kind} fragments"));
            let rows: Vec<Vec<String>> = lines
                .iter()
                .map(|line| std::iter::once(line.row.name().to_owned()).chain(cells(line)).collect())
                .collect();
            page.table(&HEAD, &rows);
            if let Some(verdict) = verdict(&lines) {
                page.tag("p", &format!("Ratios {verdict}"));
            }
        }
        sweep(&mut page, column);
        page.raw("</section>\n");
    }
    page.raw("<section>\n<h2>What the thesis leaves open</h2>\n<dl class=\"facts\">\n");
    for (what, choice) in OPEN {
        page.fact(what, choice);
    }
    page.raw("</dl>\n</section>\n");
    Ok(page.closed())
}

/// Each choice alone: the ratios to block skipping with it.
fn sweep(page: &mut Html, column: &ReproducedSet) {
    if column.variants.len() < 2 {
        return;
    }
    const ROWS: [PaperRow; 4] = [PaperRow::BlockFirst, PaperRow::Optimal, PaperRow::Omni, PaperRow::Directional];
    page.tag("h3", "each choice alone: % of block skipping, main / intermediate");
    let rows: Vec<Vec<String>> = column
        .variants
        .iter()
        .map(|variant| {
            let ratios = ROWS
                .map(|row| format!("{} / {}", percent(ratio(variant, row, true)), percent(ratio(variant, row, false))));
            std::iter::once(format!("{}: {}", variant.choice, variant.value)).chain(ratios).collect()
        })
        .collect();
    let head = [""].into_iter().chain(ROWS.map(PaperRow::name)).collect::<Vec<_>>();
    page.table(&head, &rows);
}
