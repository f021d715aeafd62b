//! Twin of `glsl/block_skip.frag`: stopping criterion and empty blocks [KW03 §2.3].

use super::{DEAD, Effect, Pixel, Twin};

/// Depth of a ray whose next segment is empty, as in the shader.
pub const SKIPPED: f64 = 0.5;

/// Marks the pixel dead, skipped or due for main pass `pass`.
///
/// # Panics
/// When the frame has no blocks; the plan of `rc-block` always has them.
pub fn block_skip(twin: &Twin, pixel: &mut Pixel, pass: u32) -> Effect {
    let blocks = twin.blocks.expect("block skipping is planned with blocks");
    let (first, end) = twin.segment(pixel, pass);
    let saturated = twin.saturated(pixel);
    pixel.stored = if first >= end || saturated {
        DEAD
    } else if (first..end).any(|i| twin.at_cell(pixel, i, |cell| blocks.visible(cell))) {
        0.0
    } else {
        SKIPPED
    };
    Effect::Silent
}
