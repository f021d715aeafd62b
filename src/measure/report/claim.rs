//! The first paragraph: by how much the claimed method is below the baseline, said as the runs have it.

use crate::measure::comparison::{BASELINE, CLAIMED, Group, label};
use crate::measure::number::{percent, thousands};
use crate::measure::record::Run;

/// One sentence or two for each scene.
pub fn claims(groups: &[Group]) -> Vec<String> {
    if groups.is_empty() {
        return vec!["There are no runs.".to_string()];
    }
    groups.iter().map(claim).collect()
}

fn claim(group: &Group) -> String {
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
