//! Twin of `glsl/fused.frag`: a main pass that marks where the ray goes on [Thesis §5.7].

use super::{Effect, Pixel, Twin};
use crate::scene::Scene;
use crate::scene::settings::Accumulate;

/// More than a blend unit may take from an opacity below 1, or add to it, in a target of that format: some sixteen
/// units in the last place of an f32, eight of an f16, four of a byte. It rounds the source, the product and the sum,
/// to nearest or not.
pub fn blend_rounding(accumulate: Accumulate) -> f32 {
    match accumulate {
        Accumulate::Rgba32f => f32::exp2(-20.0),
        Accumulate::Rgba16f => f32::exp2(-8.0),
        Accumulate::Rgba8 => f32::exp2(-6.0),
    }
}

/// What a blend unit may take from what rays gather: nothing from the opacity 1 of those that have met a surface.
pub fn rounding_of_gathered(scene: &Scene) -> f32 {
    if scene.surface.is_some() { 0.0 } else { blend_rounding(scene.settings.image.accumulate) }
}

/// Joins the segment of main pass `pass` with what the pixel has already, where the ray has work there, and marks the
/// section in which it next has, or death.
pub fn fused(twin: &Twin, pixel: &mut Pixel, pass: u32) -> Effect {
    let mut next = if twin.saturated(pixel) { twin.passes } else { twin.next_section(pixel, pass) };
    let mut effect = Effect::Silent;
    let mut goes_on = true;
    if next == pass {
        let (segment, found) = twin.segment_color(pixel, pass);
        effect = found;
        twin.gather(pixel, segment);
        let certain = f64::from(rounding_of_gathered(twin.scene));
        let dead = twin.saturated_by(pixel, certain);
        goes_on = !twin.saturated_by(pixel, -certain);
        next = if dead { twin.passes } else { twin.next_section(pixel, pass + 1) };
    }
    pixel.stored = twin.decision_depth(pixel, next, goes_on);
    effect
}
