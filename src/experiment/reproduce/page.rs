//! `reproduce.html`: the tables with their pictures, in the dress of the report.

use super::embedded_rows::embedded_ratio;
use super::papers::{DataSet, PaperRow};
use super::rates::{RATE_TABLES, absent_rates, present_rates, rate_remarks, rates_sweep, rates_table};
use super::rows::ratio;
use super::stated::{STATED_TITLE, stated_table};
use super::termination_table::{TERMINATION_TITLE, gains_table};
use super::text::{KINDS, absent, kind_of_fragments, open_choices, percent, present};
use super::{FigureRecord, ReproducedSet, Reproduction, TimedRecord, Variant};
use crate::report::html::{Html, Intro, Pictures, escape};
use crate::report::table::{Column, Table};

/// The whole file.
pub fn page(found: &Reproduction, pictures: Pictures) -> String {
    let lead = "Use of GPU Functionality in Volume Rendering (NTNU, 2005) counted fragments of near-neighbor skipping beside \
                those of empty block skipping, alone and with polygons in the volume. Its numbers stand beside ours, of the same \
                views and steps; what it leaves open is swept. Frame rates of A Simple and Flexible Volume Rendering Framework for \
                Graphics-Hardware-based Raycasting (2005), of Acceleration Techniques for GPU-based Volume Rendering (2003) and of \
                Hardware Accelerated Rendering of Emissive Volumes (1995) stand beside ours too.";
    let mut intro = Intro::new(vec![lead.to_owned()], &found.provenance);
    let timed = found.timed.iter().flat_map(|timed| &timed.rates);
    if let Some(run) = found.columns.iter().chain(timed).flat_map(|c| &c.variants).flat_map(|v| &v.runs).next() {
        intro = intro.fact("Device", &format!("{}, {}", run.device, run.driver));
    }
    let mut page = Html::page("Depthleap reproduces the papers' tables", &intro);
    present(found).for_each(|(set, column)| section(&mut page, set, column, pictures));
    found.timed.iter().for_each(|timed| timed_sections(&mut page, timed, pictures));
    stated_section(&mut page, found);
    figures(&mut page, &found.figures, pictures);
    let absent: Vec<String> = absent(found).into_iter().chain(found.timed.iter().flat_map(absent_rates)).collect();
    if !absent.is_empty() {
        page.raw("<section>\n<h2>Absent</h2>\n");
        page.list(&absent);
        page.raw("</section>\n");
    }
    for (paper, open) in open_choices(found) {
        page.raw(&format!("<section>\n<h2>What {paper} leaves open</h2>\n<dl class=\"facts\">\n"));
        open.iter().for_each(|(what, choice)| page.fact(what, choice));
        page.raw("</dl>\n</section>\n");
    }
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
        let meshes = set.geometry.map_or_else(String::new, |geometry| format!(": {}", geometry.scene.about));
        page.raw(&format!("<figcaption>{}</figcaption></figure></div>\n", escape(&format!("{volume}{meshes}"))));
    }
    for (kind, main) in KINDS {
        let Some((table, verdict)) = kind_of_fragments(set, column, main) else { continue };
        page.tag("h3", &format!("{kind} fragments"));
        page.table(&table);
        if let Some(verdict) = verdict {
            page.tag("p", &format!("Ratios {verdict}"));
        }
    }
    match set.geometry {
        Some(_) => sweep(page, column, "those without geometry", &WITH_GEOMETRY, embedded_ratio),
        None => sweep(page, column, "block skipping", &ALONE, ratio),
    }
    page.raw("</section>\n");
}

