//! Structs that the shaders know too; `tests/shared.rs` compares every offset with the SPIR-V.

mod bundle;
mod clip_volume;
mod environment;
mod planes;
mod polygons;
mod refraction;
mod shells;
mod single_rays;
mod slice;
mod slices;
mod surface;
mod tetrahedra;

pub use bundle::Bundle;
pub use clip_volume::clip_volume_rows;
pub use environment::environment_rows;
pub use planes::ClipPlane;
pub use polygons::{Material, Placement, Triangle};
pub use refraction::index_pieces;
pub use shells::{ShellCue, ShellLevel};
pub use single_rays::SingleRays;
pub use slice::Slice;
pub use slices::{SliceCut, Slices};
pub use surface::{SurfaceLevel, light_rows, surface_levels};
pub use tetrahedra::{TetView, tet_places};

use bytemuck::{Pod, Zeroable};

use crate::math::ray::ViewRays;
use crate::projection;
use crate::scene::Scene;
use crate::scene::texture::{TextureChoice, TextureMap};
use crate::scene::transfer::TransferFunction;
use crate::truth::preintegrated::PreintegratedTable;

/// A number as two f32: itself rounded, and what rounding took (`glsl/shared/double_float.glsl`).
fn double_float(value: f64) -> [f32; 2] {
    let high = value as f32;
    [high, (value - f64::from(high)) as f32]
}

/// Three numbers as two vec4: high parts, low parts.
fn double_floats(value: glam::DVec3) -> [[f32; 4]; 2] {
    let [x, y, z] = value.to_array().map(double_float);
    [[x[0], y[0], z[0], 0.0], [x[1], y[1], z[1], 0.0]]
}

/// `Frame` of `glsl/shared/frame.glsl`, where its members are explained.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Frame {
    pub origin: [[f32; 4]; 2],
    pub base: [[f32; 4]; 2],
    pub right: [[f32; 4]; 2],
    pub down: [[f32; 4]; 2],
    pub extent: [[f32; 4]; 2],
    pub inverse_extent: [[f32; 4]; 2],
    pub voxel_step: [[f32; 4]; 2],
    pub dims: [f32; 4],
    pub near: f32,
    pub inverse_step: f32,
    pub offset: f32,
    pub termination: f32,
    pub exponent: f32,
    pub step_voxels: f32,
    pub passes: u32,
    pub first_column: u32,
    pub first_row: u32,
    pub x_scale: f32,
    pub x_offset: f32,
    pub start: f32,
    pub end: f32,
}

impl Frame {
    /// `first`: column and row of the targets' first pixel.
    pub fn new(scene: &Scene, rays: &ViewRays, passes: u32, first: [u32; 2]) -> Self {
        let sampling = &scene.settings.sampling;
        let step = scene.settings.step() * scene.field.finest();
        let dims = scene.field.dims().map(|n| n as f32);
        let map = TextureMap::of(&scene.field, TextureChoice::of(scene).kept);
        let levels = projection::of(&scene.settings).levels(scene, map);
        Self {
            origin: double_floats(rays.origin),
            base: double_floats(rays.base),
            right: double_floats(rays.right),
            down: double_floats(rays.down),
            extent: double_floats(scene.field.extent()),
            inverse_extent: double_floats(1.0 / scene.field.extent()),
            voxel_step: double_floats(step / scene.field.voxel()),
            dims: [dims[0], dims[1], dims[2], 0.0],
            near: rays.near as f32,
            inverse_step: (1.0 / step) as f32,
            offset: sampling.offset.steps() as f32,
            termination: sampling.termination as f32,
            exponent: (scene.settings.step() / scene.transfer.reference) as f32,
            step_voxels: scene.settings.step() as f32,
            passes,
            first_column: first[0],
            first_row: first[1],
            // Where a range is so narrow that f32 has no number for it, the largest.
            x_scale: (1.0 / map.scale).min(f32::MAX.into()) as f32,
            x_offset: (-map.offset / map.scale) as f32,
            start: levels.start as f32,
            end: levels.end as f32,
        }
    }
}

/// `PushStep` of `glsl/shared/frame.glsl`: the push constants of a step.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct PushStep {
    pub bound: f32,
    pub pass: u32,
}

/// `Piece` of `glsl/shared/transfer.glsl`: one linear piece of a transfer function.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piece {
    pub rgba: [f32; 4],
    pub change: [f32; 4],
    pub begin: f32,
    pub inverse_length: f32,
    pub clear: f32,
    pub clear_change: f32,
}

/// The pieces of a transfer function whose knots are in units of the volume texture; the last one is endless.
pub fn pieces(transfer: &TransferFunction) -> Vec<Piece> {
    let knots = transfer.knots();
    let rgba = |i: usize| {
        let k = &knots[i];
        [k.color[0] as f32, k.color[1] as f32, k.color[2] as f32, k.opacity as f32]
    };
    (0..knots.len())
        .map(|i| {
            let (begin, next) = (knots[i].x as f32, knots.get(i + 1).map(|k| k.x as f32));
            // A piece shorter than f32 can tell is a jump; the search never stops at it.
            let length = next.map_or(0.0, |next| next - begin);
            let clear = |i: usize| (1.0 - knots[i].opacity) as f32;
            let (inverse_length, change, clear_change) = if length > 0.0 {
                let (a, b) = (rgba(i), rgba(i + 1));
                (1.0 / length, std::array::from_fn(|c| b[c] - a[c]), clear(i + 1) - clear(i))
            } else {
                (0.0, [0.0; 4], 0.0)
            };
            Piece { rgba: rgba(i), change, begin, inverse_length, clear: clear(i), clear_change }
        })
        .collect()
}

/// Pieces as the shader's buffer has them: three rows each, two where there are no colours.
pub fn rows(pieces: &[Piece], grey: bool) -> Vec<[f32; 4]> {
    let of = |piece: &Piece| {
        let place = [piece.begin, piece.inverse_length, piece.clear, piece.clear_change];
        let ([g, _, _, a], [dg, _, _, da]) = (piece.rgba, piece.change);
        if grey { vec![place, [g, a, dg, da]] } else { vec![place, piece.rgba, piece.change] }
    };
    pieces.iter().flat_map(of).collect()
}

/// So many pieces are few: shaders look at all of them.
pub const MOST_FEW_PIECES: usize = 16;

/// Rows of the uniform buffer of few pieces.
pub const FEW_ROWS: usize = 3 * MOST_FEW_PIECES;

/// `AxisPiece` of `glsl/shared/preintegrated.glsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct AxisPiece {
    pub begin: f32,
    pub inverse_length: f32,
    pub first: f32,
    pub intervals: f32,
}

/// The pieces of a table's axes; `map` takes x to units of the volume texture.
pub fn axis_pieces(table: &PreintegratedTable, map: impl Fn(f64) -> f64) -> Vec<AxisPiece> {
    let piece = |piece: &crate::truth::preintegrated::TablePiece| {
        let [begin, end] = piece.x.map(|x| map(x) as f32);
        let inverse_length = if end > begin { 1.0 / (end - begin) } else { 0.0 };
        AxisPiece { begin, inverse_length, first: piece.first as f32, intervals: piece.intervals as f32 }
    };
    table.pieces.iter().map(piece).collect()
}
