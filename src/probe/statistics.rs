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

/// Helper invocations at edges may be counted.
const MORE: f64 = 1.3;

/// Why the counts are not believed; none where they are.
pub fn doubt(known: &Known) -> Option<String> {
    let part = |count: u64| count as f64 / known.pixels as f64;
    let within = |count: u64, expected: f64| {
        let part = part(count);
        // Shaders run in groups, so that a tenth may run beside an edge.
        part >= expected * 0.999 && part <= expected * MORE + 0.1
    };
    for (what, count, expected) in [("all", known.none, 1.0), ("half of", known.half, 0.5), ("none of", known.all, 0.0)]
    {
        if !within(count, expected) {
            return Some(format!("{count} invocations are counted where {what} {} fragments run", known.pixels));
        }
    }
    None
}
