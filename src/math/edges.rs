//! On which side of a triangle's edges a ray passes, as rasterisers see it.

use glam::DVec3;

use super::ray::{Lens, ViewRay, ViewRays};

/// A ray that passes within the edges of a triangle, or so near to them that a rasteriser may see it so.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WithinEdges {
    /// Whether it passes within; a ray through the very edge of two triangles passes within one of them.
    pub here: bool,
    /// The edges, each from its corner to the next one, that a rasteriser may see on the other side.
    pub unsure: [bool; 3],
}

impl WithinEdges {
    /// Whether a rasteriser may see it otherwise.
    pub fn is_unsure(self) -> bool {
        self.unsure.contains(&true)
    }
}

/// How a ray passes a triangle with these corners, as arms from where the ray comes from; none where it passes outside whatever a
/// rasteriser does. `front`: the front is seen. `raster`: steps of the raster that a rasteriser moves corners to, in pixels.
pub fn within_edges(rays: &ViewRays, ray: &ViewRay, arms: [DVec3; 3], front: bool, raster: f64) -> Option<WithinEdges> {
    // Each edge's plane through where the ray comes from; it passes on the inner side of all three, by so many pixels.
    let turn = if front { -1.0 } else { 1.0 };
    let mut within = WithinEdges { here: true, unsure: [false; 3] };
    for (i, unsure) in within.unsure.iter_mut().enumerate() {
        let (from, to) = (arms[i], arms[(i + 1) % 3]);
        let edge = turn * from.cross(to);
        let side = edge.dot(ray.direction);
        // What a pixel to the right, or down, adds to the side.
        let across = match rays.lens {
            Lens::Perspective => edge,
            Lens::Orthographic => (to - from).cross(ray.direction),
        };
        let reach = raster * (across.dot(rays.right).abs() + across.dot(rays.down).abs());
        if side < -reach {
            return None;
        }
        // A ray through the very edge meets one of the two triangles that share it.
        let first = edge.to_array().into_iter().find(|c| *c != 0.0).unwrap_or(0.0);
        within.here &= side > 0.0 || side == 0.0 && first > 0.0;
        *unsure = side <= reach;
    }
    Some(within)
}
