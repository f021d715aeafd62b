//! A ray through the cells of a mesh: within each the scalar is linear.

use super::cubic::Cubic;
use super::met::Meeting;
use super::{ExactIntegrator, Light};
use crate::math::opacity::composite;
use crate::math::ray::ViewRay;
use crate::scene::light::{LitPoint, lit};
use crate::scene::surface::Level;
use crate::scene::tetrahedra::{CellWay, FacePoint};
use crate::scene::{Scene, Tetrahedra};

impl ExactIntegrator<'_> {
    /// Premultiplied RGBA of a ray beyond the parameter `near`; transparent black where it misses the mesh.
    pub(super) fn through_cells(&self, mesh: &Tetrahedra, ray: &ViewRay, near: f64) -> [f64; 4] {
        let ways = mesh.ways(ray, near);
        let unit = ray.direction.length() / (self.medium.transfer.reference * self.field.finest());
        let parts = ways.iter().map(|way| {
            let (from, to) = (way.from, way.to);
            let x = Cubic([from.value, to.value - from.value, 0.0, 0.0]);
            (x, (to.depth - from.depth).max(0.0) * unit)
        });
        if let Some(scene) = self.surfaces {
            return self.surfaces_in_cells(scene, mesh, ray, &ways);
        }
        let Some(values) = &self.projection.values else {
            let whole: f64 = parts.clone().map(|(_, lengths)| lengths).sum();
            let mut light = Light { color: [0.0; 3], transmittance: 1.0 };
            parts.for_each(|(x, lengths)| self.medium.add(&x, lengths, lengths / whole, &mut light));
            return light.rgba();
        };
        let mut meeting = Meeting::new(self.field);
        parts.for_each(|(x, lengths)| meeting.add(Some(x), lengths));
        let Some(met) = meeting.whole() else { return [0.0; 4] };
        let value = (values.exact)(&met);
        [value, value, value, 1.0]
    }

    /// Premultiplied RGBA of the surfaces that a ray meets on its ways through cells, with the volume between where it is drawn.
    fn surfaces_in_cells(&self, scene: &Scene, mesh: &Tetrahedra, ray: &ViewRay, ways: &[CellWay]) -> [f64; 4] {
        let surfaces: Vec<_> = scene.surface.iter().flat_map(|surface| &surface.levels).collect();
        let levels: Vec<f64> = surfaces.iter().map(|level| level.values[0]).collect();
        let unit = ray.direction.length() / (self.medium.transfer.reference * self.field.finest());
        let lights = scene.shining();
        let volume = |from: FacePoint, to: FacePoint| match scene.surfaces_in_volume() {
            true => self.medium.ramp(from.value, to.value, (to.depth - from.depth).max(0.0) * unit),
            false => [0.0; 4],
        };
        let mut pixel = [0.0; 4];
        for way in ways {
            let mut from = way.from;
            for met in way.meets(&levels) {
                let view = -ray.direction.normalize_or_zero();
                let point = LitPoint { place: ray.at(met.at.depth), normal: mesh.gradient(way.cell).along, view };
                let Level { color, opacity, .. } = *surfaces[met.level];
                let [r, g, b] = lit(color, &lights, &point).map(|c| c * opacity);
                pixel = composite(composite(pixel, volume(from, met.at)), [r, g, b, opacity]);
                from = met.at;
            }
            pixel = composite(pixel, volume(from, way.to));
        }
        pixel
    }
}
