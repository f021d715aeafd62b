//! `report.html`: one file that needs nothing else. What it claims is computed from the runs; pictures come beside them.

use std::fmt::Write;

use super::scene;
use crate::error::Result;
use crate::experiment::probe;
use crate::measure::Results;
use crate::probe::Probe;
use crate::report::comparison::groups;
use crate::report::cost::{Sweep, extra_fetches, least_cost};
use crate::report::growth::Growth;
use crate::report::html::{Html, Intro, Pictures, escape};
use crate::report::{branching, choices, claims, verdict};

const METHOD: &str = include_str!("method.html");

/// The whole file. `probe`: what was found of the device, where anything was.
///
/// # Errors
/// When a plot cannot be drawn.
pub fn page(results: &Results, probe: Option<&Probe>, pictures: Pictures) -> Result<String> {
    let groups = groups(&results.runs);
    let mut sentences = claims(&groups);
    // What is known comes first.
    let known = results.runs.iter().any(|run| run.saved.as_ref().is_some_and(|saved| saved.time.is_some()));
    sentences.insert(if known { 0 } else { sentences.len() }, verdict(&groups));
    sentences.extend(branching(&groups));
    sentences.extend(choices(&groups));
    let mut intro = Intro::new(sentences, &results.provenance);
    devices(&mut intro, results);
    let mut page = Html::page("Depthleap bench", &intro);
    for group in &groups {
        // Those with a higher cost of samples are curves of the first.
        if extra_fetches(group) == least_cost(group, &groups) {
            let sweep = Sweep::of(group, &groups);
            scene::section(&mut page, group, sweep.as_ref(), &results.pictures, pictures)?;
        }
    }
    for growth in Growth::all(&groups) {
        scene::growth(&mut page, &growth)?;
    }
    if let Some(found) = probe {
        probe::section(&mut page, found);
    }
    page.raw(METHOD);
    Ok(page.closed())
}

/// Devices with their self-checks.
fn devices(intro: &mut Intro, results: &Results) {
    let mut devices: Vec<(&str, &str)> = Vec::new();
    for run in &results.runs {
        if devices.contains(&(&run.device, &run.driver)) {
            continue;
        }
        devices.push((&run.device, &run.driver));
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
        intro.facts.extend([
            ("Device".to_owned(), escape(&run.device)),
            ("Driver".to_owned(), escape(&run.driver)),
            ("Self-check of culling".to_owned(), verdicts),
        ]);
    }
}
