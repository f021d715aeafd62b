//! Twin of `glsl/clip_winding.frag`, of all of a pixel's fragments at once.

use super::{Effect, Pixel, Twin};

/// Counts the fronts less the backs of each clip mesh that the ray meets.
pub fn clip_winding(twin: &Twin, pixel: &mut Pixel, _: u32) -> Effect {
    let polygons = &twin.scene.polygons;
    pixel.entered = polygons.entered(&polygons.crossings(&twin.rays, [pixel.column, pixel.row], 0.0).list);
    Effect::Silent
}
