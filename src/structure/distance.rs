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
//! The transform is separable: sums of squares are minimised axis by axis, first by two scans along x, then along y
//! and z as the lower envelope of parabolas (Felzenszwalb and Huttenlocher, Distance Transforms of Sampled
//! Functions, 2012, §2). Departures: (1) the dilation is done along each axis just before its transform; (2) distances
//! of 256 and more are one and the same, so parabolas that high are left out; (3) squares are integers
//! ([`super::square`]), which f64 holds exactly.

use rayon::prelude::*;

use super::grid::{DistanceField, FAR, Grid, byte_of};
use super::square::{FAR_SQUARED, free_voxels, reach, square_of, weight};

/// Columns that are transformed together: a cache line of f32, so that each line is fetched once.
const TILE: usize = 16;

/// Distances of all cells of `grid` to the nearest that is `interesting` (one flag a cell, x fastest). The bound is for
/// exact positions: who steps along a ray in f32 owes it the rounding of the ray's own positions.
///
/// # Panics
/// When there is not one flag a cell.
pub fn omni(grid: &Grid, interesting: &[bool]) -> DistanceField {
    let [nx, ny, nz] = grid.cells;
    let weights: [u32; 3] = std::array::from_fn(|axis| weight(grid.sides[axis]));
    assert_eq!(interesting.len(), nx * ny * nz, "one flag a cell");
    let mut bytes = vec![byte_of(false, FAR); interesting.len()];
    if !interesting.contains(&true) {
        return DistanceField { grid: *grid, octants: 1, bytes };
    }

    // Along x and y, slab by slab: squared distances within the slab.
    let mut squares = vec![FAR_SQUARED; interesting.len()];
    squares.par_chunks_mut(nx * ny).zip(interesting.par_chunks(nx * ny)).for_each(|(squares, flags)| {
        if !flags.contains(&true) {
            return;
        }
        for (squares, flags) in squares.chunks_exact_mut(nx).zip(flags.chunks_exact(nx)) {
            scan(weights[0], flags, squares);
        }
        let mut envelope = Envelope::new(ny, weights[1]);
        for x in (0..nx).step_by(TILE) {
            let width = TILE.min(nx - x);
            envelope.load(width, |y| &squares[y * nx + x..][..width]);
            envelope.transform();
            for (y, row) in squares.chunks_exact_mut(nx).enumerate() {
                envelope.store(y, &mut row[x..][..width], |square| square);
            }
        }
    });

    // Along z, for each y. Threads need slices of their own, so the result is in the order y, z, x first.
    let mut turned = vec![FAR; interesting.len()];
    turned.par_chunks_mut(nx * nz).enumerate().for_each(|(y, turned)| {
        let mut envelope = Envelope::new(nz, weights[2]);
        for x in (0..nx).step_by(TILE) {
            let width = TILE.min(nx - x);
            envelope.load(width, |z| &squares[(z * ny + y) * nx + x..][..width]);
            envelope.transform();
            for (z, row) in turned.chunks_exact_mut(nx).enumerate() {
                envelope.store(z, &mut row[x..][..width], free_voxels);
            }
        }
    });
    let slabs = bytes.par_chunks_mut(nx * ny).zip(interesting.par_chunks(nx * ny));
    slabs.enumerate().for_each(|(z, (slab, flags))| {
        for (y, (row, flags)) in slab.chunks_exact_mut(nx).zip(flags.chunks_exact(nx)).enumerate() {
            let free = &turned[(y * nz + z) * nx..][..nx];
            row.iter_mut().zip(flags).zip(free).for_each(|((byte, flag), free)| *byte = byte_of(*flag, *free));
        }
    });
    DistanceField { grid: *grid, octants: 1, bytes }
}

/// Squared box distance to the nearest flag of a row.
fn scan(weight: u32, flags: &[bool], squares: &mut [u32]) {
    let reach = reach(weight);
    // Between boxes, so one cell less than between indices; the row starts as if beyond reach.
    let mut since = reach + 1;
    for (flag, out) in flags.iter().zip(&mut *squares) {
        since = if *flag { 0 } else { (reach + 1).min(since + 1) };
        *out = square_of(since.saturating_sub(1), weight, reach);
    }
    since = reach + 1;
    for (flag, out) in flags.iter().zip(squares).rev() {
        since = if *flag { 0 } else { (reach + 1).min(since + 1) };
        *out = (*out).min(square_of(since.saturating_sub(1), weight, reach));
    }
}

