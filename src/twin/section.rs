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
