//! Twin of `glsl/direction.frag`: direction and length of the ray [KW03 §2.1, pass 2].

use super::{Effect, Pixel, Twin, stored};

/// Fills `direction` and `length`, and sees whether f32 can tell the number of samples.
pub fn direction(twin: &Twin, pixel: &mut Pixel, _: u32) -> Effect {
    pixel.undecided |= passes_through(twin, pixel) && !twin.sample_count_decided(pixel);
    Effect::Silent
}

/// Fills `direction` and `length` of rays on which no samples are taken.
pub fn without_samples(twin: &Twin, pixel: &mut Pixel, _: u32) -> Effect {
    passes_through(twin, pixel);
    Effect::Silent
}

/// Fills `direction` and `length` where the ray passes through the volume, and says whether it does.
fn passes_through(twin: &Twin, pixel: &mut Pixel) -> bool {
    let ray = twin.rays.of(pixel.column, pixel.row);
    let extent = twin.scene.field.extent();
    let Some((_, leave)) = twin.scene.interval(&ray, twin.rays.near) else { return false };
    let way = ray.at(leave) - (pixel.entry - 0.5) * extent;
    // A ray so short that its ends are stored as one point has no direction.
    pixel.direction = stored(way.normalize_or_zero());
    pixel.length = f64::from(way.length() as f32);
    true
}
