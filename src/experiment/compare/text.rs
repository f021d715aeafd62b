//! What differs between two results, for a terminal.

use std::fmt::Write;

use serde_json::Value;

use super::{Comparison, Difference};
use crate::report::number::{milliseconds, thousands};

/// The comparison for a terminal.
pub fn text(found: &Comparison) -> String {
    let mut out = format!("a: {}\nb: {}\n", found.a, found.b);
    for (which, runs) in [("a", &found.only_in_a), ("b", &found.only_in_b)] {
        for run in runs {
            let _ = writeln!(out, "\nonly in {which}: {run}");
        }
    }
    for run in &found.runs {
        let _ = writeln!(out, "\n{}", run.run);
        for Difference { what, a, b } in &run.settings {
            let _ = writeln!(out, "  setting {what}: {a} -> {b}");
        }
        for difference in &run.counts {
            let _ = writeln!(out, "  {}", count_text(difference));
        }
        if run.counts.is_empty() {
            let _ = writeln!(out, "  counts: the same");
        }
        for time in &run.times {
            let ratio = if time.a > 0.0 { format!("x {:.3}", time.b / time.a) } else { "no ratio".to_owned() };
            let spread = if time.apart { "" } else { ", within the spread" };
            let _ = writeln!(
                out,
                "  {}: {} -> {} ms, {ratio}{spread}",
                time.what,
                milliseconds(time.a),
                milliseconds(time.b)
            );
        }
    }
    let verdict = match (found.same_counts(), found.runs.iter().all(|run| run.counts.is_empty())) {
        (true, _) => "All counts are the same.",
        (false, true) => "Counts of runs that both have are the same; one lacks runs of the other.",
        (false, false) => "Counts differ.",
    };
    out + "\n" + verdict + "\n"
}

/// A list of counts by its sum and the place of the first that differs.
fn count_text(Difference { what, a, b }: &Difference) -> String {
    let list = |value: &Value| value.as_array().map(|list| list.iter().filter_map(Value::as_u64).collect::<Vec<u64>>());
    let (Some(ours), Some(theirs)) = (list(a), list(b)) else { return format!("{what}: {a} -> {b}") };
    let sum = |list: &[u64]| thousands(list.iter().sum());
    let first = ours.iter().zip(&theirs).position(|(a, b)| a != b).unwrap_or(ours.len().min(theirs.len()));
    format!("{what}: {} -> {} in all, the first difference at {first}", sum(&ours), sum(&theirs))
}
