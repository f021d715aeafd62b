//! Twin of `glsl/peel.frag`, which peels nothing: the surfaces that a ray meets, in their order.

use super::{Effect, Pixel, Surface, Twin};
use crate::math::ray::box_interval;
use crate::scene::mesh::Crossing;

/// The nearest opaque surface.
pub fn opaque(twin: &Twin, pixel: &mut Pixel, _: u32) -> Effect {
    let crossings = twin.crossings(pixel);
    pixel.opaque = twin.scene.polygons.seen(&crossings).1.map(|one| twin.surface(pixel, one));
    if pixel.opaque.is_some() { Effect::Silent } else { Effect::Discarded }
}

/// The transparent surface behind `layer` others, in front of the opaque one.
pub fn transparent(twin: &Twin, pixel: &mut Pixel, layer: u32) -> Effect {
    let crossings = twin.crossings(pixel);
    let Some(crossing) = twin.scene.polygons.seen(&crossings).0.get(layer as usize) else { return Effect::Discarded };
    let surface = twin.surface(pixel, crossing);
    pixel.layers.push(surface);
    Effect::Silent
}

impl Twin<'_> {
    fn crossings(&self, pixel: &Pixel) -> Vec<Crossing> {
        self.scene.polygons.crossings(&self.rays, [pixel.column, pixel.row], 0.0).list
    }

    fn surface(&self, pixel: &Pixel, crossing: &Crossing) -> Surface {
        let direction = self.rays.direction(pixel.column, pixel.row);
        let half = 0.5 * self.scene.field.extent();
        let enter = box_interval(self.rays.eye, direction, half, self.rays.near).map_or(0.0, |(enter, _)| enter);
        Surface {
            steps: (crossing.depth - enter) * direction.length() / self.step_length(),
            color: self.scene.polygons.lit(direction, crossing),
        }
    }
}
