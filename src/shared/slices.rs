//! Where slices lie.

use bytemuck::{Pod, Zeroable};

use super::double_float;
use crate::scene::Scene;
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
