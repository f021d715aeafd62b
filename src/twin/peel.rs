//! Twin of `glsl/peel.frag`, which peels nothing: the surfaces that a ray meets, in their order.

use super::{Effect, Pixel, Surface, Twin};
use crate::scene::mesh::{Cut, Cuts};

/// The nearest opaque surface.
pub fn opaque(twin: &Twin, pixel: &mut Pixel, _: u32) -> Effect {
    pixel.opaque = twin.cuts(pixel).opaque.map(|crossing| twin.surface(pixel, &Cut { crossing, kept: false }));
    if pixel.opaque.is_some() { Effect::Silent } else { Effect::Discarded }
}

/// The nearest surface of clip geometry; behind it, or else nowhere, the volume is drawn.
pub fn clip(twin: &Twin, pixel: &mut Pixel, _: u32) -> Effect {
    pixel.begin = twin.cuts(pixel).begin.map(|crossing| twin.surface(pixel, &Cut { crossing, kept: true }));
    if pixel.begin.is_some() { Effect::Silent } else { Effect::Discarded }
}

/// The surface behind `layer` others that cuts the ray, in front of the opaque one.
pub fn transparent(twin: &Twin, pixel: &mut Pixel, layer: u32) -> Effect {
    let cuts = twin.cuts(pixel);
    let Some(cut) = cuts.surfaces.get(layer as usize) else { return Effect::Discarded };
    let surface = twin.surface(pixel, cut);
    pixel.layers.push(surface);
    Effect::Silent
}

impl Twin<'_> {
    /// The surfaces that cut the ray.
    pub(super) fn cuts(&self, pixel: &Pixel) -> Cuts {
        let polygons = &self.scene.polygons;
        polygons.cuts(&polygons.crossings(&self.rays, [pixel.column, pixel.row], 0.0).list)
    }

    fn surface(&self, pixel: &Pixel, cut: &Cut) -> Surface {
        let ray = self.rays.of(pixel.column, pixel.row);
        let enter = self.scene.interval(&ray, self.rays.near).map_or(0.0, |(enter, _)| enter);
        Surface {
            steps: (cut.crossing.depth - enter) * ray.direction.length() / self.step_length(),
            color: self.scene.polygons.lit(ray.direction, &cut.crossing),
            kept: cut.kept,
        }
    }
}
