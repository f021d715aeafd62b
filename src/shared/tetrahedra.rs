//! What the shaders of meshes of cells know.

use bytemuck::{Pod, Zeroable};

use super::double_float;
use crate::scene::Scene;
use crate::scene::tetrahedra::CellsView;
use crate::truth::cell_table::TableAxes;

/// `TetView` of `glsl/shared/seen.glsl`, where its members are explained.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct TetView {
    pub table: [f32; 4],
    pub middle: [f32; 2],
    pub lengths: f32,
}

impl TetView {
    pub fn new(scene: &Scene, view: &CellsView) -> Self {
        let lengths = 1.0 / (scene.transfer.reference * scene.field.finest());
        let axes = TableAxes::of(scene).filter(|_| scene.has_cell_table());
        let table = axes.map_or([0.0; 4], |axes| [axes.values[0], axes.per_value(), axes.per_length(), 0.0]);
        Self { table: table.map(|number| number as f32), middle: double_float(view.middle), lengths: lengths as f32 }
    }
}
