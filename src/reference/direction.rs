//! Twin of `glsl/direction.frag`: direction and length of the ray [KW03 §2.1, pass 2].

use super::{Effect, Pixel, Twin};
use crate::math::ray::box_interval;

/// Fills `direction` and `length`, and sees whether f32 can tell the number of samples.
pub fn direction(twin: &Twin, pixel: &mut Pixel, _: u32) -> Effect {
    let direction = twin.rays.direction(pixel.column, pixel.row);
    let half = 0.5 * twin.scene.field.extent();
    if let Some((enter, leave)) = box_interval(twin.rays.eye, direction, half, twin.rays.near) {
        pixel.direction = direction.normalize();
        pixel.length = (leave - enter) * direction.length();
        pixel.undecided |= !twin.sample_count_decided(pixel);
    }
    Effect::Silent
}
