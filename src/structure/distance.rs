//! Distance from each cell to the nearest interesting one [Thesis §5.3]: what near-neighbor skipping jumps by.
//!
//! The distance is that between the *boxes* of two cells, less [`SLACK`](super::grid::SLACK) and floored to whole voxels
//! of the finest spacing: a lower bound for the distance of any point of the one to any point of the other. Border cells
//! reach out to the faces of the volume and so are larger than their boxes here, but only away from all cells beside
//! them: their outer part is farther from any other cell than their box is, and the bound holds there too.
//!
//! The box distance between cells that are d apart on an axis is (|d| - 1) sides there, 0 for neighbours. So it is
//! the plain distance between cell indices to the mask dilated by one cell in all 26 directions: a step towards the
//! other cell on each axis where d is not 0 is what the best of the 27 dilated cells saves.
//!
//! The transform is separable: sums of squares are minimised axis by axis ([`super::axis`]), first along x, then along y and
//! z. The dilation is done along each axis just before its transform. Squares are integers: of whole cells where these are
//! cubes, else as in [`super::square`].

use rayon::prelude::*;

use super::axis::{Columns, LANES, Square, Towards, first_axis, ways};
use super::grid::{DistanceField, FAR, Grid, byte_of};
use super::square::{bytes_by_cells, free_voxels, weight};

/// Columns whose squares are read together, several cache lines of each row: rows of large volumes lie so that caches keep
/// few of them.
pub(super) const TILE: usize = 4 * LANES;

/// Distances of all cells of `grid` to the nearest that is `interesting` (one flag a cell, x fastest). The bound is for
/// exact positions: who steps along a ray in f32 owes it the rounding of the ray's own positions.
///
/// # Panics
/// When there is not one flag a cell.
pub fn omni(grid: &Grid, interesting: &[bool]) -> DistanceField {
    assert_eq!(interesting.len(), grid.count(), "one flag a cell");
    let mut bytes = vec![byte_of(false, FAR); interesting.len()];
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
    DistanceField { grid: *grid, octants: 1, bytes }
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
    let along_x = ways(nx, weights[0]);
    let mut squares = vec![S::FAR; interesting.len()];
    squares.par_chunks_mut(nx * ny).zip(interesting.par_chunks(nx * ny)).for_each(|(squares, flags)| {
        if !flags.contains(&true) {
            return;
        }
        for (squares, flags) in squares.chunks_exact_mut(nx).zip(flags.chunks_exact(nx)) {
            first_axis(&along_x, Towards::Either, flags, squares);
        }
        let mut columns = Columns::new(ny, weights[1]);
        for x in (0..nx).step_by(LANES) {
            let width = LANES.min(nx - x);
            columns.load(|y| &squares[y * nx + x..][..width]);
            columns.transform(Towards::Either);
            columns.store(squares, nx, x, width);
        }
    });
    by_second_axis(bytes, nx, ny).into_par_iter().enumerate().for_each(|(y, mut rows)| {
        let mut tile: [Columns<S>; TILE / LANES] = std::array::from_fn(|_| Columns::new(nz, weights[2]));
        for x in (0..nx).step_by(TILE) {
            let end = nx.min(x + TILE);
            let row = |z: usize| (z * ny + y) * nx;
            for z in 0..nz {
                Columns::load_row(&mut tile, z, &squares[row(z) + x..row(z) + end]);
            }
            tile.iter_mut().for_each(|columns| columns.transform(Towards::Either));
            for (z, bytes) in rows.iter_mut().enumerate() {
                let flags = interesting[row(z) + x..row(z) + end].chunks(LANES);
                for ((columns, flags), bytes) in tile.iter().zip(flags).zip(bytes[x..end].chunks_mut(LANES)) {
                    for ((out, flag), square) in bytes.iter_mut().zip(flags).zip(columns.least[z]) {
                        *out = if *flag { byte_of(true, 0) } else { byte(square) };
                    }
                }
            }
        }
    });
}

/// The rows of a list of cells by their place on the second axis, so that whoever works along the third has those that are
/// needed. Rows have `length` elements each.
pub(super) fn by_second_axis<T>(list: &mut [T], length: usize, count: usize) -> Vec<Vec<&mut [T]>> {
    let mut rows: Vec<Vec<&mut [T]>> = (0..count).map(|_| Vec::new()).collect();
    list.chunks_exact_mut(length).enumerate().for_each(|(i, row)| rows[i % count].push(row));
    rows
}
