//! All cases on a device, from the picture that is checked to the verdict.

use std::sync::Arc;

use super::case::{Case, FORMATS, Mechanism, format_name};
use super::correct::{Depth, faults};
use super::decide::Culling;
use super::marks::{MarkCost, mark_cost};
use super::measure::{How, ProbeClock, cost, rejection_rate, statistics, work};
use super::pipelines::shaders;
use super::record::{Correct, MechanismRecord, Other};
use super::rig::Rig;
use crate::error::{Error, Result};
use crate::glsl;
use crate::vulkan::{Device, has_stencil, vk};

/// Pixels of a side of the picture that is checked.
const CHECKED: u32 = 64;
/// And of that which is timed.
const TIMED: u32 = 256;
/// And of that which marks are timed with.
const MARKED: u32 = 512;

/// What was found, without what the program knows of itself.
pub struct Findings {
    pub clock: ProbeClock,
    pub statistics: Option<String>,
    pub work: u32,
    pub sides: [u32; 3],
    pub formats: Vec<String>,
    pub lines: Vec<MechanismRecord>,
    pub marks: MarkCost,
}

/// Rigs of one format.
struct Bench {
    format: vk::Format,
    checked: Rig,
    timed: Rig,
}

/// What the device lacks for a case; none where it can be asked.
pub fn missing(device: &Device, case: &Case) -> Option<String> {
    if case.mechanism.bounds() && !device.info.depth_bounds {
        return Some("no depth bounds test".to_owned());
    }
    (case.shader.stores() && !device.fragment_stores()).then(|| "no stores in fragment shaders".to_owned())
}

/// Asks everything. `quick`: one format, copied depths, one pair of bounds. `say` hears what is being done.
///
/// # Errors
/// What the driver reports.
pub fn probe(device: &Arc<Device>, quick: bool, say: &dyn Fn(&str)) -> Result<Findings> {
    let cases: Vec<Case> = Case::all().into_iter().filter(|case| missing(device, case).is_none()).collect();
    glsl::prepare(&shaders(&cases))?;
    let clock = ProbeClock::of(&device.info);
    let rate_side = if device.info.is_cpu() { TIMED } else { 4 * TIMED };
    let mut benches = Vec::new();
    let possible: Vec<vk::Format> = FORMATS.into_iter().filter(|format| Rig::possible(device, *format)).collect();
    let first = *possible.first().ok_or_else(|| {
        Error::device(&device.info.name, "no depth format that can be copied", "choose another device")
    })?;
    let stencil = possible.iter().copied().find(|format| has_stencil(*format));
    for format in possible.iter().copied().filter(|f| !quick || *f == first || Some(*f) == stencil) {
        let timed = Rig::new(device, format, TIMED)?;
        benches.push(Bench { format, checked: timed.beside(CHECKED)?, timed });
    }
    let mut rates = benches[0].timed.beside(rate_side)?;
    say("work");
    let doubt = statistics(&mut benches[0].timed)?;
    let how = How { clock, work: work(&mut benches[0].timed, clock)?, believed: doubt.is_none(), mixed: true };
    let mut lines = Vec::new();
    for case in Case::all() {
        say(&case.name());
        lines.push(line(device, &mut benches, &mut rates, &case, &how, quick)?);
    }
    say("marks");
    let marks = mark_cost(device, clock, MARKED, if quick { 5 } else { 15 })?;
    Ok(Findings {
        clock,
        statistics: doubt,
        work: how.work,
        sides: [CHECKED, TIMED, rate_side],
        formats: benches.iter().map(|bench| format_name(bench.format).to_owned()).collect(),
        lines,
        marks,
    })
}

fn line(
    device: &Device,
    benches: &mut [Bench],
    rates: &mut Rig,
    case: &Case,
    how: &How,
    quick: bool,
) -> Result<MechanismRecord> {
    let mut line = MechanismRecord {
        case: *case,
        promise: case.promise(),
        missing: missing(device, case),
        correct: Vec::new(),
        cost: None,
        others: Vec::new(),
        rejected_per_second: None,
    };
    let stencil = case.mechanism == Mechanism::Stencil;
    if stencil && !benches.iter().any(|bench| has_stencil(bench.format)) {
        line.missing = Some("no format with a stencil that can be copied".to_owned());
    }
    if line.missing.is_some() {
        return Ok(line);
    }
    let depth = if quick { Depth::Quick } else { Depth::Full };
    for (i, bench) in benches.iter_mut().filter(|bench| !stencil || has_stencil(bench.format)).enumerate() {
        // A quick probe has the format with a stencil for the stencil test alone.
        if quick && i > 0 {
            break;
        }
        let format = format_name(bench.format).to_owned();
        line.correct.push(Correct { format: format.clone(), faults: faults(&mut bench.checked, case, depth)? });
        let found = cost(&mut bench.timed, case, &How { mixed: i == 0, ..*how })?;
        if i == 0 {
            line.cost = Some(found);
        } else {
            line.others.push(Other { format, cost: found });
        }
    }
    if line.culling() == Some(Culling::Early) && !stencil {
        line.rejected_per_second = rejection_rate(rates, case, how.clock)?;
    }
    Ok(line)
}
