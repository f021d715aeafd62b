//! Twin of `glsl/termination.frag`: the stopping criterion of `rc-ert` [KW03 §2.1].

use super::section::partial_depth;
use super::{DEAD, Effect, Pixel, SKIPPED, Twin};

/// Marks the pixel dead when its ray is saturated or has left before main pass `pass`.
pub fn termination(twin: &Twin, pixel: &mut Pixel, pass: u32) -> Effect {
    let (first, end) = twin.segment(pixel, pass);
    let gone = if twin.importance.is_some() { twin.has_left(pixel) } else { first >= end };
    let saturated = twin.saturated(pixel);
    pixel.stored = match () {
        () if saturated => DEAD,
        () if twin.only_partial(pixel, pass).is_some() => partial_depth(pixel.section),
        () if twin.begins_later(pixel, pass) => SKIPPED,
        () if gone => DEAD,
        () => 0.0,
    };
    Effect::Silent
}
