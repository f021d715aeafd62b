//! `reproduce.html`: the tables with their pictures, in the dress of the report.

use super::papers::{DataSet, OPEN, PaperRow};
use super::rows::{lines, ratio, verdict};
use super::text::{KINDS, absent, percent, present, table};
use super::{ReproducedSet, Reproduction};
use crate::report::html::{Html, Intro, Pictures, escape};
use crate::report::table::{Column, Table};

/// The whole file.
pub fn page(found: &Reproduction, pictures: Pictures) -> String {
    let lead = "Use of GPU Functionality in Volume Rendering (NTNU, 2005) counted fragments of near-neighbor skipping beside \
                those of empty block skipping. Its numbers stand beside ours, of the same volumes, views and steps; what it \
                leaves open is swept.";
    let mut intro = Intro::new(vec![lead.to_owned()], &found.provenance);
    if let Some(run) = found.columns.iter().flat_map(|c| &c.variants).flat_map(|v| &v.runs).next() {
        intro = intro.fact("Device", &format!("{}, {}", run.device, run.driver));
    }
    let mut page = Html::page("Depthleap reproduces the thesis' tables", &intro);
    present(found).for_each(|(set, column)| section(&mut page, set, column, pictures));
    let absent = absent(found);
    if !absent.is_empty() {
        page.raw("<section>\n<h2>Absent</h2>\n");
        page.list(&absent);
        page.raw("</section>\n");
    }
    page.raw("<section>\n<h2>What the thesis leaves open</h2>\n<dl class=\"facts\">\n");
    for (what, choice) in OPEN {
        page.fact(what, choice);
    }
    page.raw("</dl>\n</section>\n");
    page.closed()
}

/// A data set that was counted.
fn section(page: &mut Html, set: &DataSet, column: &ReproducedSet, pictures: Pictures) {
    page.raw("<section>\n");
    page.tag("h2", set.name);
    let step = format!("step {} of the side, front face {} pixels", set.step, set.face);
    page.raw(&format!("<p class=\"sub\">{}; {}</p>\n", escape(set.source), escape(&step)));
    set.remark.iter().for_each(|remark| page.tag("p", remark));
    if let Some(file) = &column.picture {
        page.raw("<div class=\"pictures\"><figure>");
        page.picture(pictures, file, set.name);
        let volume = column.file.as_deref().unwrap_or("");
        page.raw(&format!("<figcaption>{}</figcaption></figure></div>\n", escape(volume)));
    }
    for (kind, main) in KINDS {
        let lines = lines(set, column, main);
        if lines.is_empty() {
            continue;
        }
        page.tag("h3", &format!("{kind} fragments"));
        page.table(&table(&lines));
        if let Some(verdict) = verdict(&lines) {
            page.tag("p", &format!("Ratios {verdict}"));
        }
    }
    sweep(page, column);
    page.raw("</section>\n");
}

/// Each choice alone: the ratios to block skipping with it.
fn sweep(page: &mut Html, column: &ReproducedSet) {
    if column.variants.len() < 2 {
        return;
    }
    const ROWS: [PaperRow; 4] = [PaperRow::BlockFirst, PaperRow::Optimal, PaperRow::Omni, PaperRow::Directional];
    page.tag("h3", "each choice alone: % of block skipping, main / intermediate");
    let ratios = ROWS.map(|row| Column::numbers(row.name()));
    let mut table = Table::new([Column::words("")].into_iter().chain(ratios).collect());
    for variant in &column.variants {
        let ratios =
            ROWS.map(|row| format!("{} / {}", percent(ratio(variant, row, true)), percent(ratio(variant, row, false))));
        table.row([format!("{}: {}", variant.choice, variant.value)].into_iter().chain(ratios));
    }
    page.table(&table);
}
