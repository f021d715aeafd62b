//! What shaders know of clip planes.

use bytemuck::{Pod, Zeroable};
use glam::DVec3;

use super::double_float;
use crate::math::polyhedron::HalfSpace;
use crate::math::ray::ViewRays;

/// A plane as far from the eye as this cuts all of a volume or nothing: single precision has numbers for its depth.
const FARTHEST: f64 = 1e30;

/// `ClipPlane` of `glsl/shared/ray.glsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct ClipPlane {
    /// The height over the plane of where the rays of the view come from, and what their base, right and down rise by over it: high
    /// parts, low parts.
    pub heights: [[f32; 4]; 2],
    /// The plane in volume space: its normal, to where it keeps, and its height over the origin.
    pub plane: [f32; 4],
}

impl ClipPlane {
    pub fn new(plane: &HalfSpace, rays: &ViewRays) -> Self {
        let rise = |way| plane.normal.dot(way);
        let height = plane.height(rays.origin).clamp(-FARTHEST, FARTHEST);
        let heights = [height, rise(rays.base), rise(rays.right), rise(rays.down)].map(double_float);
        let [x, y, z] = plane.normal.to_array();
        Self {
            heights: [0, 1].map(|part| heights.map(|height| height[part])),
            plane: [x, y, z, plane.height(DVec3::ZERO)].map(|c| c as f32),
        }
    }
}
