//! The first paragraph: by how much the claimed method is below the baseline, said as the runs have it.

use crate::measure::record::Run;
use crate::measure::saving::AGAINST;
use crate::report::comparison::{BASELINE, CLAIMED, RunGroup, label};
use crate::report::cost::{extra_fetches, least_cost};
use crate::report::number::{percent, thousands};

/// One sentence or two for each scene.
pub fn claims(groups: &[RunGroup]) -> Vec<String> {
    if groups.is_empty() {
        return vec!["There are no runs.".to_string()];
    }
    groups.iter().filter(|group| extra_fetches(group) == least_cost(group, groups)).map(claim).collect()
}

/// Whether fragments saved become time saved on this device, in one sentence made from the runs: of each scene the
/// near-neighbor run that saves most time.
pub fn verdict(groups: &[RunGroup]) -> String {
    let Some(device) = groups.first().map(|group| group.first().device.clone()) else {
        return "There are no runs.".to_owned();
    };
    let near = |group: &RunGroup| -> Option<(String, f64, f64)> {
        let runs = group.runs.iter().map(|(_, run)| *run).filter(|run| run.marks_sections() && !run.is_chosen_freely());
        let saved = runs.filter_map(|run| {
            let saved = run.saved.as_ref()?;
            Some((label(run), saved.fragments?, saved.time?))
        });
        saved.max_by(|a, b| a.2.total_cmp(&b.2))
    };
    let plain = groups.iter().filter(|group| extra_fetches(group) == least_cost(group, groups));
    let best: Vec<(String, f64, f64)> = plain.filter_map(near).collect();
    if best.is_empty() {
        return format!("On {device} no run of near-neighbor skipping was timed beside one of {AGAINST}.");
    }
    if best.iter().all(|(_, fragments, _)| *fragments <= 0.0) {
        return format!(
            "On {device} near-neighbor skipping saves no fragments of {AGAINST} in any scene, and can save no time."
        );
    }
    let range = |of: &dyn Fn(&(String, f64, f64)) -> f64, digits: usize| {
        let (least, most) =
            best.iter().map(of).fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
        let (least, most) = (format!("{least:.digits$}"), format!("{most:.digits$}"));
        if least == most { least } else { format!("{least} to {most}") }
    };
    let paying = best.iter().filter(|(_, fragments, time)| *fragments > 0.0 && *time > 0.0).count();
    let answer = match (paying, best.len()) {
        (0, _) => "fragments saved do not become time saved".to_owned(),
        (all, scenes) if all == scenes => "fragments saved become time saved".to_owned(),
        (some, scenes) => format!("fragments saved become time saved in {some} of {scenes} scenes"),
    };
    let mut methods: Vec<&str> = best.iter().map(|(method, ..)| method.as_str()).collect();
    methods.sort_unstable();
    methods.dedup();
    let saving = best.iter().all(|(_, fragments, _)| *fragments > 0.0);
    let efficiency =
        if saving { format!(", a culling efficiency of {}", range(&|b| b.2 / b.1, 2)) } else { String::new() };
    format!(
        "On {device}, {answer}: {} saves {} % of the fragments of {AGAINST} and {} % of its time{efficiency}.",
        methods.join(" or "),
        range(&|b| 100.0 * b.1, 0),
        range(&|b| 100.0 * b.2, 0),
    )
}

fn claim(group: &RunGroup) -> String {
    let run = group.first();
    let scene = if run.view.is_empty() { run.scene.clone() } else { format!("{} ({})", run.scene, run.view) };
    let (Some(ours), Some(theirs)) = (group.claimed(), group.baseline()) else {
        let missing = if group.claimed().is_none() { CLAIMED } else { BASELINE };
        return format!("{scene}: no {missing} run, so {CLAIMED} and {BASELINE} cannot be compared.");
    };
    let sentence = |theirs: &Run| {
        let (a, b) = (&ours.fragments, &theirs.fragments);
        format!(
            "{} and {} than {}",
            difference(a.main, b.main, "main"),
            difference(a.intermediate, b.intermediate, "intermediate"),
            label(theirs)
        )
    };
    let mut text = format!("{scene}: {} runs {}.", label(ours), sentence(theirs));
    // Which order rc-block tests in changes its counts a good deal, so both are named where both were run.
    let other =
        group.runs.iter().map(|(_, run)| *run).find(|run| run.method == BASELINE && label(run) != label(theirs));
    if let Some(other) = other {
        text.push_str(&format!(" It runs {}.", sentence(other)));
    }
    text
}

/// `83.2 % fewer main fragments (50,123 against 299,356)`.
fn difference(ours: u64, theirs: u64, kind: &str) -> String {
    let counts = format!("({} against {})", thousands(ours), thousands(theirs));
    match percent(ours.abs_diff(theirs), theirs) {
        Some(by) if ours < theirs => format!("{by:.1} % fewer {kind} fragments {counts}"),
        Some(by) if ours > theirs => format!("{by:.1} % more {kind} fragments {counts}"),
        Some(_) => format!("no fewer {kind} fragments {counts}"),
        None => format!("{} more {kind} fragments {counts}", thousands(ours)),
    }
}
