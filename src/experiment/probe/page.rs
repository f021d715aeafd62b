//! The section of the report: the verdicts as a map of colours, the table, and every fault.

use super::text::{HEAD, facts, fault_lines, row, summary};
use crate::probe::record::{Line, Probe};
use crate::probe::{Mechanism, Pattern, Shader};
use crate::report::html::{Html, escape};

/// A report of a probe alone.
pub fn page(probe: &Probe) -> String {
    let mut page = Html::page("Depthleap probe: what this driver culls before shading");
    section(&mut page, probe);
    page.closed()
}

/// The section, in a page.
pub fn section(page: &mut Html, probe: &Probe) {
    page.raw("<section>\n");
    page.tag("h2", &format!("What {} culls before shading", probe.device.name));
    page.raw("<div class=\"lead\">\n");
    summary(probe).iter().for_each(|sentence| page.tag("p", sentence));
    page.raw("</div>\n<dl class=\"facts\">\n");
    page.fact("Device", &probe.device.name);
    page.fact("Driver", &format!("{}, {}", probe.device.driver, probe.device.driver_version));
    for (term, words) in facts(probe) {
        page.fact(term, &words);
    }
    page.provenance(&probe.provenance);
    page.raw("</dl>\n");
    map(page, probe);
    patterns(page, probe);
    for mechanism in Mechanism::ALL {
        page.folded(mechanism.words(), |page| {
            let lines = probe.lines.iter().filter(|line| line.case.mechanism == mechanism);
            page.table(&HEAD, &lines.map(|line| row(line).to_vec()).collect::<Vec<_>>());
        });
    }
    let faults = fault_lines(probe);
    if !faults.is_empty() {
        page.tag("h3", "wrong, the first case of each kind");
        page.raw("<ul>\n");
        faults.iter().for_each(|fault| page.tag("li", fault));
        page.raw("</ul>\n");
    }
    page.raw("</section>\n");
}

/// Work that is left where all is rejected, from none (0) to all (1).
fn color(share: f64) -> String {
    // From green over yellow to red; text on it stays black.
    let hue = 130.0 * (1.0 - share.clamp(0.0, 1.0));
    format!("background:hsl({hue:.0} 60% 72%);color:#000")
}

fn cell(text: &str, share: Option<f64>, title: &str) -> String {
    let style = share.map(color).unwrap_or_default();
    format!("<td class=\"number\" style=\"{style}\" title=\"{}\">{}</td>", escape(title), escape(text))
}

/// Mechanisms by shaders.
fn map(page: &mut Html, probe: &Probe) {
    page.tag("h3", "work of the shader that is left when all fragments are rejected");
    page.raw("<p class=\"sub\">Green: culled before the shader. Red: the shader runs. A cross: what is left behind is wrong.</p>\n");
    page.raw("<div class=\"wide\"><table><thead><tr><th>shader</th>");
    Mechanism::ALL.iter().for_each(|mechanism| page.raw(&format!("<th>{}</th>", escape(mechanism.words()))));
    page.raw("</tr></thead>\n<tbody>\n");
    for shader in Shader::ALL {
        page.raw(&format!("<tr><td>{}</td>", escape(shader.words())));
        for mechanism in Mechanism::ALL {
            // Of two compares the one a qualifier was made for comes first.
            let line = probe.lines.iter().find(|l| l.case.mechanism == mechanism && l.case.shader == shader);
            page.raw(&line.map_or_else(|| cell("", None, "makes no sense"), map_cell));
        }
        page.raw("</tr>\n");
    }
    page.raw("</tbody></table></div>\n");
}

fn map_cell(line: &Line) -> String {
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
    let lines: Vec<(&Line, &[crate::probe::measure::Mixed])> = probe
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
    page.raw("<div class=\"wide\"><table><thead><tr><th>case</th>");
    Pattern::MIXED.iter().for_each(|pattern| page.raw(&format!("<th>{}</th>", escape(&pattern.name()))));
    page.raw("</tr></thead>\n<tbody>\n");
    for (line, mixed) in lines {
        page.raw(&format!("<tr><td>{}</td>", escape(&line.case.name())));
        for one in mixed {
            let text = one.saved.map_or("?".to_owned(), |saved| format!("{:.0} %", 100.0 * saved));
            page.raw(&cell(&text, one.saved.map(|saved| 1.0 - saved), &one.pattern));
        }
        page.raw("</tr>\n");
    }
    page.raw("</tbody></table></div>\n");
}
