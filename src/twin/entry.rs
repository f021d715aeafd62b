//! Twin of `glsl/entry.frag`: where the ray enters the volume [KW03 §2.1, pass 1].

use glam::DVec3;

use super::{Effect, Pixel, Twin, stored};

/// Fills `entry`, texture coordinates. A pixel whose ray misses keeps what it has.
pub fn entry(twin: &Twin, pixel: &mut Pixel, _: u32) -> Effect {
    let ray = twin.rays.of(pixel.column, pixel.row);
    let extent = twin.scene.field.extent();
    if let Some((enter, _)) = twin.scene.interval(&ray, twin.rays.near) {
        pixel.entry = stored(ray.at(enter) / extent + 0.5).clamp(DVec3::ZERO, DVec3::ONE);
    }
    Effect::Silent
}
