//! How long draws take and how often their shaders run: with nothing rejected, with everything, and with patterns between.

use std::time::Instant;

use cpu_time::ProcessTime;
use serde::{Deserialize, Serialize};

use super::case::{Case, History};
use super::decide::{CullingVerdict, MeasuredWork, decide, doubtful, saved, tile, time_share};
use super::pattern::Pattern;
use super::rig::{Ask, Input, Rig};
use super::statistics::{Known, doubt};
use super::{CaseShader, Mechanism};
use crate::error::Result;
use crate::vulkan::{Commands, DeviceInfo, DeviceKind, Recorded};

/// What times are taken with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ProbeClock {
    /// Timestamps around the render pass.
    Timestamps,
    /// CPU time of the process, all threads: a device that is a CPU shades on them, and other work does not disturb it.
    ProcessCpu,
    /// From the submission to its end: the device has no timestamps.
    Wall,
}

impl ProbeClock {
    pub fn of(info: &DeviceInfo) -> Self {
        match (info.kind, info.timestamp_valid_bits) {
            (DeviceKind::Cpu, _) => Self::ProcessCpu,
            (_, 0) => Self::Wall,
            _ => Self::Timestamps,
        }
    }

    pub fn words(self) -> &'static str {
        match self {
            Self::Timestamps => "timestamps of the device",
            Self::ProcessCpu => "CPU time of the process",
            Self::Wall => "wall time: the device has no timestamps",
        }
    }

    /// A draw worth timing takes so long, milliseconds: well above the resolution and the fixed cost of a submission.
    fn worth(self) -> f64 {
        match self {
            Self::Timestamps => 1.0,
            Self::ProcessCpu => 5.0,
            Self::Wall => 8.0,
        }
    }
}

/// Rounds of work beyond which no shader is made more expensive.
const MOST_WORK: u32 = 1 << 16;

/// How often each draw is timed at first, and again while the times do not tell.
const ROUNDS: usize = 3;
/// Where the same was asked in another format, or of the whole picture.
const FEW_ROUNDS: usize = 2;
/// At most, of a pattern.
const MIXED_ROUNDS: usize = 8;
const MORE_ROUNDS: usize = 4;

/// A pattern and what it cost.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Mixed {
    pub pattern: String,
    /// Of all pixels.
    pub rejected: f64,
    pub invocations: Option<u64>,
    pub ms: Vec<f64>,
    /// Of what is rejected, 0 to 1.
    pub saved: Option<f64>,
}

/// All that was measured of a case, in one format.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Cost {
    /// Of nothing and of everything rejected.
    pub invocations: Option<[u64; 2]>,
    pub none_ms: Vec<f64>,
    pub all_ms: Vec<f64>,
    pub verdict: CullingVerdict,
    /// Patterns, of a case that is culled early.
    pub mixed: Vec<Mixed>,
    /// Side of the squares from which on culling sets in.
    pub tile: Option<u32>,
}

/// The picture of a pattern.
pub fn input(rig: &Rig, case: &Case, pattern: Pattern, work: u32) -> Input {
    let setup = case.setup();
    let kept = |depth| rig.precision.nearest(depth);
    let (stored, mask) = (case.stored(), pattern.mask(rig.side));
    let written = case.writable(setup.drawn);
    Input {
        setup: super::rule::Setup { drawn: kept(setup.drawn), bounds: setup.bounds.map(kept) },
        stored: mask.iter().map(|rejected| kept(if *rejected { stored.dead } else { stored.alive })).collect(),
        // Another depth than the rasterised one wherever the shader may.
        written: vec![kept(written[written.len() - 1]); mask.len()],
        stencil: mask.iter().map(|rejected| u8::from(!rejected)).collect(),
        history: History::Copy,
        work,
        draws: 1,
    }
}

/// A draw that can be repeated.
pub(super) struct Timed {
    recorded: Recorded,
}

impl Timed {
    /// What was recorded with [`Ask::Time`] and stamped.
    pub fn of(recorded: Recorded) -> Self {
        Self { recorded }
    }

    pub fn new(rig: &mut Rig, case: &Case, input: &Input) -> Result<Self> {
        rig.load(input)?;
        let device = rig.device().clone();
        let mut commands = Commands::begin(&device, &device.graphics, &case.name())?;
        rig.record(&mut commands, case, input, Ask::Time)?;
        rig.stamp(&mut commands);
        Ok(Self::of(commands.finish()?))
    }

