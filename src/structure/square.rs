//! Squared distances in integers, so that every builder on every device finds the same. Twin of
//! `glsl/shared/square.glsl`.
//!
//! The unit is 2^-13 of a squared voxel of the finest spacing. A side of a cell is squared and rounded down to it, which
//! keeps sums of squares lower bounds and changes nothing where spacings are equal.

use super::grid::{FAR, Grid, SLACK, byte_of};

/// Units in a squared voxel.
pub const UNIT: u32 = 1 << 13;

/// 256 voxels; all that is no nearer is one and the same.
pub const FAR_SQUARED: u32 = (1 << 16) * UNIT;

/// Square of a cell's side, which is given in voxels of the finest spacing.
pub fn weight(side: f64) -> u32 {
    let square = (side * side * f64::from(UNIT)).floor();
    if square < f64::from(FAR_SQUARED) { square as u32 } else { FAR_SQUARED }
}

/// The least number of cells of that weight that reach [`FAR_SQUARED`].
pub fn reach(weight: u32) -> u32 {
    let cells = (f64::from(FAR_SQUARED) / f64::from(weight)).sqrt() as u32;
    // A root may be off by one either way.
    let far = |cells: u32| u64::from(cells) * u64::from(cells) * u64::from(weight) >= u64::from(FAR_SQUARED);
    (cells.saturating_sub(1)..).find(|&cells| far(cells)).unwrap_or(u32::MAX)
}

/// Square of a way of `count` cells.
#[inline]
pub fn square_of(count: u32, weight: u32, reach: u32) -> u32 {
    if count < reach { count * count * weight } else { FAR_SQUARED }
}

/// Whole voxels within the root of a square less [`SLACK`]: the largest d of at most 254 with
/// d = 0 or (d + 1/512)^2 `UNIT` <= square.
#[inline]
pub fn free_voxels(square: u32) -> u8 {
    // A root of f64 is exact enough where squares are integers: those of d + 1/512 are 1/32 off any.
    let voxels = (f64::from(square) / f64::from(UNIT)).sqrt() - SLACK;
    // The cast saturates.
    (voxels as u8).min(FAR)
}

/// The bytes of cells that are not interesting, by the square in squared sides of cells, where these are cubes and rows of them
/// are no longer than such squares can number.
pub fn bytes_by_cells(grid: &Grid) -> Option<Vec<u8>> {
    let [x, y, z] = grid.sides.to_array().map(weight);
    let fits = grid.cells.iter().all(|cells| *cells <= usize::from(u16::MAX));
    let voxels = |square: u64| free_voxels((square * u64::from(x)).min(FAR_SQUARED.into()) as u32);
    let byte = |square: u16| byte_of(false, voxels(square.into()));
    (fits && x == y && y == z).then(|| (0..=u16::MAX).map(byte).collect())
}
