//! Twin of `glsl/clip_begin.frag`.

use super::{Effect, Pixel, Surface, Twin};
use crate::scene::mesh::Windings;

/// Whether clip geometry keeps the volume where the ray begins.
pub fn clip_begin(twin: &Twin, pixel: &mut Pixel, _: u32) -> Effect {
    let kept = Windings::of_begin(pixel.entered).kept_by(twin.scene.polygons.clips());
    pixel.begin = Some(Surface { steps: 0.0, color: [0.0; 4], kept });
    Effect::Silent
}
