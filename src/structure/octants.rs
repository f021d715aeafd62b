//! Distance from each cell to the nearest interesting one that a ray in an octant can still reach [Thesis §5.3.1,
//! "Directional"]: on each axis the other cell lies at the same place or further where the rays go.
//!
//! Departure: the thesis' k-d trees grow along the diagonal; here each octant is a separable transform of its own, with
//! scans of one side, and is exact. Octants share the scans along x and y where they go the same way: 14 in all.
//!
//! A scan goes against the rays and asks at each place which of the cells passed so far is nearest; box distance is
//! index distance to the cells dilated by one, as in [`super::distance`]. Of two candidates the later one, once it is
//! the better, stays the better, so that candidates wait in a queue, each with the place at which it overtakes the one
//! before it. Twin of `glsl/structure/distance_scan.comp`.

use rayon::prelude::*;

use super::grid::{DistanceField, FAR, Grid, OCTANTS, byte_of};
use super::square::{FAR_SQUARED, free_voxels, reach, square_of, weight};

/// Columns that are scanned together: a cache line of squares.
const TILE: usize = 16;

/// Distances of all cells of `grid`, for each octant, to the nearest that is `interesting` (one flag a cell, x fastest).
///
/// # Panics
/// When there is not one flag a cell.
pub fn directional(grid: &Grid, interesting: &[bool]) -> DistanceField {
    let [nx, ny, nz] = grid.cells;
    assert_eq!(interesting.len(), grid.count(), "one flag a cell");
    let mut bytes = vec![byte_of(false, FAR); OCTANTS * interesting.len()];
    let field = |bytes| DistanceField { grid: *grid, octants: OCTANTS, bytes };
    if !interesting.contains(&true) {
        return field(bytes);
    }
    for x in 0..2 {
        // Both ways along y, slab by slab.
        let mut squares = [vec![FAR_SQUARED; grid.count()], vec![FAR_SQUARED; grid.count()]];
        let [up, down] = &mut squares;
        let slabs = up.par_chunks_mut(nx * ny).zip(down.par_chunks_mut(nx * ny));
        slabs.zip(interesting.par_chunks(nx * ny)).for_each(|((up, down), flags)| {
            if !flags.contains(&true) {
                return;
            }
            let mut row_squares = vec![FAR_SQUARED; flags.len()];
            for (squares, flags) in row_squares.chunks_exact_mut(nx).zip(flags.chunks_exact(nx)) {
                first_axis(weight(grid.sides.x), x == 0, flags, squares);
            }
            let mut scan = Scan::new(ny, weight(grid.sides.y));
            for (from_top, out) in [(true, up), (false, down)] {
                for column in 0..nx {
                    scan.column(from_top, |i| row_squares[i * nx + column], |i, square| out[i * nx + column] = square);
                }
            }
        });
        for (y, squares) in squares.iter().enumerate() {
            // Both ways along z, for each y; turned so that threads have slices of their own.
            let mut turned = vec![[FAR; 2]; grid.count()];
            turned.par_chunks_mut(nx * nz).enumerate().for_each(|(row, turned)| {
                let mut scan = Scan::new(nz, weight(grid.sides.z));
                let mut tile = vec![0; nz * TILE];
                for begin in (0..nx).step_by(TILE) {
                    let width = TILE.min(nx - begin);
                    for z in 0..nz {
                        let line = &squares[(z * ny + row) * nx + begin..][..width];
                        tile[z * TILE..][..width].copy_from_slice(line);
                    }
                    for column in 0..width {
                        for (z, from_top) in [true, false].into_iter().enumerate() {
                            scan.column(
                                from_top,
                                |i| tile[i * TILE + column],
                                |i, square| turned[i * nx + begin + column][z] = free_voxels(square),
                            );
                        }
                    }
                }
            });
            let slabs = bytes.par_chunks_mut(OCTANTS * nx * ny).zip(interesting.par_chunks(nx * ny));
            slabs.enumerate().for_each(|(z, (slab, flags))| {
                for (row, (line, flags)) in slab.chunks_exact_mut(OCTANTS * nx).zip(flags.chunks_exact(nx)).enumerate()
                {
                    let turned = &turned[(row * nz + z) * nx..][..nx];
                    for ((cell, flag), [up, down]) in line.chunks_exact_mut(OCTANTS).zip(flags).zip(turned) {
                        let octant = x + 2 * y;
                        (cell[octant], cell[octant + 4]) = (byte_of(*flag, *up), byte_of(*flag, *down));
                    }
                }
            });
        }
    }
    field(bytes)
}

