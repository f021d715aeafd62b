//! What the shaders of meshes of cells know.

use bytemuck::{Pod, Zeroable};
use rayon::prelude::*;

use super::double_float;
use crate::scene::Scene;
use crate::scene::tetrahedra::Tetrahedra;
use crate::scene::view::View;
use crate::truth::cell_table::TableAxes;

/// `TetView` of `glsl/shared/seen.glsl`, where its members are explained.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct TetView {
    pub table: [f32; 4],
    pub square: [f32; 3],
    pub near: f32,
    pub middle: [f32; 2],
    pub corner: [f32; 2],
    pub slope: f32,
    pub depth: f32,
}

impl TetView {
    /// Of a view of the scene.
    pub fn new(scene: &Scene, view: &View) -> Self {
        let lengths = 1.0 / (scene.transfer.reference * scene.field.finest());
        let axes = TableAxes::of(scene).filter(|_| scene.has_cell_table());
        let table = axes.map_or([0.0; 4], |axes| [axes.values[0], axes.per_value(), axes.per_length(), 0.0]);
        let (rays, depth) = (&view.rays, middle_depth(view));
        let center = view.size.map(|pixels| 0.5 * f64::from(pixels));
        let slope = if rays.parallel() { 0.0 } else { 1.0 };
        // The ray through the middle is at right angles to columns and rows, and these to each other.
        let parts = [rays.through(center[0], center[1]).direction, slope * rays.right, slope * rays.down];
        let corner = [view.region.x, view.region.y];
        Self {
            table: table.map(|number| number as f32),
            square: parts.map(|part| (part.length_squared() * lengths * lengths) as f32),
            near: (rays.near - depth) as f32,
            middle: double_float(if rays.parallel() { 1.0 } else { depth }),
            corner: [0, 1].map(|axis| (f64::from(corner[axis]) - center[axis]) as f32),
            slope: slope as f32,
            depth: depth as f32,
        }
    }
}

/// The depth of the middle of the mesh.
fn middle_depth(view: &View) -> f64 {
    view.cells.as_ref().map_or(0.0, |cells| cells.middle)
}

/// Vertices of a mesh as the view has them: columns and rows from the middle of the picture, times the depth with perspective; the depth from
/// the middle of the mesh; x.
pub fn tet_places(mesh: &Tetrahedra, view: &View) -> Vec<[f32; 4]> {
    let (rays, middle) = (&view.rays, middle_depth(view));
    let to_picture = rays.to_picture();
    let [column, row] = view.size.map(|pixels| 0.5 * f64::from(pixels));
    let place = |(number, value): (usize, &f32)| {
        let place = to_picture * (mesh.point(number as u32) - rays.origin);
        let times = if rays.parallel() { 1.0 } else { place.z };
        [place.x - times * column, place.y - times * row, place.z - middle, f64::from(*value)].map(|part| part as f32)
    };
    mesh.values.par_iter().enumerate().map(place).collect()
}
