//! `accuracy.html`: the answers, the plots, the tables.

use super::text::{order, surface_orders, table};
use super::{Accuracy, answers, step_svgs, time_svgs};
use crate::error::Result;
use crate::report::html::{Html, Intro, Pictures, escape};

/// The whole file.
///
/// # Errors
/// When a plot cannot be drawn.
pub fn page(found: &Accuracy, pictures: Pictures) -> Result<String> {
    let mut intro = Intro::new(answers(&found.curves), &found.provenance)
        .fact("View", &found.view)
        .fact("Device", &format!("{}, {}", found.device, found.driver));
    if let Some(clock) = found.clock {
        intro = intro.fact("Time", clock.words());
    }
    let mut page = Html::page(&format!("Error against run time: {}", found.scene), &intro);
    if let Some(file) = &found.picture {
        page.raw("<div class=\"pictures\"><figure>");
        page.picture(pictures, file, &found.scene);
        page.raw(&format!("<figcaption>{}, the exact integral</figcaption></figure></div>\n", escape(&found.scene)));
    }
    found.remarks.iter().for_each(|remark| page.tag("p", remark));
    plots(
        &mut page,
        &time_svgs(found)?,
        "Error against time",
        "Each mark is a picture of one step, or of one number of shells. Whiskers: least and greatest time. Rings: no other \
         picture is both faster and nearer to what is exact (Pareto front).",
    );
    plots(
        &mut page,
        &step_svgs(found)?,
        "Error against step",
        "Dashed lines fall with the first and the second order. Methods with the same errors are one curve.",
    );
    for curve in &found.curves {
        page.raw("<section>\n");
        page.tag("h2", &curve.name());
        page.tag("p", &format!("{}.", order(curve)));
        page.list(&surface_orders(curve));
        page.list(&curve.remarks);
        page.table(&table(curve));
        page.raw("</section>\n");
    }
    Ok(page.closed())
}

/// The first plot; others of very many curves when asked for.
fn plots(page: &mut Html, svgs: &[String], label: &str, caption: &str) {
    let Some((first, others)) = svgs.split_first() else { return };
    page.tag("h2", label);
    page.plot(first, label, caption);
    if !others.is_empty() {
        page.folded(&format!("{label}: {} more plots", others.len()), |page| {
            others.iter().for_each(|svg| page.plot(svg, label, caption));
        });
    }
}
