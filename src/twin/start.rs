//! Twin of `glsl/start.frag`: what rays begin with.

use super::{Effect, Pixel, Twin};

/// Fills RES, opaque, with the value of a ray without samples.
pub fn start(twin: &Twin, pixel: &mut Pixel, _: u32) -> Effect {
    let [r, g, b, _] = twin.no_sample();
    pixel.accumulated = [r, g, b, 1.0];
    Effect::Silent
}
