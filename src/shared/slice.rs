//! What a dispatch of a structure's build knows.

use bytemuck::{Pod, Zeroable};

/// `Slice` of `glsl/shared/slice.glsl`, where its members are explained.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct Slice {
    pub first: u32,
    pub end: u32,
    pub cells_x: u32,
    pub cells_y: u32,
    pub cells_z: u32,
    pub cell: u32,
    pub inner: u32,
    pub outer: u32,
    pub stride: u32,
    pub weight: u32,
    pub reach: u32,
    pub octant: u32,
    pub corners: u32,
    pub level: f32,
    pub threshold: f32,
    pub voxel_x: f32,
    pub voxel_y: f32,
    pub voxel_z: f32,
}
