//! A ray through the cells of a mesh: within each the scalar is linear.

use super::cubic::Cubic;
use super::met::Meeting;
use super::{ExactIntegrator, Light};
use crate::math::ray::ViewRay;
use crate::scene::Tetrahedra;

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
}
