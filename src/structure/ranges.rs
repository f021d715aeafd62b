//! The range of values in boxes of cells.

use rayon::prelude::*;

use crate::scene::Field;

/// How far interpolation may leave [min, max] by rounding, relative to the larger magnitude of both. A unit in the
/// last place of f32 is 2^-23 at most; a few of them, of the three interpolations, fit.
pub const ROUNDING: f32 = 1.0 / (1 << 20) as f32;

/// Blocks of `side`^3 cells along each side of a volume, and the minimum and maximum over each block's voxels, x
/// fastest. Holes count as what they were filled with, which can only make a range wider.
pub fn ranges(field: &Field, side: usize) -> ([usize; 3], Vec<[f32; 2]>) {
    ranges_of(field.dims(), &field.values, side)
}

/// The same of any voxels that can be compared.
pub fn ranges_of<T: Copy + PartialOrd + Send + Sync>(
    voxels: [usize; 3],
    values: &[T],
    side: usize,
) -> ([usize; 3], Vec<[T; 2]>) {
    let [nx, ny, nz] = voxels;
    let dims = voxels.map(|n| n.saturating_sub(1).max(1).div_ceil(side));
    let [bx, by, _] = dims;
    let span = |block: usize, voxels: usize| block * side..(block * side + side + 1).min(voxels);
    let ranges = (0..dims.iter().product())
        .into_par_iter()
        .map(|block| {
            let (x, y, z) = (block % bx, block / bx % by, block / (bx * by));
            let first = values[(z * side * ny + y * side) * nx + x * side];
            let mut range = [first; 2];
            for z in span(z, nz) {
                for y in span(y, ny) {
                    for &value in &values[(z * ny + y) * nx..][span(x, nx)] {
                        let [low, high] = range;
                        range = [if value < low { value } else { low }, if value > high { value } else { high }];
                    }
                }
            }
            range
        })
        .collect();
    (dims, ranges)
}