/// A tile of columns and the lower envelope of the parabolas that stand on one.
struct Envelope {
    length: usize,
    /// Square of a cell's side along the column.
    weight: f64,
    /// The tile, column after column.
    columns: Vec<f64>,
    /// Parabolas of the envelope, in rising order: where the apex stands and how high, in units of `weight` that height
    /// and the square of its place, and the place from which on this parabola is the lowest.
    apex: Vec<usize>,
    foot: Vec<f64>,
    height: Vec<f64>,
    from: Vec<f64>,
    /// 1 / (2 d), for the meeting point of parabolas d apart.
    half_inverse: Vec<f64>,
}

impl Envelope {
    fn new(length: usize, weight: u32) -> Self {
        Self {
            length,
            weight: f64::from(weight),
            columns: vec![0.0; length * TILE],
            apex: vec![0; length],
            foot: vec![0.0; length],
            height: vec![0.0; length],
            from: vec![0.0; length],
            half_inverse: (0..length).map(|d| 0.5 / d as f64).collect(),
        }
    }

    /// Takes a tile of `width` columns, given row by row.
    fn load<'a>(&mut self, width: usize, row: impl Fn(usize) -> &'a [u32]) {
        for i in 0..self.length {
            for (column, value) in row(i)[..width].iter().enumerate() {
                self.columns[column * self.length + i] = f64::from(*value);
            }
        }
    }

    /// Gives row `i` of the tile.
    fn store<T>(&self, i: usize, row: &mut [T], convert: impl Fn(u32) -> T) {
        for (column, out) in row.iter_mut().enumerate() {
            // The cast saturates.
            *out = convert((self.columns[column * self.length + i] as u32).min(FAR_SQUARED));
        }
    }

    /// Every column: f(i) becomes the least of (max(|i - j| - 1, 0) side)^2 + f(j) over all j.
    fn transform(&mut self) {
        let mut columns = std::mem::take(&mut self.columns);
        for column in columns.chunks_exact_mut(self.length) {
            dilate(column);
            self.lower(column);
        }
        self.columns = columns;
    }

    /// One column: f(i) becomes the least of ((i - j) side)^2 + f(j) over all j.
    fn lower(&mut self, column: &mut [f64]) {
        let mut count = 0;
        for (i, &f) in column.iter().enumerate() {
            if f >= f64::from(FAR_SQUARED) {
                continue;
            }
            let place = i as f64;
            let height = f / self.weight + place * place;
            let mut from = f64::NEG_INFINITY;
            while count > 0 {
                let top = count - 1;
                from = (height - self.height[top]) * self.half_inverse[i - self.apex[top]];
                if from > self.from[top] {
                    break;
                }
                // The new one is the lower from before the top one begins: the top one is never lowest.
                count = top;
            }
            if count == 0 {
                from = f64::NEG_INFINITY;
            }
            (self.apex[count], self.foot[count]) = (i, f);
            (self.height[count], self.from[count]) = (height, from);
            count += 1;
        }
        if count == 0 {
            column.fill(f64::INFINITY);
            return;
        }
        let mut begin = 0;
        for k in 0..count {
            let end = match self.from[..count].get(k + 1) {
                Some(from) => (from.ceil().max(0.0) as usize).min(self.length),
                None => self.length,
            };
            let foot = self.foot[k];
            let first = begin as f64 - self.apex[k] as f64;
            for (i, out) in column[begin..end].iter_mut().enumerate() {
                let along = first + i as f64;
                *out = along * along * self.weight + foot;
            }
            begin = end;
        }
    }
}

/// The least of each value and its two neighbours.
fn dilate(column: &mut [f64]) {
    let mut before = f64::INFINITY;
    for i in 0..column.len() {
        let here = column[i];
        let after = column.get(i + 1).copied().unwrap_or(f64::INFINITY);
        column[i] = here.min(before).min(after);
        before = here;
    }
}
