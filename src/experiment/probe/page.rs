//! The section of the report: the verdicts as a map of colours, the table, and every fault.

use super::text::{facts, fault_lines, summary, table};
use crate::probe::record::{MechanismRecord, Probe};
use crate::probe::{CaseShader, Mechanism, Pattern};
use crate::report::html::{Html, Intro};
use crate::report::table::{Cell, Column, Table};

/// A report of a probe alone.
pub fn page(probe: &Probe) -> String {
    let mut page = Html::page(&title(probe), &intro(probe));
    body(&mut page, probe);
    page.closed()
}

/// A section with all of it, in another page.
pub fn section(page: &mut Html, probe: &Probe) {
    page.raw("<section>\n");
    page.tag("h2", &title(probe));
    page.intro(&intro(probe));
    body(page, probe);
    page.raw("</section>\n");
}

fn title(probe: &Probe) -> String {
    format!("What {} culls before shading", probe.device.name)
}

fn intro(probe: &Probe) -> Intro<'_> {
    let device = &probe.device;
    let intro = Intro::new(summary(probe), &probe.provenance)
        .fact("Device", &device.name)
        .fact("Driver", &format!("{}, {}", device.driver, device.driver_version));
    facts(probe).iter().fold(intro, |intro, (term, words)| intro.fact(term, words))
}

fn body(page: &mut Html, probe: &Probe) {
    map(page, probe);
    patterns(page, probe);
    for mechanism in Mechanism::ALL {
        page.folded(mechanism.words(), |page| {
            let lines = probe.lines.iter().filter(|line| line.case.mechanism == mechanism);
            page.table(&table(lines));
        });
    }
    let faults = fault_lines(probe);
    if !faults.is_empty() {
        page.tag("h3", "wrong, the first case of each kind");
        page.list(&faults);
    }
}

/// The ground of a cell by the work that is left where all is rejected, from none (0) to all (1).
fn color(share: f64) -> String {
    // From green over yellow to red; text on it stays black.
    let hue = 130.0 * (1.0 - share.clamp(0.0, 1.0));
    format!("{hue:.0} 60% 72%")
}

fn cell(text: &str, share: Option<f64>, title: &str) -> Cell {
    Cell { ground: share.map(color), title: Some(title.to_owned()), ..text.into() }
}

/// Mechanisms by shaders.
fn map(page: &mut Html, probe: &Probe) {
    page.tag("h3", "work of the shader that is left when all fragments are rejected");
    page.raw("<p class=\"sub\">Green: culled before the shader. Red: the shader runs. A cross: what is left behind is wrong.</p>\n");
    let mechanisms = Mechanism::ALL.iter().map(|mechanism| Column::numbers(mechanism.words()));
    let mut table = Table::new([Column::words("shader")].into_iter().chain(mechanisms).collect());
    for shader in CaseShader::ALL {
        let cells = Mechanism::ALL.map(|mechanism| {
            // Of two compares the one a qualifier was made for comes first.
            let line = probe.lines.iter().find(|l| l.case.mechanism == mechanism && l.case.shader == shader);
            line.map_or_else(|| cell("", None, "makes no sense"), map_cell)
        });
        table.row([Cell::from(shader.words())].into_iter().chain(cells));
    }
    page.table(&table);
}

fn map_cell(line: &MechanismRecord) -> Cell {
    if let Some(missing) = &line.missing {
        return cell("–", None, missing);
    }
    let share = line.cost.as_ref().and_then(|cost| cost.verdict.share);
    let wrong = if line.faults().next().is_some() { " ✗" } else { "" };
    let title = format!("{}: right: {}; culled: {}", line.case.name(), line.right(), line.culled());
    let text = share.map_or("?".to_owned(), |share| format!("{:.0} %", 100.0 * share));
    cell(&format!("{text}{wrong}"), share, &title)
}

/// Cases that are culled by patterns.
fn patterns(page: &mut Html, probe: &Probe) {
    let lines: Vec<(&MechanismRecord, &[crate::probe::measure::Mixed])> = probe
        .lines
        .iter()
        .filter_map(|line| Some((line, line.cost.as_ref()?.mixed.as_slice())))
        .filter(|(_, mixed)| !mixed.is_empty())
        .collect();
    if lines.is_empty() {
        return;
    }
    page.tag("h3", "what is saved of the rejected half, by its pattern");
    page.raw("<p class=\"sub\">100 %: rejected fragments cost nothing. Squares of so many pixels, and so many per cent anywhere.</p>\n");
    let patterns = Pattern::MIXED.iter().map(|pattern| Column::numbers(pattern.name()));
    let mut table = Table::new([Column::words("case")].into_iter().chain(patterns).collect());
    for (line, mixed) in lines {
        let cells = mixed.iter().map(|one| {
            let text = one.saved.map_or("?".to_owned(), |saved| format!("{:.0} %", 100.0 * saved));
            cell(&text, one.saved.map(|saved| 1.0 - saved), &one.pattern)
        });
        // A probe cut short has fewer patterns.
        let blank = std::iter::repeat_with(Cell::default);
        let cells = [Cell::from(line.case.name())].into_iter().chain(cells).chain(blank);
        table.row(cells.take(1 + Pattern::MIXED.len()));
    }
    page.table(&table);
}
