//! Twin of `glsl/main_pass.frag`: ray traversal [KW03 §2.1].

use super::{Effect, Pixel, Twin};
use crate::math::opacity::composite;

/// Puts the segment of main pass `pass` under what the pixel has already.
pub fn main_pass(twin: &Twin, pixel: &mut Pixel, pass: u32) -> Effect {
    let (segment, effect) = twin.segment_color(pixel, pass);
    pixel.accumulated = composite(pixel.accumulated, segment);
    effect
}
