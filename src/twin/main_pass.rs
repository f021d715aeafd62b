//! Twin of `glsl/main_pass.frag`: ray traversal [KW03 §2.1].

use super::{Effect, Pixel, Twin};

/// Joins the segment of main pass `pass` with what the pixel has already.
pub fn main_pass(twin: &Twin, pixel: &mut Pixel, pass: u32) -> Effect {
    if twin.importance.is_some() {
        return twin.adaptive_steps(pixel, Some(twin.scene.settings.sampling.samples_per_pass), false);
    }
    let (segment, effect) = twin.segment_color(pixel, pass);
    twin.gather(pixel, segment);
    effect
}

/// Joins the segment that ends at a surface with what the pixel has already.
pub fn partial_pass(twin: &Twin, pixel: &mut Pixel, pass: u32) -> Effect {
    twin.only_partial(pixel, pass).map_or(Effect::Silent, |last| main_pass(twin, pixel, last))
}