/// What was timed: frame rates, and early ray termination.
fn timed_sections(page: &mut Html, timed: &TimedRecord, pictures: Pictures) {
    for rates in RATE_TABLES {
        let Some((table, said)) = rates_table(timed, rates) else { continue };
        page.raw("<section>\n");
        page.tag("h2", rates.title);
        page.raw(&format!("<p class=\"sub\">{}, Table 1</p>\n", escape(rates.paper)));
        page.list(&rate_remarks(timed, rates));
        page.raw("<div class=\"pictures\">");
        for (set, column) in present_rates(timed, rates) {
            let Some(file) = &column.picture else { continue };
            page.raw("<figure>");
            page.picture(pictures, file, set.name);
            let caption = format!("{}: {}", set.name, column.file.as_deref().unwrap_or(""));
            page.raw(&format!("<figcaption>{}</figcaption></figure>\n", escape(&caption)));
        }
        page.raw("</div>\n");
        page.table(&table);
        page.list(&said);
        if let Some(sweep) = rates_sweep(timed, rates) {
            page.tag("h3", "each choice alone: frames per second");
            page.table(&sweep);
        }
        page.raw("</section>\n");
    }
    if let Some((table, verdict)) = gains_table(timed) {
        page.raw("<section>\n");
        page.tag("h2", TERMINATION_TITLE);
        page.raw("<p class=\"sub\">Stegmaier05 §7</p>\n");
        page.table(&table);
        page.tag("p", &verdict);
        page.raw("</section>\n");
    }
}

/// What the papers state in words.
fn stated_section(page: &mut Html, found: &Reproduction) {
    let clock = found.timed.as_ref().and_then(|timed| timed.clock);
    let Some(table) = found.stated.as_ref().and_then(|stated| stated_table(stated, clock)) else { return };
    page.raw("<section>\n");
    page.tag("h2", STATED_TITLE);
    page.table(&table);
    page.raw("</section>\n");
}

/// The pictures of scenes like the papers' figures, each with what it shows.
fn figures(page: &mut Html, figures: &[FigureRecord], pictures: Pictures) {
    if figures.is_empty() {
        return;
    }
    page.raw("<section>\n<h2>Figures</h2>\n");
    page.tag("p", "Scenes like those of the papers' figures; places and colours are ours.");
    page.raw("<div class=\"pictures\">");
    for figure in figures.iter().filter(|figure| figure.absent.is_none()) {
        let Some(file) = &figure.picture else { continue };
        page.raw("<figure>");
        page.picture(pictures, file, &figure.about);
        let volume = figure.file.as_ref().map_or_else(|| "built in".to_owned(), Clone::clone);
        let caption = format!("After {}: {} ({volume})", figure.source, figure.about);
        page.raw(&format!("<figcaption>{}</figcaption></figure>\n", escape(&caption)));
    }
    page.raw("</div>\n");
    let absent = |figure: &FigureRecord| Some(format!("{}: {}", figure.about, figure.absent.as_ref()?));
    page.list(&figures.iter().filter_map(absent).collect::<Vec<_>>());
    page.raw("</section>\n");
}

/// The rows of a sweep without polygons, and with them.
const ALONE: [PaperRow; 4] = [PaperRow::BlockFirst, PaperRow::Optimal, PaperRow::Omni, PaperRow::Directional];
const WITH_GEOMETRY: [PaperRow; 4] = [PaperRow::Block, PaperRow::Optimal, PaperRow::Omni, PaperRow::Directional];

/// Each choice alone: the ratios to `whole` with it.
fn sweep(
    page: &mut Html,
    column: &ReproducedSet,
    whole: &str,
    rows: &[PaperRow],
    ratio: fn(&Variant, PaperRow, bool) -> Option<f64>,
) {
    if column.variants.len() < 2 {
        return;
    }
    page.tag("h3", &format!("each choice alone: % of {whole}, main / intermediate"));
    let heads = rows.iter().map(|row| Column::numbers(row.name()));
    let mut table = Table::new([Column::words("")].into_iter().chain(heads).collect());
    for variant in &column.variants {
        let ratios = rows
            .iter()
            .map(|row| format!("{} / {}", percent(ratio(variant, *row, true)), percent(ratio(variant, *row, false))));
        table.row([format!("{}: {}", variant.choice, variant.value)].into_iter().chain(ratios));
    }
    page.table(&table);
}
