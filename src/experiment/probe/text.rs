//! The table of a probe: a line for each mechanism with each shader, in words.

use std::fmt::Write;

use crate::measure::statistics::Statistics;
use crate::probe::record::{MechanismRecord, Probe};
use crate::probe::{CaseFault, Culling, Mechanism};
use crate::report::number::thousands;
use crate::report::table::{Column, Table, TextLayout};

/// Lines of a probe as rows of a table.
pub(super) fn table<'a>(lines: impl Iterator<Item = &'a MechanismRecord>) -> Table {
    let heads = ["shader", "right", "culled", "by the specification", "work left", "rejected in 1 s"];
    let mut table = Table::new(heads.map(Column::words).to_vec());
    lines.for_each(|line| table.row(row(line)));
    table
}

/// Everything, for a terminal.
pub fn text(probe: &Probe) -> String {
    let mut out = String::new();
    // Writing to a string cannot fail.
    let _ = writeln!(out, "{}, {}", probe.device.name, probe.device.driver);
    for line in facts(probe) {
        let _ = writeln!(out, "  {}: {}", line.0, line.1);
    }
    let layout = TextLayout { indent: 2, least: table(probe.lines.iter()).widths(), ..TextLayout::default() };
    for mechanism in Mechanism::ALL {
        let _ = writeln!(out, "\n{}", mechanism.words());
        let lines = || probe.lines.iter().filter(|line| line.case.mechanism == mechanism);
        if let Some(why) = lines().next().and_then(|line| line.missing.as_ref())
            && lines().all(|line| line.missing.is_some())
        {
            let _ = writeln!(out, "  not available: {why}");
            continue;
        }
        out += &table(lines()).text(&layout);
    }
    let faults = fault_lines(probe);
    if !faults.is_empty() {
        let _ = writeln!(out, "\nWrong, the first case of each kind:");
        faults.iter().for_each(|fault| {
            let _ = writeln!(out, "  {fault}");
        });
    }
    let _ = writeln!(out);
    for sentence in summary(probe) {
        let _ = writeln!(out, "{sentence}");
    }
    out
}

/// What the numbers rest on.
pub(super) fn facts(probe: &Probe) -> Vec<(&'static str, String)> {
    let yes = |has: bool| if has { "yes" } else { "no" };
    let device = &probe.device;
    let believed = probe.statistics.as_ref().map_or("believed".to_owned(), |why| format!("not believed: {why}"));
    vec![
        ("depth bounds test", yes(device.depth_bounds).to_owned()),
        ("exact occlusion counts", yes(device.occlusion_precise).to_owned()),
        ("counts of shader invocations", believed),
        ("times", probe.clock.words().to_owned()),
        ("depth formats", probe.formats.join(", ")),
    ]
}

fn row(line: &MechanismRecord) -> [String; 6] {
    let share = line.cost.as_ref().and_then(|cost| cost.verdict.share);
    [
        line.case.shader_words(),
        line.missing.as_ref().map_or_else(|| line.right(), |why| format!("- ({why})")),
        line.culled(),
        line.promise.word().to_owned(),
        share.map_or("-".to_owned(), |share| format!("{:.0} %", 100.0 * share)),
        line.rejected_per_second.map_or("-".to_owned(), rate),
    ]
}

/// `12.3 M`.
pub(super) fn rate(per_second: f64) -> String {
    match per_second {
        r if r >= 1e9 => format!("{:.1} G", r / 1e9),
        r if r >= 1e6 => format!("{:.1} M", r / 1e6),
        r => thousands(r as u64),
    }
}

