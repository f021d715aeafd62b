//! Distance from each cell to the nearest interesting one that a ray in an octant can still reach [Thesis §5.3.1,
//! "Directional"]: on each axis the other cell lies at the same place or further where the rays go.
//!
//! Departure: the thesis' k-d trees grow along the diagonal; here each octant is a separable transform of its own
//! ([`super::axis`]), and is exact. Octants share what is the same along x and y where they go the same way: 14 in all.
//! Box distance is index distance to the cells dilated by one against the rays, as in [`super::distance`]. Twin of
//! `glsl/structure/distance_scan.comp`.

use rayon::prelude::*;

use super::axis::{Columns, LANES, Square, Towards, first_axis, ways};
use super::distance::{TILE, by_second_axis};
use super::grid::{DistanceField, FAR, Grid, OCTANTS, byte_of};
use super::square::{bytes_by_cells, free_voxels, weight};

/// Ways that rays may go along the first two axes.
const QUADRANTS: usize = OCTANTS / 2;

/// Distances of all cells of `grid`, for each octant, to the nearest that is `interesting` (one flag a cell, x fastest).
///
/// # Panics
/// When there is not one flag a cell.
pub fn directional(grid: &Grid, interesting: &[bool]) -> DistanceField {
    assert_eq!(interesting.len(), grid.count(), "one flag a cell");
    let mut bytes = vec![byte_of(false, FAR); OCTANTS * interesting.len()];
    if interesting.contains(&true) {
        match bytes_by_cells(grid) {
            Some(bytes_of) => fill(grid, interesting, [1; 3], |square: u16| bytes_of[usize::from(square)], &mut bytes),
            None => fill(
                grid,
                interesting,
                grid.sides.to_array().map(weight),
                |square| byte_of(false, free_voxels(square)),
                &mut bytes,
            ),
        }
    }
    DistanceField { grid: *grid, octants: OCTANTS, bytes }
}

/// Fills in all bytes; `byte` is that of a cell that is not interesting, by its square.
fn fill<S: Square>(
    grid: &Grid,
    interesting: &[bool],
    weights: [u32; 3],
    byte: impl Fn(S) -> u8 + Sync,
    bytes: &mut [u8],
) {
    let [nx, ny, nz] = grid.cells;
    let squares = quadrants(grid, interesting, weights);
    by_second_axis(bytes, OCTANTS * nx, ny).into_par_iter().enumerate().for_each(|(y, mut rows)| {
        let mut tile: [Columns<S>; TILE / LANES] = std::array::from_fn(|_| Columns::new(nz, weights[2]));
        for x in (0..nx).step_by(TILE) {
            let end = nx.min(x + TILE);
            let row = |z: usize| (z * ny + y) * nx;
            for (quadrant, squares) in squares.iter().enumerate() {
                for z in 0..nz {
                    Columns::load_row(&mut tile, z, &squares[row(z) + x..row(z) + end]);
                }
                for (towards, octant) in Towards::WAYS.into_iter().zip([quadrant, quadrant + QUADRANTS]) {
                    tile.iter_mut().for_each(|columns| columns.transform(towards));
                    for (z, bytes) in rows.iter_mut().enumerate() {
                        let flags = interesting[row(z) + x..row(z) + end].chunks(LANES);
                        let bytes = bytes[OCTANTS * x..OCTANTS * end].chunks_mut(OCTANTS * LANES);
                        for ((columns, flags), bytes) in tile.iter().zip(flags).zip(bytes) {
                            let bytes = bytes.chunks_exact_mut(OCTANTS);
                            for ((bytes, flag), square) in bytes.zip(flags).zip(columns.least[z]) {
                                bytes[octant] = if *flag { byte_of(true, 0) } else { byte(square) };
                            }
                        }
                    }
                }
            }
        }
    });
}

/// Squares along the first two axes, for both ways along each: x first.
fn quadrants<S: Square>(grid: &Grid, interesting: &[bool], weights: [u32; 3]) -> [Vec<S>; QUADRANTS] {
    let [nx, ny, _] = grid.cells;
    let along_x = ways(nx, weights[0]);
    let mut squares: [Vec<S>; QUADRANTS] = std::array::from_fn(|_| vec![S::FAR; grid.count()]);
    let [a, b, c, d] = squares.each_mut().map(|squares| squares.par_chunks_mut(nx * ny));
    let slabs = a.zip(b).zip(c.zip(d)).map(|((a, b), (c, d))| [a, b, c, d]);
    slabs.zip(interesting.par_chunks(nx * ny)).for_each(|(slabs, flags)| {
        if !flags.contains(&true) {
            return;
        }
        let mut rows = vec![S::FAR; flags.len()];
        let mut columns = Columns::new(ny, weights[1]);
        for (x, towards) in Towards::WAYS.into_iter().enumerate() {
            for (row, flags) in rows.chunks_exact_mut(nx).zip(flags.chunks_exact(nx)) {
                first_axis(&along_x, towards, flags, row);
            }
            for begin in (0..nx).step_by(LANES) {
                let width = LANES.min(nx - begin);
                columns.load(|y| &rows[y * nx + begin..][..width]);
                for (y, towards) in Towards::WAYS.into_iter().enumerate() {
                    columns.transform(towards);
                    columns.store(slabs[x + 2 * y], nx, begin, width);
                }
            }
        }
    });
    squares
}
