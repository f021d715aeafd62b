//! How much the field bends: second differences of its voxels.

use rayon::prelude::*;

use super::code::Code;
use crate::scene::Field;

/// For each cell the least and the greatest x at its corners, and a bound of the second derivative along any line through it: the
/// Frobenius norm of second differences, x over the square of a voxel of the finest spacing.
///
/// Within a cell the trilinear interpolant bends by its mixed differences alone. On a face between cells its slope across the face
/// jumps by the second difference there, which counts over the length of a cell.
pub fn bends(field: &Field) -> (Vec<[f32; 2]>, Vec<Code>) {
    let cells = field.cells();
    let dims = field.dims();
    let sides = (field.voxel() / field.finest()).to_array();
    let value = |voxel: [usize; 3]| f64::from(field.values[(voxel[2] * dims[1] + voxel[1]) * dims[0] + voxel[0]]);
    let moved = |mut voxel: [usize; 3], axis: usize, by: isize| {
        voxel[axis] = voxel[axis].saturating_add_signed(by).min(dims[axis] - 1);
        voxel
    };
    let count = cells.iter().product();
    let of_cell = |i: usize| {
        let cell = [i % cells[0], i / cells[0] % cells[1], i / (cells[0] * cells[1])];
        let corner = |n: usize| {
            let mut voxel = cell;
            (0..3).for_each(|axis| voxel[axis] = (voxel[axis] + (n >> axis & 1)).min(dims[axis] - 1));
            voxel
        };
        let corners: [[usize; 3]; 8] = std::array::from_fn(corner);
        let values = corners.map(value);
        let least = values.iter().copied().fold(f64::INFINITY, f64::min);
        let most = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let mut square = 0.0;
        for axis in 0..3 {
            let across = |n: usize| {
                let (before, after) = (value(moved(corners[n], axis, -1)), value(moved(corners[n], axis, 1)));
                before - 2.0 * values[n] + after
            };
            let most = (0..8).map(|n| across(n).abs()).fold(0.0, f64::max) / (sides[axis] * sides[axis]);
            square += most * most;
            let (u, v) = (1 << ((axis + 1) % 3), 1 << ((axis + 2) % 3));
            let mixed = |n: usize| values[n] - values[n | u] - values[n | v] + values[n | u | v];
            let area = sides[(axis + 1) % 3] * sides[(axis + 2) % 3];
            let most = mixed(0).abs().max(mixed(1 << axis).abs()) / area;
            // It stands twice in the matrix.
            square += 2.0 * most * most;
        }
        ([least as f32, most as f32], Code::up(square.sqrt()))
    };
    (0..count).into_par_iter().map(of_cell).unzip()
}
