//! What the shaders of polygons know: triangles, materials, and where points lie in the picture.

use bytemuck::{Pod, Zeroable};
use glam::DVec3;

use super::{double_float, double_floats};
use crate::math::ray::{Lens, ViewRays};
use crate::scene::mesh;

/// `Triangle` of `glsl/shared/polygon.glsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Triangle {
    /// Unit normal and, in the fourth component, the distance of the plane from where the rays of the view come from: high parts, low
    /// parts.
    pub plane: [[f32; 4]; 2],
    pub material: u32,
    pub padding: [u32; 3],
}

impl Triangle {
    pub fn new(triangle: &mesh::Triangle, origin: DVec3) -> Self {
        let corner = DVec3::from_array(triangle.corners[0].map(f64::from));
        let mut plane = double_floats(triangle.normal);
        [plane[0][3], plane[1][3]] = double_float(triangle.normal.dot(corner - origin));
        Self { plane, material: triangle.material.into(), padding: [0; 3] }
    }
}

/// `Material` of `glsl/shared/polygon.glsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Material {
    /// Linear colour and opacity, of fronts and of backs.
    pub colors: [[f32; 4]; 2],
    /// Whether backs show.
    pub two_sided: u32,
    /// One more than the number of the clip mesh; 0 where it is none.
    pub clip: u32,
    pub padding: [u32; 2],
}

impl Material {
    pub fn new(material: &mesh::Material) -> Self {
        let side = |[r, g, b]: [f64; 3]| [r, g, b, material.opacity].map(|c| c as f32);
        Self {
            colors: material.colors.map(side),
            two_sided: material.two_sided.into(),
            clip: material.clip.map_or(0, |number| u32::from(number) + 1),
            padding: [0; 2],
        }
    }
}

/// `Placement` of `glsl/polygons.vert`: clip coordinates of a point are the products of these with its arm from `origin`, and with 1.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Placement {
    pub origin: [f32; 4],
    pub x: [f32; 4],
    pub y: [f32; 4],
    pub z: [f32; 4],
    pub w: [f32; 4],
}

impl Placement {
    /// Of polygons that are no deeper than `far`.
    pub fn new(rays: &ViewRays, size: [u32; 2], far: f64) -> Self {
        // Column and row of the pixel that an arm leads to, times the depth in perspective, and the depth.
        let pixels = rays.to_picture().transpose();
        let depth = pixels.col(2);
        let row = |row: DVec3, rest: f64| row.as_vec3().extend(rest as f32).to_array();
        let clip = |axis: usize| {
            let place = 2.0 / f64::from(size[axis]) * pixels.col(axis);
            match rays.lens {
                Lens::Perspective => row(place - depth, 0.0),
                Lens::Orthographic => row(far * place, -far),
            }
        };
        Self {
            origin: row(rays.origin, 0.0),
            x: clip(0),
            y: clip(1),
            z: row(depth, -rays.near),
            w: match rays.lens {
                Lens::Perspective => row(depth, 0.0),
                // No depth is greater, so that all lie in front of the far plane.
                Lens::Orthographic => row(DVec3::ZERO, far),
            },
        }
    }
}
