//! How far along rays a box lies from where they enter the volume.

use glam::{BVec3, DVec3};

use super::Scene;
use crate::math::polyhedron::HalfSpace;
use crate::math::ray::ViewRays;

/// Where rays of a view enter what is kept of the volume: by the half spaces that it lies in.
pub struct AlongRays {
    rays: ViewRays,
    entered: Vec<Entered>,
}

/// A half space that rays enter.
struct Entered {
    space: HalfSpace,
    /// In perspective, how far the eye is outside; else how much of a ray's way leads inward. Positive, in lengths of the normal.
    by: f64,
}

impl AlongRays {
    /// The rays of a scene; of a plane that only some of them enter none is taken for its entry.
    pub fn new(scene: &Scene, rays: &ViewRays) -> Self {
        let half = 0.5 * scene.field.extent();
        let faces = [DVec3::X, DVec3::Y, DVec3::Z].into_iter().zip(half.to_array());
        let faces = faces.flat_map(|(axis, half)| [axis, -axis].map(|normal| HalfSpace { normal, distance: -half }));
        let depth = rays.to_picture().row(2);
        let near = HalfSpace { normal: depth, distance: depth.dot(rays.origin) + rays.near };
        let by = |space: &HalfSpace| match rays.parallel() {
            true => space.normal.dot(rays.base) / rays.base.length(),
            false => -space.height(rays.origin),
        };
        let spaces = faces.chain([near]).chain(scene.clip_planes().iter().copied());
        let entered =
            spaces.map(|space| Entered { by: by(&space), space }).filter(|entered| entered.by > 0.0).collect();
        Self { rays: *rays, entered }
    }

    /// Between which lengths behind their entry points rays pass through a box, which is given by two corners in volume space: a bound,
    /// volume units.
    pub fn lengths(&self, [least, greatest]: [DVec3; 2]) -> [f64; 2] {
        let origin = self.rays.origin;
        // From the eye to the nearest point and to the farthest.
        let nearest = origin.clamp(least, greatest).distance(origin);
        let farthest = (least - origin).abs().max((greatest - origin).abs()).length();
        self.entered.iter().fold([f64::INFINITY; 2], |found, Entered { space, by }| {
            let corner = |up: bool| DVec3::select(space.normal.cmpge(DVec3::ZERO) ^ BVec3::splat(!up), greatest, least);
            let heights = [corner(false), corner(true)].map(|corner| space.height(corner).max(0.0));
            let lengths = match self.rays.parallel() {
                true => heights.map(|height| height / by),
                // Of the way from the eye, the part behind the plane.
                false => [nearest * heights[0] / (heights[0] + by), farthest * heights[1] / (heights[1] + by)],
            };
            // Rays enter the volume by the plane that they come to last.
            [found[0].min(lengths[0]), found[1].min(lengths[1])]
        })
    }
}
