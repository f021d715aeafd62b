//! Twin of `glsl/block_skip.frag`: stopping criterion and empty blocks [KW03 §2.3].

use super::section::partial_depth;
use super::{DEAD, Effect, Pixel, SKIPPED, Twin};
use crate::structure::blocks::Blocks;

/// Marks the pixel dead, skipped or due for main pass `pass`.
///
/// # Panics
/// When the frame has no blocks; the plan of `rc-block` always has them.
pub fn block_skip(twin: &Twin, pixel: &mut Pixel, pass: u32) -> Effect {
    let blocks = twin.blocks.expect("block skipping is planned with blocks");
    let (first, end) = twin.segment(pixel, pass);
    let saturated = twin.saturated(pixel);
    if let Some(last) = twin.only_partial(pixel, pass).filter(|_| !saturated) {
        let (first, end) = twin.segment(pixel, last);
        let shows = (first..end).any(|i| visible(twin, blocks, pixel, i));
        pixel.stored = if shows { partial_depth(pixel.section) } else { DEAD };
        return Effect::Silent;
    }
    pixel.stored = if !saturated && twin.begins_later(pixel, pass) {
        SKIPPED
    } else if first >= end || saturated {
        DEAD
    } else if (first..end).any(|i| visible(twin, blocks, pixel, i)) {
        0.0
    } else {
        SKIPPED
    };
    Effect::Silent
}

/// Whether anything shows in the block of sample `i`; where samples stand for all values up to the next one, in the
/// blocks from there to that of the next one too.
fn visible(twin: &Twin, blocks: &Blocks, pixel: &mut Pixel, i: u32) -> bool {
    if !twin.scene.spans() {
        return twin.at_cell(pixel, i, |cell| blocks.visible(cell));
    }
    let [front, back] = match twin.slices {
        Some(_) => [i, i + 1].map(|i| twin.place_of(pixel, i)),
        None => twin.span(pixel, i).map(|steps| twin.position_at(pixel, steps)),
    };
    let ray = pixel.clone();
    let (found, undecided) = twin.at_cell_of(pixel, front, |from| {
        let mut other = ray.clone();
        let found = twin.at_cell_of(&mut other, back, |to| blocks.visible_between(from, to));
        (found, other.undecided)
    });
    pixel.undecided |= undecided;
    found
}
