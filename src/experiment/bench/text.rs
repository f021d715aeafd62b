//! The comparison as plain text, after the tables of [Thesis §5.6]: rows are methods, numbers stand right.

use std::fmt::Write;

use crate::experiment::orbit::Summary;
use crate::measure::Run;
use crate::report::comparison::{self, RunGroup, groups, label};
use crate::report::cost::{Sweep, extra_fetches, least_cost};
use crate::report::table::TextLayout;

/// One table a scene, with its footnotes; empty where there are no runs.
pub fn table(runs: &[Run]) -> String {
    let groups = groups(runs);
    let shown = groups.iter().filter(|group| extra_fetches(group) == least_cost(group, &groups));
    let text = |group: &RunGroup| {
        let sweep = Sweep::of(group, &groups).map(|sweep| cost_table(&sweep)).unwrap_or_default();
        group_table(group) + &sweep
    };
    shown.map(text).collect::<Vec<_>>().join("\n")
}

/// Times by the cost of a sample.
fn cost_table(sweep: &Sweep) -> String {
    format!("\nTime by the cost of a sample, rc-ert = 1\n{}", sweep.table().text(&TextLayout::default()))
}

fn group_table(group: &RunGroup) -> String {
    let run = group.first();
    let between = if run.driver.is_empty() { "" } else { ", " };
    let mut out = format!("{}\n{}\n{}{between}{}\n\n", run.scene, group.subtitle(), run.device, run.driver);
    out += &comparison::table(group).text(&TextLayout { rule: true, ..TextLayout::default() });
    let orbits: Vec<String> = group.runs.iter().filter_map(|(_, run)| orbit_line(run)).collect();
    if !orbits.is_empty() {
        let _ = writeln!(out, "\nOrbit, medians of a frame\n{}", orbits.join("\n"));
    }
    out
}

/// What an orbit was like, in a line.
fn orbit_line(run: &Run) -> Option<String> {
    let summary = Summary::of(run.orbit.as_deref()?)?;
    Some(format!("{:<21} {}", label(run), summary.words()))
}