    pub fn ms(&self, rig: &Rig, clock: ProbeClock) -> Result<f64> {
        let device = rig.device();
        let (wall, cpu) = (Instant::now(), ProcessTime::now());
        device.graphics.submit(&self.recorded, &[])?.wait()?;
        let (wall, cpu) = (wall.elapsed(), cpu.elapsed());
        Ok(match (clock, &rig.timestamps) {
            (ProbeClock::Timestamps, Some(pool)) => {
                let ticks = pool.read(0..2)?;
                device.elapsed_ms(ticks[0], ticks[1])
            }
            (ProbeClock::ProcessCpu, _) => cpu.as_secs_f64() * 1e3,
            _ => wall.as_secs_f64() * 1e3,
        })
    }
}

fn invocations(rig: &mut Rig, case: &Case, input: &Input) -> Result<Option<u64>> {
    if rig.statistics.is_none() {
        return Ok(None);
    }
    rig.load(input)?;
    let device = rig.device().clone();
    let mut commands = Commands::begin(&device, &device.graphics, &case.name())?;
    rig.record(&mut commands, case, input, Ask::Invocations)?;
    device.graphics.submit(&commands.finish()?, &[])?.wait()?;
    rig.statistics.as_ref().map(|pool| pool.read(0..1).map(|counts| counts[0])).transpose()
}

/// A case whose counts and whose cost are known: early tests before a shader that changes nothing else.
const KNOWN: Case =
    Case { mechanism: Mechanism::DepthRead, shader: CaseShader::Early, compare: super::Compare::GreaterOrEqual };

/// Why the driver's counts of invocations are not believed; none where they are.
///
/// # Errors
/// What the driver reports.
pub fn statistics(rig: &mut Rig) -> Result<Option<String>> {
    let mut counted = [0; 3];
    for (count, pattern) in counted.iter_mut().zip([Pattern::None, Pattern::All, Pattern::Halves]) {
        let input = input(rig, &KNOWN, pattern, 1);
        match invocations(rig, &KNOWN, &input)? {
            Some(found) => *count = found,
            None => return Ok(Some("the device has none".to_owned())),
        }
    }
    let [none, all, half] = counted;
    Ok(doubt(&Known { pixels: u64::from(rig.side).pow(2), none, all, half }))
}

/// Rounds of work that make the shader worth timing.
///
/// # Errors
/// What the driver reports.
pub fn work(rig: &mut Rig, clock: ProbeClock) -> Result<u32> {
    let mut work = 16;
    loop {
        let input = input(rig, &KNOWN, Pattern::None, work);
        let timed = Timed::new(rig, &KNOWN, &input)?;
        // The first draw with a pipeline is slow.
        timed.ms(rig, clock)?;
        let ms = timed.ms(rig, clock)?.min(timed.ms(rig, clock)?);
        if ms >= clock.worth() || work >= MOST_WORK {
            return Ok(work);
        }
        work = (f64::from(work) * (clock.worth() / ms).clamp(1.5, 8.0)).ceil().min(f64::from(MOST_WORK)) as u32;
    }
}

/// What is the same for all cases on a device.
#[derive(Clone, Copy, Debug)]
pub struct How {
    pub clock: ProbeClock,
    pub work: u32,
    /// Invocations are believed.
    pub believed: bool,
    /// Patterns between none and all.
    pub mixed: bool,
}

