//! Twin of `glsl/start.frag`: what rays begin with.

use super::{Effect, Pixel, Twin};

/// Fills RES, opaque, with what a ray holds before its first sample, or for good where it is too short for one.
pub fn start(twin: &Twin, pixel: &mut Pixel, _: u32) -> Effect {
    let [mut value, ..] = twin.no_sample();
    if twin.levels.falls() {
        let (samples, decided) = match twin.slices {
            Some(_) => twin.slices_met(pixel),
            None => (twin.sample_count(pixel), twin.sample_count_decided(pixel)),
        };
        pixel.undecided |= !decided;
        if samples == 0 {
            value = twin.levels.end;
        }
    }
    pixel.accumulated = [value, value, value, 1.0];
    Effect::Silent
}

/// Fills RES, opaque, with what a ray holds that meets no shell.
pub fn black(_: &Twin, pixel: &mut Pixel, _: u32) -> Effect {
    pixel.accumulated = [0.0, 0.0, 0.0, 1.0];
    Effect::Silent
}
