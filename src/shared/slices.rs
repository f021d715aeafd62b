//! Where slices lie.

use bytemuck::{Pod, Zeroable};

use super::double_float;
use crate::scene::Scene;
use crate::scene::slice_polygons::CutPlanes;
use crate::scene::slices;

/// `Slices` of `glsl/shared/slices.glsl`, where its members are explained.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Slices {
    pub first: [f32; 4],
    pub spacing: [f32; 2],
    pub steps: f32,
    pub count: u32,
}

impl Slices {
    pub fn new(scene: &Scene, slices: &slices::Slices) -> Self {
        let [up, down] = slices.first.map(double_float);
        Self {
            first: [up[0], up[1], down[0], down[1]],
            spacing: double_float(slices.spacing),
            steps: (slices.spacing / (scene.settings.sampling.step * scene.field.finest())) as f32,
            count: slices.count,
        }
    }
}

/// `SliceCut` of `glsl/slices_cut.vert`, where its members are explained.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct SliceCut {
    pub reach: [f32; 4],
    pub x: [f32; 4],
    pub y: [f32; 4],
    pub w: [f32; 4],
    pub normal: [f32; 4],
    pub first: [f32; 2],
    pub beyond: [f32; 2],
    pub spacing: f32,
}

impl SliceCut {
    pub fn new(planes: &CutPlanes) -> Self {
        let row = |row: glam::DVec4| row.to_array().map(|c| c as f32);
        let [x, y, w] = planes.clip.map(row);
        Self {
            reach: row(planes.reach.extend(0.0)),
            x,
            y,
            w,
            normal: row(planes.normal.extend(0.0)),
            first: planes.first.map(|at| at as f32),
            beyond: planes.beyond.map(|at| at as f32),
            spacing: planes.spacing as f32,
        }
    }
}
