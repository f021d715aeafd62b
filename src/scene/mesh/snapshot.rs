//! What polygons look like from a point among them.

use glam::DVec3;

use super::polygons::Polygons;
use crate::math::ray::{Lens, ViewRays};

/// Nothing nearer to the eye is seen.
const NEAR: f64 = 1e-6;

impl Polygons {
    /// The linear colour of the nearest opaque surface in a direction from `eye`, with a light there; none where there is no
    /// surface.
    pub fn seen_from(&self, eye: DVec3, direction: DVec3) -> Option<[f64; 3]> {
        let [right, down] = [DVec3::ZERO; 2];
        let rays = ViewRays { lens: Lens::Perspective, origin: eye, base: direction, right, down, near: NEAR };
        let crossings = self.crossings(&rays, [0, 0], 0.0).list;
        let nearest = crossings.iter().find(|crossing| self.material(crossing.triangle).is_opaque())?;
        let [r, g, b, _] = self.lit(direction, nearest);
        Some([r, g, b])
    }
}