/// The first fault of each kind, ready to be pasted into a report of a bug, and where else it is; all of them are in the
/// JSON.
pub(super) fn fault_lines(probe: &Probe) -> Vec<String> {
    let all: Vec<(&MechanismRecord, &CaseFault)> =
        probe.lines.iter().flat_map(|line| line.faults().map(move |fault| (line, fault))).collect();
    let kind = |(line, fault): &(&MechanismRecord, &CaseFault)| (line.case.mechanism, fault.what.clone());
    let mut kinds: Vec<_> = all.iter().map(kind).collect();
    kinds.dedup();
    let mut lines = Vec::new();
    for (i, found) in kinds.iter().enumerate() {
        if kinds[..i].contains(found) {
            continue;
        }
        let these: Vec<_> = all.iter().filter(|one| kind(one) == *found).collect();
        let Some((first, fault)) = these.first() else { continue };
        let list = |words: &dyn Fn(&(&MechanismRecord, &CaseFault)) -> String| {
            let mut list: Vec<String> = Vec::new();
            for one in &these {
                let word = words(one);
                if !list.contains(&word) {
                    list.push(word);
                }
            }
            list
        };
        let shaders = list(&|(line, _)| line.case.shader_words()).len();
        let (formats, histories) =
            (list(&|(_, fault)| fault.format.clone()), list(&|(_, fault)| fault.history.words().to_owned()));
        let mut line = fault.line(&first.case);
        if these.len() > 1 {
            line += &format!(
                " ({} in all: {shaders} shaders, {}, {})",
                these.len(),
                formats.join(", "),
                histories.join(", ")
            );
        }
        lines.push(line);
    }
    lines
}

/// What it comes to, in sentences made from the measurements.
pub fn summary(probe: &Probe) -> Vec<String> {
    let asked: Vec<&MechanismRecord> = probe.lines.iter().filter(|line| line.missing.is_none()).collect();
    let wrong = asked.iter().filter(|line| line.faults().next().is_some()).count();
    let mut sentences = vec![match wrong {
        0 => format!("All {} cases are right.", asked.len()),
        _ => format!("{wrong} of {} cases are wrong.", asked.len()),
    }];
    sentences.push(depth_bounds(&asked));
    let remarks = asked.iter().filter_map(|line| line.cost.as_ref()?.verdict.remark.as_ref().map(|r| (line, r)));
    sentences.extend(remarks.map(|(line, remark)| format!("{}: {remark}.", line.case.name())));
    let median = |ms: &[f64]| Statistics::of(ms).map(|s| s.median);
    let marks = &probe.marks;
    if let (Some(fragdepth), Some(copy)) = (median(&marks.fragdepth_ms), median(&marks.copy_ms)) {
        sentences.push(format!(
            "Marking {0} x {0} pixels takes {fragdepth:.3} ms by gl_FragDepth and {copy:.3} ms by a copy.",
            marks.side
        ));
    }
    sentences
}

/// The thesis' open question, answered for this driver.
fn depth_bounds(asked: &[&MechanismRecord]) -> String {
    let bounds: Vec<&&MechanismRecord> = asked.iter().filter(|line| line.case.mechanism.bounds()).collect();
    if bounds.is_empty() {
        return "The device has no depth bounds test.".to_owned();
    }
    let part = |name: &str, of: &dyn Fn(&MechanismRecord) -> bool| {
        let these: Vec<&&&MechanismRecord> = bounds.iter().filter(|line| of(line)).collect();
        let early = these.iter().filter(|line| line.culling() == Some(Culling::Early)).count();
        match (early, these.len()) {
            (0, _) => format!("never where {name}"),
            (early, all) if early == all => format!("always where {name}"),
            (early, all) => format!("in {early} of {all} cases where {name}"),
        }
    };
    format!(
        "The depth bounds test keeps the shader from running {}, {}, {}.",
        part("the shader writes nothing but colour", &|l| {
            l.case.shader.conservative().is_none() && !l.case.shader.stores()
        }),
        part("it changes depth", &|l| l.case.shader.conservative().is_some() && !l.case.shader.stores()),
        part("it stores and declares early tests", &|l| l.case.shader.stores() && l.case.shader.early()),
    )
}
