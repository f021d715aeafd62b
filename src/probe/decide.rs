//! From measurements to a verdict: whether fragments that a mechanism rejects are rejected before their shader runs.

use serde::{Deserialize, Serialize};

/// What was measured of one case: nothing rejected, and all.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MeasuredWork {
    /// Invocations of the shader, where they are counted.
    pub invocations: Option<[u64; 2]>,
    /// Times of repeated draws.
    pub none_ms: Vec<f64>,
    pub all_ms: Vec<f64>,
}

/// When rejected fragments are rejected.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Culling {
    /// Before the shader.
    Early,
    /// After it.
    Late,
    /// Some before, some after.
    Partly,
    /// Measurements do not tell.
    Unclear,
}

impl Culling {
    pub fn word(self) -> &'static str {
        match self {
            Self::Early => "early",
            Self::Late => "late",
            Self::Partly => "partly",
            Self::Unclear => "unclear",
        }
    }
}

/// A verdict and what it rests on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CullingVerdict {
    pub culling: Culling,
    /// `invocations and time`, `invocations`, `time`, or `nothing`.
    pub by: String,
    /// Share of the shader's work that is still done where everything is rejected.
    pub share: Option<f64>,
    /// Where the two measures disagree.
    pub remark: Option<String>,
}

/// Shares up to this are early, from 1 less this on late.
const CLEAR: f64 = 0.25;

/// Times of one kind may differ by this factor before nothing is read from them.
const NOISE: f64 = 3.0;

/// Invocations are trusted only where `believed` (see [`super::statistics`]). Where time is clear and says another
/// thing, time is right: a driver that counts what it does not run, or does not count what it runs, cannot hide its work.
pub fn decide(measured: &MeasuredWork, believed: bool) -> CullingVerdict {
    let counted = measured.invocations.filter(|[none, _]| believed && *none > 0);
    let counted = counted.map(|[none, all]| all as f64 / none as f64);
    let timed = time_share(measured);
    let verdict = |culling, by: &str, share, remark| CullingVerdict { culling, by: by.to_owned(), share, remark };
    match (counted, timed) {
        (Some(counted), Some(timed)) => {
            let (by_count, by_time) = (culling(counted), culling(timed));
            // A group of lanes that runs for some is paid for by all, which time sees and a count need not.
            if by_count == by_time || by_count == Culling::Partly || by_time == Culling::Partly {
                let both = if by_count == by_time { by_count } else { Culling::Partly };
                return verdict(both, "invocations and time", Some(counted), None);
            }
            let remark = format!(
                "invocations say {} ({:.0} %), time says {} ({:.0} %)",
                by_count.word(),
                100.0 * counted,
                by_time.word(),
                100.0 * timed
            );
            verdict(by_time, "time", Some(timed), Some(remark))
        }
        (Some(counted), None) => verdict(culling(counted), "invocations", Some(counted), None),
        (None, Some(timed)) => verdict(culling(timed), "time", Some(timed), None),
        (None, None) => verdict(Culling::Unclear, "nothing", None, None),
    }
}

fn culling(share: f64) -> Culling {
    match share {
        share if share <= CLEAR => Culling::Early,
        share if share >= 1.0 - CLEAR => Culling::Late,
        _ => Culling::Partly,
    }
}

/// The share by time; none where there are no times, or they are so noisy that another one would follow from others of
/// them. Other work on the machine only ever adds to a time, so the least of each kind is the best one.
pub fn time_share(measured: &MeasuredWork) -> Option<f64> {
    let (none, all) = (extremes(&measured.none_ms)?, extremes(&measured.all_ms)?);
    if none[0] <= 0.0 {
        return None;
    }
    let share = all[0] / none[0];
    // The best of one kind may be a lucky one: half the times have to say the same.
    let middle = |times: &[f64]| {
        let mut sorted = times.to_vec();
        sorted.sort_by(f64::total_cmp);
        sorted[sorted.len() / 2]
    };
    let typical = middle(&measured.all_ms) / middle(&measured.none_ms).max(f64::MIN_POSITIVE);
    let noisy = none[1] > NOISE * none[0] && culling(typical) != culling(share);
    (!noisy && culling(typical) == culling(share)).then_some(share)
}

fn extremes(times: &[f64]) -> Option<[f64; 2]> {
    let finite = times.iter().all(|t| t.is_finite());
    let least = times.iter().copied().reduce(f64::min)?;
    finite.then_some([least, times.iter().copied().fold(least, f64::max)])
}

/// How much of what a pattern rejects was saved, from the shares of work with it, with nothing and with everything
/// rejected: 0 where it costs as much as nothing rejected, 1 where only the others cost.
pub fn saved(pattern: f64, none: f64, all: f64, rejected: f64) -> Option<f64> {
    let whole = none - all;
    (whole > 0.0 && rejected > 0.0).then(|| ((none - pattern) / whole / rejected).clamp(0.0, 1.0))
}

/// The side of the smallest squares from which on at least half of what is rejected is saved; `saved` by side. None
/// where not even the largest save that much.
pub fn tile(saved: &[(u32, f64)]) -> Option<u32> {
    let mut by_side = saved.to_vec();
    by_side.sort_by_key(|(side, _)| std::cmp::Reverse(*side));
    by_side.into_iter().take_while(|(_, saved)| *saved >= 0.5).last().map(|(side, _)| side)
}

/// The side of squares that seem to save less than half where smaller ones save at least that: where small squares are
/// rejected before their shader, so are large ones, and the measurement is at fault. The largest such side.
pub fn doubtful(saved: &[(u32, f64)]) -> Option<u32> {
    let clear = |(_, saved): &&(u32, f64)| *saved >= 0.5;
    let smallest = saved.iter().filter(clear).map(|(side, _)| *side).min()?;
    saved.iter().filter(|one| !clear(one) && one.0 > smallest).map(|(side, _)| *side).max()
}
