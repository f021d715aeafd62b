//! A distance transform that is kept with what it went through, so that a change of some cells costs little more than what it
//! reaches: the same distances as of [`super::distance`] and [`super::octants`], byte for byte.
//!
//! Kept are the squares after each axis, for each way that rays may go along those so far, and what bounds the nearest cells
//! along the second axis and the third.

use super::axes::Axes;
use super::axis::Towards;
use super::grid::{DistanceField, FAR, Grid, OCTANTS, byte_of};
use super::square::{bytes_by_cells, free_voxels, weight};

/// Distances of all cells, with what an update of them needs.
pub struct Transform {
    interesting: Vec<bool>,
    distances: DistanceField,
    squares: Squares,
}

/// Squared distances on the way to all bytes.
enum Squares {
    /// Of cells that are cubes, with the byte of each square.
    Cubes(Axes<u16>, Vec<u8>),
    Boxes(Axes<u32>),
}

impl Transform {
    /// Distances of all cells of `grid` to the nearest that is `interesting` (one flag a cell, x fastest), for each octant that
    /// rays may go into, or for rays that go anywhere.
    ///
    /// # Panics
    /// When there is not one flag a cell.
    pub fn new(grid: &Grid, octants: bool, interesting: Vec<bool>) -> Self {
        assert_eq!(interesting.len(), grid.count(), "one flag a cell");
        let ways: &[Towards] = if octants { &Towards::WAYS } else { &[Towards::Either] };
        let octants = if octants { OCTANTS } else { 1 };
        let squares = match bytes_by_cells(grid) {
            Some(bytes) => Squares::Cubes(Axes::new(grid, ways, [1; 3]), bytes),
            None => Squares::Boxes(Axes::new(grid, ways, grid.sides.to_array().map(weight))),
        };
        let bytes = interesting.iter().flat_map(|flag| std::iter::repeat_n(byte_of(*flag, FAR), octants)).collect();
        let mut made = Self { interesting, distances: DistanceField { grid: *grid, octants, bytes }, squares };
        made.transform(None);
        made
    }

    pub fn interesting(&self) -> &[bool] {
        &self.interesting
    }

    pub fn distances(&self) -> &DistanceField {
        &self.distances
    }

    /// Turns the flags of some cells: of each slab of the same z, in their order and numbered x fastest from its first.
    ///
    /// # Panics
    /// When a cell is not in its slab.
    pub fn flip(&mut self, slabs: &[Vec<usize>]) {
        let [nx, ny, _] = self.distances.grid.cells;
        let octants = self.distances.octants;
        let bytes = self.distances.bytes.chunks_exact_mut(octants * nx * ny);
        let flags = self.interesting.chunks_exact_mut(nx * ny);
        for ((flags, bytes), cells) in flags.zip(bytes).zip(slabs) {
            for cell in cells {
                flags[*cell] = !flags[*cell];
                // What was interesting had a square of 0; where that stays, it is next to one that is.
                bytes[octants * cell..][..octants].fill(byte_of(flags[*cell], 0));
            }
        }
        if slabs.iter().any(|cells| !cells.is_empty()) {
            self.transform(Some(slabs));
        }
    }

    /// Transforms what follows from cells that have changed; none where all may have.
    fn transform(&mut self, cells: Option<&[Vec<usize>]>) {
        let (flags, distances) = (&self.interesting, &mut self.distances);
        match &mut self.squares {
            Squares::Cubes(axes, of) => axes.update(flags, cells, distances, |square| of[usize::from(square)]),
            Squares::Boxes(axes) => axes.update(flags, cells, distances, boxes_byte),
        }
    }
}

fn boxes_byte(square: u32) -> u8 {
    byte_of(false, free_voxels(square))
}
