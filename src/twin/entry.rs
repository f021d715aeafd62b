//! Twin of `glsl/entry.frag`: where the ray enters the volume [KW03 §2.1, pass 1].

use glam::DVec3;

use super::{Effect, Pixel, Twin, stored};
use crate::math::ray::box_interval;

/// Fills `entry`, texture coordinates. A pixel whose ray misses keeps the clear value.
pub fn entry(twin: &Twin, pixel: &mut Pixel, _: u32) -> Effect {
    let direction = twin.rays.direction(pixel.column, pixel.row);
    let extent = twin.scene.field.extent();
    if let Some((enter, _)) = box_interval(twin.rays.eye, direction, 0.5 * extent, twin.rays.near) {
        let point = twin.rays.eye + enter * direction;
        pixel.entry = stored(point / extent + 0.5).clamp(DVec3::ZERO, DVec3::ONE);
    }
    Effect::Silent
}