/// Squared box distance to the nearest flag of a row that lies at the same place or further up, or down.
fn first_axis(weight: u32, up: bool, flags: &[bool], squares: &mut [u32]) {
    let reach = reach(weight);
    let mut since = reach + 1;
    let mut place = |flag: &bool, out: &mut u32| {
        since = if *flag { 0 } else { (reach + 1).min(since + 1) };
        *out = square_of(since.saturating_sub(1), weight, reach);
    };
    let pairs = flags.iter().zip(squares);
    if up {
        pairs.rev().for_each(|(flag, out)| place(flag, out));
    } else {
        pairs.for_each(|(flag, out)| place(flag, out));
    }
}

/// A cell that may be nearest.
#[derive(Clone, Copy, Default)]
struct Candidate {
    place: u32,
    /// From this place on it is nearer than the one before it.
    overtakes: u32,
    /// The square it begins with.
    foot: u32,
}

/// Scans of columns of one length.
struct Scan {
    weight: u32,
    reach: u32,
    queue: Vec<Candidate>,
    head: usize,
    tail: usize,
}

impl Scan {
    fn new(length: usize, weight: u32) -> Self {
        Self { weight, reach: reach(weight), queue: vec![Candidate::default(); length], head: 0, tail: 0 }
    }

    /// One column, from its top or its bottom: `square` of each cell becomes the least to a cell passed so far.
    fn column(&mut self, from_top: bool, square: impl Fn(usize) -> u32, mut put: impl FnMut(usize, u32)) {
        (self.head, self.tail) = (0, 0);
        let mut before = FAR_SQUARED;
        let length = self.queue.len();
        for k in 0..length {
            let i = if from_top { length - 1 - k } else { k };
            let here = square(i);
            put(i, self.advance(k as u32, here.min(before)));
            before = here;
        }
    }

    /// The least square at place `k`, where a cell with that `foot` comes in.
    fn advance(&mut self, k: u32, foot: u32) -> u32 {
        while self.head < self.tail && k - self.queue[self.head].place >= self.reach {
            self.head += 1;
        }
        if foot < FAR_SQUARED {
            self.put(k, foot);
        }
        while self.head + 1 < self.tail && self.queue[self.head + 1].overtakes <= k {
            self.head += 1;
        }
        if self.head == self.tail {
            return FAR_SQUARED;
        }
        let nearest = self.queue[self.head];
        (nearest.foot + square_of(k - nearest.place, self.weight, self.reach)).min(FAR_SQUARED)
    }

    /// Puts a cell in, behind all that it does not outdo.
    fn put(&mut self, k: u32, foot: u32) {
        let mut overtakes = k;
        while self.head < self.tail {
            let last = self.queue[self.tail - 1];
            let apart = k - last.place;
            let there = last.foot + square_of(apart, self.weight, self.reach);
            if foot > there {
                let at = k + (foot - there).div_ceil(2 * self.weight * apart);
                // The last one is of use only if it overtakes the one before it earlier.
                if self.tail - 1 == self.head || at > last.overtakes {
                    overtakes = at;
                    break;
                }
            }
            self.tail -= 1;
        }
        self.queue[self.tail] = Candidate { place: k, overtakes, foot };
        self.tail += 1;
    }
}
