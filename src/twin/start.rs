//! Twin of `glsl/start.frag`: what rays begin with.

use super::{Effect, Pixel, Twin};

/// Fills RES, opaque, with what a ray holds before its first sample, or for good where it is too short for one.
pub fn start(twin: &Twin, pixel: &mut Pixel, _: u32) -> Effect {
    let [mut value, ..] = twin.no_sample();
    if twin.levels.falls() {
        pixel.undecided |= !twin.sample_count_decided(pixel);
        if twin.sample_count(pixel) == 0 {
            value = twin.levels.end;
        }
    }
    pixel.accumulated = [value, value, value, 1.0];
    Effect::Silent
}