/// Whether a case is culled, and with which patterns.
///
/// # Errors
/// What the driver reports.
pub fn cost(rig: &mut Rig, case: &Case, how: &How) -> Result<Cost> {
    let mut measured = MeasuredWork::default();
    let ends = [Pattern::None, Pattern::All].map(|pattern| input(rig, case, pattern, how.work));
    if let (Some(none), Some(all)) = (invocations(rig, case, &ends[0])?, invocations(rig, case, &ends[1])?) {
        measured.invocations = Some([none, all]);
    }
    for rounds in 0..MORE_ROUNDS {
        for (input, pattern) in ends.iter().zip([Pattern::None, Pattern::All]) {
            let timed = Timed::new(rig, case, input)?;
            if rounds == 0 {
                timed.ms(rig, how.clock)?;
            }
            for _ in 0..if how.mixed { ROUNDS } else { FEW_ROUNDS } {
                let ms = timed.ms(rig, how.clock)?;
                let list = if pattern == Pattern::None { &mut measured.none_ms } else { &mut measured.all_ms };
                list.push(ms);
            }
        }
        if time_share(&measured).is_some() {
            break;
        }
    }
    // A shader that looks for itself is invoked in any case.
    let verdict = decide(&measured, how.believed && !case.mechanism.in_shader());
    let MeasuredWork { invocations: counted, none_ms, all_ms } = measured;
    let mut cost = Cost { invocations: counted, none_ms, all_ms, verdict, mixed: Vec::new(), tile: None };
    if how.mixed && cost.verdict.culling != super::Culling::Late {
        for pattern in Pattern::MIXED {
            let mixed = mixed(rig, case, pattern, how, &cost)?;
            cost.mixed.push(mixed);
        }
        for _ in 0..MORE_ROUNDS {
            let Some(side) = doubtful(&by_tile(&cost.mixed)) else { break };
            let at = Pattern::MIXED.iter().position(|pattern| pattern.tile() == Some(side));
            let at = at.expect("sides are those of the patterns");
            let again = mixed(rig, case, Pattern::MIXED[at], how, &cost)?;
            cost.mixed[at].add(again);
        }
        cost.tile = tile(&by_tile(&cost.mixed));
    }
    Ok(cost)
}

/// What squares of each side saved.
fn by_tile(mixed: &[Mixed]) -> Vec<(u32, f64)> {
    let sides = Pattern::MIXED.iter().map(|pattern| pattern.tile());
    sides.zip(mixed).filter_map(|(side, mixed)| side.zip(mixed.saved)).collect()
}

impl Mixed {
    /// The same pattern measured again: other work on the machine only ever hides what is saved.
    fn add(&mut self, again: Self) {
        self.ms.extend(again.ms);
        self.saved = match (self.saved, again.saved) {
            (Some(a), Some(b)) => Some(a.max(b)),
            (a, b) => a.or(b),
        };
    }
}

fn mixed(rig: &mut Rig, case: &Case, pattern: Pattern, how: &How, ends: &Cost) -> Result<Mixed> {
    let input = input(rig, case, pattern, how.work);
    let counted = invocations(rig, case, &input)?;
    let timed = Timed::new(rig, case, &input)?;
    let mask = pattern.mask(rig.side);
    let rejected = mask.iter().filter(|r| **r).count() as f64 / mask.len() as f64;
    let least = |times: &[f64]| times.iter().copied().fold(f64::INFINITY, f64::min);
    let mut ms = Vec::new();
    let mut by_time = None;
    for round in 1..=MIXED_ROUNDS {
        ms.push(timed.ms(rig, how.clock)?);
        by_time = saved(least(&ms), least(&ends.none_ms), least(&ends.all_ms), rejected);
        // Between all and nothing it may be noise, which more rounds take away.
        if round >= FEW_ROUNDS && by_time.is_none_or(|saved| !(0.1..0.9).contains(&saved)) {
            break;
        }
    }
    Ok(Mixed { pattern: pattern.name(), rejected, invocations: counted, ms, saved: by_time })
}

/// Fragments that a case rejects in a second, with nothing else to do; none where the draws take no time that can be
/// told.
///
/// # Errors
/// What the driver reports.
pub fn rejection_rate(rig: &mut Rig, case: &Case, clock: ProbeClock) -> Result<Option<f64>> {
    let pixels = f64::from(rig.side) * f64::from(rig.side);
    let mut few = input(rig, case, Pattern::All, 1);
    let mut draws = 1;
    loop {
        few.draws = draws;
        let more = Input { draws: 2 * draws, ..few.clone() };
        let mut least = [f64::INFINITY; 2];
        for (least, input) in least.iter_mut().zip([&few, &more]) {
            let timed = Timed::new(rig, case, input)?;
            for _ in 0..ROUNDS {
                *least = least.min(timed.ms(rig, clock)?);
            }
        }
        // What twice the draws take more is free of what a submission costs.
        let ms = least[1] - least[0];
        if ms >= 0.5 * clock.worth() || draws >= 4096 {
            return Ok((ms > 0.0).then(|| pixels * f64::from(draws) / (ms * 1e-3)));
        }
        draws *= 4;
    }
}
