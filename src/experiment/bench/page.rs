//! `report.html`: one file that needs nothing else. What it claims is computed from the runs; pictures come beside them.

use std::fmt::Write;

use super::scene;
use crate::error::Result;
use crate::experiment::probe;
use crate::measure::{Picture, Results};
use crate::probe::Probe;
use crate::report::comparison::groups;
use crate::report::cost::{Sweep, extra_fetches, least_cost};
use crate::report::html::{Html, escape};
use crate::report::{claims, verdict};

const METHOD: &str = include_str!("method.html");

/// What the report is made from.
#[derive(Clone, Copy, Debug)]
pub struct ReportInput<'a> {
    pub title: &'a str,
    pub results: &'a Results,
    /// Pictures by the place of their run in the results.
    pub pictures: &'a [(usize, Picture)],
    /// Differences to the reference, as [`difference`](crate::measure::error::difference) makes them.
    pub differences: &'a [Difference],
    /// What a probe found of the device, where there is one.
    pub probe: Option<&'a Probe>,
}

/// A picture of the differences of a run to its reference.
#[derive(Clone, Debug)]
pub struct Difference {
    /// Place of the run in the results.
    pub run: usize,
    /// What the differences were multiplied with.
    pub gain: f64,
    pub picture: Picture,
}

/// The whole file.
///
/// # Errors
/// When a picture is inconsistent or cannot be encoded.
pub fn report_html(input: &ReportInput) -> Result<String> {
    let results = input.results;
    let mut page = Html::page(input.title);
    let groups = groups(&results.runs);
    page.raw("<div class=\"lead\">\n");
    let mut sentences = claims(&groups);
    // What is known comes first.
    let known = results.runs.iter().any(|run| run.saved.as_ref().is_some_and(|saved| saved.time.is_some()));
    sentences.insert(if known { 0 } else { sentences.len() }, verdict(&groups));
    sentences.iter().for_each(|sentence| page.tag("p", sentence));
    page.raw("</div>\n");
    head(&mut page, input);
    for group in &groups {
        // Those with a higher cost of samples are curves of the first.
        if extra_fetches(group) == least_cost(group, &groups) {
            scene::section(&mut page, group, Sweep::of(group, &groups).as_ref(), input)?;
        }
    }
    if let Some(probe) = input.probe {
        probe::section(&mut page, probe);
    }
    page.raw(METHOD);
    Ok(page.closed())
}

/// Devices with their self-checks, and how the runs were made.
fn head(page: &mut Html, input: &ReportInput) {
    let results = input.results;
    page.raw("<h2>Device and run</h2>\n<dl class=\"facts\">\n");
    let mut devices: Vec<(&str, &str)> = Vec::new();
    for run in &results.runs {
        if devices.contains(&(&run.device, &run.driver)) {
            continue;
        }
        devices.push((&run.device, &run.driver));
        page.fact("Device", &run.device);
        page.fact("Driver", &run.driver);
        let mut verdicts = String::new();
        for (form, verdict) in &run.self_check {
            let class = match verdict.as_str() {
                "right" => "right",
                absent if absent.starts_with("not available") => "absent",
                _ => "wrong",
            };
            // Writing to a String cannot fail.
            let _ = write!(
                verdicts,
                "<li><code>{}</code> <span class=\"{class}\">{}</span></li>",
                escape(form),
                escape(verdict)
            );
        }
        let verdicts = if verdicts.is_empty() { "not run".into() } else { format!("<ul>{verdicts}</ul>") };
        page.raw(&format!("<dt>Self-check of culling</dt><dd>{verdicts}</dd>\n"));
    }
    page.provenance(&results.provenance);
    page.raw("</dl>\n");
}
