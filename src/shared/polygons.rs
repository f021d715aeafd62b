//! What the shaders of polygons know: triangles, materials, and where points lie in the picture.

use bytemuck::{Pod, Zeroable};
use glam::{DMat3, DVec3};

use super::{double_float, double_floats};
use crate::math::ray::ViewRays;
use crate::scene::mesh;

/// `Triangle` of `glsl/shared/polygon.glsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Triangle {
    /// Unit normal and, in the fourth component, the distance of the plane from the eye: high parts, low parts.
    pub plane: [[f32; 4]; 2],
    pub material: u32,
    pub padding: [u32; 3],
}

impl Triangle {
    pub fn new(triangle: &mesh::Triangle, eye: DVec3) -> Self {
        let corner = DVec3::from_array(triangle.corners[0].map(f64::from));
        let mut plane = double_floats(triangle.normal);
        [plane[0][3], plane[1][3]] = double_float(triangle.normal.dot(corner - eye));
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

/// `Placement` of `glsl/polygons.vert`: clip coordinates x, y, w of a point are its arm from the eye times these.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Placement {
    pub eye: [f32; 4],
    pub x: [f32; 4],
    pub y: [f32; 4],
    pub w: [f32; 4],
    pub near: f32,
    pub padding: [f32; 3],
}

impl Placement {
    pub fn new(rays: &ViewRays, size: [u32; 2]) -> Self {
        // Column, row and 1, times the depth, of the pixel that an arm leads to.
        let pixels = DMat3::from_cols(rays.right, rays.down, rays.base).inverse().transpose();
        let clip = |axis: usize| 2.0 / f64::from(size[axis]) * pixels.col(axis) - pixels.col(2);
        let row = |row: DVec3| row.as_vec3().extend(0.0).to_array();
        Self {
            eye: row(rays.eye),
            x: row(clip(0)),
            y: row(clip(1)),
            w: row(pixels.col(2)),
            near: rays.near as f32,
            padding: [0.0; 3],
        }
    }
}
