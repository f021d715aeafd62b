//! What the shaders of meshes of cells know.

use bytemuck::{Pod, Zeroable};

use super::double_float;
use crate::scene::Scene;
use crate::scene::tetrahedra::CellsView;

/// `TetView` of `glsl/shared/seen.glsl`, where its members are explained.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct TetView {
    pub middle: [f32; 2],
    pub lengths: f32,
    pub padding: f32,
}

impl TetView {
    pub fn new(scene: &Scene, view: &CellsView) -> Self {
        let lengths = 1.0 / (scene.transfer.reference * scene.field.finest());
        Self { middle: double_float(view.middle), lengths: lengths as f32, padding: 0.0 }
    }
}
