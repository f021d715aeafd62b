//! The cases as lines for a terminal.

use super::{CaseRecord, Outcome, Stability, StabilityVerdict};

pub fn word(verdict: &StabilityVerdict) -> &'static str {
    match verdict {
        StabilityVerdict::Right => "right",
        StabilityVerdict::Wrong => "WRONG",
        StabilityVerdict::Missing => "not run",
    }
}

/// `3.1 % of what is allowed`, as far as there is a picture to compare.
pub fn share(share: Option<f64>) -> String {
    match share {
        Some(share) if share >= 10.0 => format!("{share:.0} times what is allowed"),
        Some(share) => format!("{:.1} % of what is allowed", 100.0 * share),
        None => String::new(),
    }
}

/// A case in one line.
pub fn line(case: &CaseRecord) -> String {
    let verdict = case.verdict();
    let run = case.outcomes.iter().filter(|o| o.verdict != StabilityVerdict::Missing).count();
    let methods = format!("{run} method{}", if run == 1 { "" } else { "s" });
    let mut parts = vec![methods, format!("held against {}", case.expected), share(case.share())];
    if verdict == StabilityVerdict::Missing {
        parts = case.outcomes.iter().filter_map(|o| o.remark.clone()).take(1).collect();
    }
    parts.retain(|part| !part.is_empty());
    format!("{:<8} {}: {} ({})", word(&verdict), case.group, case.name, parts.join(", "))
}

/// What is wrong, a line for all methods that have the same wrong.
pub fn faults(case: &CaseRecord) -> Vec<String> {
    let mut faults: Vec<(String, Vec<&str>)> = Vec::new();
    for Outcome { method, remark, .. } in case.outcomes.iter().filter(|o| o.verdict == StabilityVerdict::Wrong) {
        let remark = remark.clone().unwrap_or_default();
        match faults.iter_mut().find(|(known, _)| *known == remark) {
            Some((_, methods)) => methods.push(method),
            None => faults.push((remark, vec![method])),
        }
    }
    faults.into_iter().map(|(remark, methods)| format!("{}: {remark}", methods.join(", "))).collect()
}

/// Everything.
pub fn text(found: &Stability) -> String {
    let mut out = format!("{}, {}\n\n", found.device, found.driver);
    for case in &found.cases {
        out += &format!("{}\n", line(case));
        faults(case).iter().for_each(|fault| out += &format!("         {fault}\n"));
    }
    out += &format!("\n{}\n", found.summary());
    out
}
