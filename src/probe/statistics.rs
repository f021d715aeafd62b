//! Whether a driver's count of shader invocations can be believed: it is held against draws whose count is known.

/// Invocations of draws of a picture of `pixels` pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Known {
    pub pixels: u64,
    /// Nothing rejected.
    pub none: u64,
    /// Every pixel rejected by a shader with `early_fragment_tests`, which promises not to run.
    pub all: u64,
    /// Half of them rejected so, in one piece.
    pub half: u64,
}

/// A count may lack this part: drivers add up what several groups of threads counted, and the last may come late.
const LESS: f64 = 0.999;
/// Helper invocations at edges may be counted.
const MORE: f64 = 1.3;
/// Shaders run in groups, so that this part of a picture may run beside an edge.
const BESIDE: f64 = 0.1;

/// Why the counts are not believed; none where they are.
pub fn doubt(known: &Known) -> Option<String> {
    let part = |count: u64| count as f64 / known.pixels as f64;
    let within = |count: u64, expected: f64| {
        let part = part(count);
        part >= expected * LESS && part <= expected * MORE + BESIDE
    };
    for (what, count, expected) in [("all", known.none, 1.0), ("half of", known.half, 0.5), ("none of", known.all, 0.0)]
    {
        if !within(count, expected) {
            return Some(format!("{count} invocations are counted where {what} {} fragments run", known.pixels));
        }
    }
    None
}
