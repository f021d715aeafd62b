//! Placeholder.
use crate::scene::Field;
use crate::structure::LookupView;
use crate::structure::grid::Grid;
use bytemuck::{Pod, Zeroable};

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Bundle {
    pub eye: [f32; 4],
}

impl Bundle {
    pub fn new(_: &Grid, _: &Field, _: &LookupView) -> Self {
        Self { eye: [0.0; 4] }
    }
}
