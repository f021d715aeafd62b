//! Twin of `glsl/backdrop.frag` and `glsl/shared/backdrop.glsl`: what is behind the volume [Stegmaier05 §4].

use super::{Effect, Pixel, Twin};
use crate::scene::Backdrop;

/// How far f32 may have the place straight behind a pixel, in pixels: some roundings of a place in a view of up to a thousand pixels.
const STRAIGHT_ROUNDING: f64 = 2e-4;

/// How far f32 may have the place that is met from a point of the volume, as a part of the view: some 2^-22 of the way to it, and what
/// the roundings of eye and plane add.
const MET_ROUNDING: f64 = 2e-6;

/// What every pixel begins with.
pub fn backdrop(twin: &Twin, pixel: &mut Pixel, _: u32) -> Effect {
    if let Some(backdrop) = &twin.scene.backdrop {
        let [r, g, b] = twin.straight_behind(backdrop, pixel);
        pixel.accumulated = [r, g, b, 1.0];
    }
    Effect::Silent
}

impl Twin<'_> {
    fn straight_behind(&self, backdrop: &Backdrop, pixel: &mut Pixel) -> [f64; 3] {
        let place = [pixel.column, pixel.row].map(|at| f64::from(at) + 0.5);
        self.seen_at(backdrop, pixel, place, STRAIGHT_ROUNDING)
    }

    /// What is seen in a place that f32 has so many pixels off.
    fn seen_at(&self, backdrop: &Backdrop, pixel: &mut Pixel, place: [f64; 2], off: f64) -> [f64; 3] {
        let view = self.scene.settings.image.size;
        pixel.undecided |= backdrop.to_edge(view[1], place) < off;
        let color = backdrop.color(view, place);
        let beside = |x: f64, y: f64| backdrop.color(view, [place[0] + x * off, place[1] + y * off]);
        let apart = |other: [f64; 3]| (0..3).map(|c| (other[c] - color[c]).abs()).fold(0.0, f64::max);
        let most = [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)].map(|(x, y)| apart(beside(x, y)));
        pixel.rounding += 2.0 * most.into_iter().fold(0.0, f64::max);
        color
    }

    /// Puts what is behind the volume under what the ray has gathered.
    pub(super) fn show_backdrop(&self, pixel: &mut Pixel) {
        let Some(backdrop) = &self.scene.backdrop else { return };
        let [r, g, b] = match pixel.bent {
            false => self.straight_behind(backdrop, pixel),
            true => {
                let extent = self.scene.field.extent();
                let point = (pixel.entry - 0.5) * extent;
                let met = backdrop.met(&self.rays, 0.5 * extent, point, pixel.direction);
                let pixels = f64::from(self.scene.settings.image.size[0].max(self.scene.settings.image.size[1]));
                let farther = |place: [f64; 2]| place.into_iter().map(f64::abs).fold(pixels, f64::max);
                met.map_or([0.0; 3], |place| self.seen_at(backdrop, pixel, place, MET_ROUNDING * farther(place)))
            }
        };
        pixel.accumulated = self.projection.blend.apply(pixel.accumulated, [r, g, b, 1.0]);
    }
}
