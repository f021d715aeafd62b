//! `accuracy.html`: the answers, the plots, the tables.

use super::text::{HEAD, cells, order};
use super::{Accuracy, answers, step_svg, time_svg};
use crate::error::Result;
use crate::report::html::Html;

/// The whole file.
///
/// # Errors
/// When a plot cannot be drawn.
pub fn page(found: &Accuracy) -> Result<String> {
    let mut page = Html::page(&format!("Error against run time: {}", found.scene));
    page.raw("<div class=\"lead\">\n");
    answers(&found.curves).iter().for_each(|answer| page.tag("p", answer));
    page.raw("</div>\n<dl class=\"facts\">\n");
    page.fact("View", &found.view);
    page.fact("Device", &format!("{}, {}", found.device, found.driver));
    if let Some(clock) = found.clock {
        page.fact("Time", clock.words());
    }
    page.provenance(&found.provenance);
    page.raw("</dl>\n");
    found.remarks.iter().for_each(|remark| page.tag("p", remark));
    if let Some(svg) = time_svg(found)? {
        page.plot(
            &svg,
            "Error against time",
            "Each mark is a picture of one step. Whiskers: least and greatest time. Rings: no other picture is both faster and \
             nearer to the exact integral (Pareto front).",
        );
    }
    if let Some(svg) = step_svg(found)? {
        page.plot(&svg, "Error against step", "Thin lines fall with the first and the second order.");
    }
    for curve in &found.curves {
        page.raw("<section>\n");
        page.tag("h2", &curve.name());
        page.tag("p", &format!("{}.", order(curve)));
        page.raw("<ul>\n");
        curve.remarks.iter().for_each(|remark| page.tag("li", remark));
        page.raw("</ul>\n");
        page.table(&HEAD, &curve.points.iter().map(|point| cells(point).to_vec()).collect::<Vec<_>>());
        page.raw("</section>\n");
    }
    Ok(page.closed())
}
