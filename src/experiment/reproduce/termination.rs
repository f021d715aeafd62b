//! What early ray termination gains and loses in the single pass [Stegmaier05 §7]: "everything from a 20% performance loss
//! up to a 60% performance increase" for the semi-transparent engine, depending on transfer function and view.

use super::{ReproducedSet, Variant};
use crate::measure::record::Clock;
use crate::measure::{Run, Statistics};

/// Least and greatest gain in frames per second that the paper measured, as parts.
pub const PUBLISHED_GAIN: [f64; 2] = [-0.2, 0.6];

/// What was gained by one transfer function, over all directions.
#[derive(Clone, Debug, PartialEq)]
pub struct GainLine {
    /// The transfer function.
    pub value: String,
    /// A gain for each direction, as a part of the frames per second without early ray termination; below 0 where they are
    /// fewer with it.
    pub gains: Vec<f64>,
    pub statistics: Statistics,
}

/// A line for each transfer function that was timed.
pub fn gain_lines(column: &ReproducedSet, clock: Clock) -> Vec<GainLine> {
    let line = |variant: &Variant| {
        let gains = gains(variant, clock);
        Some(GainLine { value: variant.value.clone(), statistics: Statistics::of(&gains)?, gains })
    };
    column.variants.iter().filter_map(line).collect()
}

/// The gain of each direction whose frame was timed with early ray termination and without.
fn gains(variant: &Variant, clock: Clock) -> Vec<f64> {
    let ends = |run: &&Run| run.settings.sampling.termination < 1.0;
    let without: Vec<&Run> = variant.runs.iter().filter(|run| !ends(run)).collect();
    let gain = |with: &Run| {
        let without = without.iter().find(|run| run.settings.camera == with.settings.camera)?;
        let with = with.milliseconds(clock).filter(|ms| *ms > 0.0)?;
        Some(without.milliseconds(clock)? / with - 1.0)
    };
    variant.runs.iter().filter(ends).filter_map(gain).collect()
}

/// What the gains of the first transfer function, the one that is like the paper's, come to beside the paper's, in words made
/// from the numbers; none where nothing was timed.
pub fn gain_verdict(lines: &[GainLine]) -> Option<String> {
    let GainLine { value, statistics: Statistics { min, max, .. }, .. } = lines.first()?;
    let within = PUBLISHED_GAIN[0] <= *min && *max <= PUBLISHED_GAIN[1];
    let place = if within { "all of them within that range" } else { "not all of them within that range" };
    let [their_least, their_greatest] = PUBLISHED_GAIN.map(signed_percent);
    let [least, greatest] = [*min, *max].map(signed_percent);
    Some(format!(
        "The paper measured {their_least} to {their_greatest} %; here, {value}, {least} to {greatest} %, {place}."
    ))
}

/// A part as a percentage with its sign.
pub fn signed_percent(part: f64) -> String {
    format!("{:+.1}", 100.0 * part)
}
