//! Sections of the depth range, one a main pass [Thesis §5.3]. Twin of `glsl/shared/section.glsl`.

use crate::scene::settings::DepthFormat;

/// Depth that marks `section` of `passes`: the middle of its part of [0, 0.5).
pub fn section_depth(section: u32, passes: u32) -> f64 {
    (f64::from(section) + 0.5) / (2.0 * f64::from(passes))
}

/// End of `section`: the upper depth bound of its passes.
pub fn section_end(section: u32, passes: u32) -> f64 {
    (f64::from(section) + 1.0) / (2.0 * f64::from(passes))
}

/// Depth above which no ray takes part in main passes: it is dead, or waits for the pass of segments that end at a surface.
pub const WAITING: f32 = 0.75;

/// Depth of a ray of which nothing is left but the segment that ends at a surface, in its part behind so many layers: below that
/// of a dead one, above those of all others [Thesis ch. 6 §7]. A ray that has no part behind a layer keeps its mark, which
/// must not be that of another part. A normalised format of 16 or 24 bits has no code halfway to the next at any of them, so that
/// it keeps one code whichever way it rounds.
pub fn partial_depth(section: u32) -> f64 {
    f64::from(WAITING) + f64::from(section + 1) / PARTIAL_STEPS
}

/// The depths of [`partial_depth`] are one part of so many apart.
const PARTIAL_STEPS: f64 = 512.0;

/// Half of what lies between two depths of [`partial_depth`].
pub const PARTIAL_REACH: f32 = 0.5 / PARTIAL_STEPS as f32;

/// Sections that a depth buffer of that format tells apart, whatever rounds to its codes. A mark lies at least a quarter
/// of a section from the next mark and from a bound (`fragdepth-any`), and its own rounding, that of the bound or of the
/// other mark and the device's conversion may each take half a code.
pub fn most_sections(depth: DepthFormat) -> u32 {
    let quarter = 1.5 * depth.resolution();
    (0.5 / (4.0 * quarter)) as u32
}

/// As in the shader, whose quotients it makes up for.
const QUOTIENT_ROUNDING: f64 = 1.0 / (1 << 20) as f64;

/// Samples `step` voxels apart that show nothing, from one on from which `way` voxels are free: those no farther from it,
/// itself among them.
pub fn free_samples(way: f64, step: f64) -> u32 {
    (way / step * (1.0 + QUOTIENT_ROUNDING)).floor() as u32 + 1
}
