//! Two probes side by side: two devices, or two versions of a driver.

use super::text::rate;
use crate::probe::record::{MechanismRecord, Probe};

/// Rates within this factor are alike: machines are shared and noisy.
const ALIKE: f64 = 1.5;

/// What differs, a line each: which is which first.
pub fn compare(ours: &Probe, theirs: &Probe) -> Vec<String> {
    let name = |probe: &Probe| format!("{}, {} ({})", probe.device.name, probe.device.driver, probe.provenance.date);
    let mut found = vec![format!("this:  {}", name(ours)), format!("other: {}", name(theirs))];
    let before = found.len();
    let mut put = |what: String, this: String, other: String| {
        if this != other {
            found.push(format!("{what}: {this}; other: {other}"));
        }
    };
    let believed = |probe: &Probe| if probe.statistics.is_none() { "believed" } else { "not believed" }.to_owned();
    put("counts of shader invocations".to_owned(), believed(ours), believed(theirs));
    for line in &ours.lines {
        let Some(other) = theirs.lines.iter().find(|other| other.case == line.case) else {
            put(line.case.name(), "asked".to_owned(), "not asked".to_owned());
            continue;
        };
        put(format!("{}, right", line.case.name()), right(line, other), right(other, line));
        put(format!("{}, culled", line.case.name()), line.culled(), other.culled());
        if let (Some(this), Some(that)) = (line.rejected_per_second, other.rejected_per_second)
            && !(1.0 / ALIKE..=ALIKE).contains(&(this / that))
        {
            put(format!("{}, rejected in 1 s", line.case.name()), rate(this), rate(that));
        }
    }
    if found.len() == before {
        found.push("No difference.".to_owned());
    }
    found
}

/// Whether a line is right, in the formats that both were asked for.
fn right(line: &MechanismRecord, other: &MechanismRecord) -> String {
    let both = |format: &str| other.correct.iter().any(|correct| correct.format == format);
    let correct = line.correct.iter().filter(|correct| both(&correct.format)).cloned().collect();
    MechanismRecord { correct, ..line.clone() }.right()
}
