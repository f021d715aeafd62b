//! `stability.html`: every case by every method.

use super::text::{faults, share, word};
use super::{CaseRecord, Outcome, Stability, StabilityVerdict};
use crate::report::html::{Html, Intro};
use crate::report::number::error;
use crate::report::table::{Cell, Column, Table};

/// The whole file.
pub fn page(found: &Stability) -> String {
    let intro = Intro::new(vec![format!("{}.", found.summary())], &found.provenance)
        .fact("Device", &format!("{}, {}", found.device, found.driver));
    let mut page = Html::page(&format!("Stiff and extreme cases on {}", found.device), &intro);
    page.tag(
        "p",
        "Each cell is the largest difference of a channel from what is expected, as a share of what is allowed; pixels that \
         f32 or the rasteriser may decide either way are left out. Pictures of methods that end rays early are one and the \
         same, bit for bit.",
    );
    let mut methods: Vec<&str> = found.cases.iter().flat_map(|c| &c.outcomes).map(|o| o.method.as_str()).collect();
    let mut seen = Vec::new();
    methods.retain(|method| {
        let new = !seen.contains(method);
        seen.push(*method);
        new
    });
    let mut groups: Vec<&str> = found.cases.iter().map(|case| case.group.as_str()).collect();
    groups.dedup();
    for group in groups {
        page.raw("<section>\n");
        page.tag("h2", group);
        let of_group = || found.cases.iter().filter(|case| case.group == group);
        page.table(&table(of_group(), &methods));
        let wrong: Vec<String> = of_group()
            .flat_map(|case| faults(case).into_iter().map(move |fault| format!("{}, {fault}", case.name)))
            .collect();
        page.list(&wrong);
        page.raw("</section>\n");
    }
    page.closed()
}

/// Cases by methods.
fn table<'a>(cases: impl Iterator<Item = &'a CaseRecord>, methods: &[&str]) -> Table {
    let mut columns = ["case", "held against", "allowed, and why"].map(Column::words).to_vec();
    columns.extend(methods.iter().map(|method| Column::numbers(*method)));
    let mut table = Table::new(columns);
    for case in cases {
        let [absolute, relative] = case.tolerance.map(|t| error(Some(t)));
        let allowed = match case.outcomes.iter().any(|o| o.share.is_some()) {
            true => format!("{absolute} and {relative} of the value: {}", case.reason),
            false => String::new(),
        };
        let outcome = |method: &&str| case.outcomes.iter().find(|o| o.method == *method);
        let words = [case.name.clone(), case.expected.clone(), allowed].map(Cell::from);
        let cells = methods.iter().map(|method| outcome(method).map_or_else(Cell::default, cell));
        table.row(words.into_iter().chain(cells));
    }
    table
}

fn cell(outcome: &Outcome) -> Cell {
    let ground = match outcome.verdict {
        StabilityVerdict::Right => "130 45% 80%",
        StabilityVerdict::Wrong => "0 70% 75%",
        StabilityVerdict::Missing => "0 0% 88%",
    };
    let text = match (&outcome.verdict, outcome.share) {
        (StabilityVerdict::Right, Some(share)) => format!("{:.1} %", 100.0 * share),
        (verdict, _) => word(verdict).to_owned(),
    };
    let title = outcome.remark.clone().unwrap_or_else(|| share(outcome.share));
    Cell { ground: Some(ground.to_owned()), title: Some(title), ..text.into() }
}
