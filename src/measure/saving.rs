//! What a method saves against `rc-ert`, the claim in numbers: fragments, time, and how much of the one became the other.

use super::fragment_kind::FragmentKind;
use super::record::{Clock, Run, Saved};

/// The method whose fragments and time are saved: rays end early, nothing is skipped [KW03 §2.1].
pub const AGAINST: &str = "rc-ert";

/// Fills in what each run saves against the `rc-ert` run of the same form, or else the first one. All are of one scene.
pub fn save(runs: &mut [&mut Run], on_cpu: bool) {
    // What `auto` has chosen may have another M.
    let is_rule = |run: &&&mut Run| run.method == AGAINST && !run.is_chosen_freely();
    let rules: Vec<Run> = runs.iter().filter(is_rule).map(|run| (**run).clone()).collect();
    for run in runs.iter_mut().filter(|run| run.method != AGAINST && run.method != "cpu") {
        let same = |rule: &&Run| (&rule.cull, &rule.mark) == (&run.cull, &run.mark);
        let Some(rule) = rules.iter().find(same).or_else(|| rules.first()) else { continue };
        let all = |run: &Run| run.fragments.main.saturating_add(run.fragments.intermediate) as f64;
        if all(rule) == 0.0 {
            continue;
        }
        let clock = Clock::on(on_cpu, rule.gpu_ms.is_some());
        let time = run
            .milliseconds(clock)
            .zip(rule.milliseconds(clock).filter(|ms| *ms > 0.0))
            .map(|(ours, theirs)| 1.0 - ours / theirs);
        let form = rule.form().map_or_else(String::new, |form| format!(" ({form})"));
        run.saved = Some(Saved {
            against: format!("{AGAINST}{form}"),
            fragments: (run.fragment_kind() == Some(FragmentKind::Segment)).then(|| 1.0 - all(run) / all(rule)),
            time,
            clock: time.map(|_| clock),
        });
    }
}
