//! A distance transform that is kept with what it went through, so that a change of some cells costs little more than what it
//! reaches: the same distances as of [`super::distance`] and [`super::octants`], byte for byte.
//!
//! Kept are the squares after the first axis and after the second, for each way that rays may go along these, and what bounds
//! the nearest cells along the second and the third ([`super::repair`]). Squares after the third are not: a byte says how large
//! they were at the most. A change goes from axis to axis: rows of cells that have changed, the squares of which along x
//! differ from what they were, and so on, [`LANES`] at a time.

use rayon::prelude::*;

use super::axis::{LANES, Square, Towards, first_axis, ways};
use super::distance::by_second_axis;
use super::grid::{DistanceField, FAR, Grid, OCTANTS, byte_of};
use super::repair::{Bounds, Change, Repair, anchors};
use super::square::{bytes_by_cells, free_voxels, weight};

/// One in so many cells: where more change, everything is transformed anew, which then costs less.
const MANY: usize = 16;

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

/// What is kept of the axes. Of two ways along an axis the second is as far on in lists as all of the first.
struct Axes<S> {
    ways: &'static [Towards],
    weights: [u32; 3],
    /// The largest square that has a byte.
    most: Vec<S>,
    /// Squares after the first axis, for each way along it; cells x fastest, then y.
    first: Vec<Vec<S>>,
    /// Squares after the second axis, for the ways along both; cells x fastest, then z.
    second: Vec<Quadrant<S>>,
    /// Of columns along the third axis, for the ways along all.
    third: Vec<Vec<Bounds>>,
}

struct Quadrant<S> {
    squares: Vec<S>,
    /// Of columns along the second axis.
    bounds: Vec<Bounds>,
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
            Some(bytes) => Squares::Cubes(Axes::new(grid, ways, [1; 3], |square| bytes[usize::from(square)]), bytes),
            None => Squares::Boxes(Axes::new(grid, ways, grid.sides.to_array().map(weight), boxes_byte)),
        };
        let distances = DistanceField { grid: *grid, octants, bytes: vec![byte_of(false, FAR); octants * grid.count()] };
        let mut made = Self { interesting, distances, squares };
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
    pub fn flip(&mut self, slabs: &[Vec<usize>]) {
        let [nx, ny, _] = self.distances.grid.cells;
        let count: usize = slabs.iter().map(Vec::len).sum();
        self.interesting.chunks_exact_mut(nx * ny).zip(slabs).for_each(|(flags, cells)| {
            cells.iter().for_each(|cell| flags[*cell] = !flags[*cell]);
        });
        if count > 0 {
            self.transform(Some(slabs).filter(|_| count < self.interesting.len() / MANY));
        }
    }

    /// Transforms what follows from cells that have changed; none where all may have.
    fn transform(&mut self, cells: Option<&[Vec<usize>]>) {
        let (flags, distances) = (&self.interesting, &mut self.distances);
        match &mut self.squares {
            Squares::Cubes(axes, of) => axes.update(flags, cells, distances, |square| of[usize::from(square)]),
            Squares::Boxes(axes) => axes.update(flags, cells, distances, boxes_byte),
        }
        let [nx, ny, _] = distances.grid.cells;
        let octants = distances.octants;
        let slabs = distances.bytes.chunks_exact_mut(octants * nx * ny).zip(flags.chunks_exact(nx * ny));
        for ((bytes, flags), cells) in slabs.zip(cells.unwrap_or_default()) {
            for cell in cells {
                let bytes = &mut bytes[octants * cell..][..octants];
                // Whose square has stayed is next to one that is interesting, and so was it.
                bytes.iter_mut().for_each(|byte| *byte = if flags[*cell] { 0 } else { byte_of(false, 0).max(*byte) });
            }
        }
    }
}

fn boxes_byte(square: u32) -> u8 {
    byte_of(false, free_voxels(square))
}

/// Changes of rows, by the group of lanes.
type Changes<S> = Vec<Vec<Change<S>>>;

/// A slab of cells of the same z, and the rows of theirs after the second axis, for each way along it.
struct Slab<'a, S> {
    flags: &'a [bool],
    cells: Option<&'a [usize]>,
    squares: &'a mut [S],
    after: Vec<(Vec<&'a mut [S]>, &'a mut [Bounds])>,
}

impl<S: Square> Axes<S> {
    fn new(grid: &Grid, ways: &'static [Towards], weights: [u32; 3], byte: impl Fn(S) -> u8) -> Self {
        let [nx, ny, nz] = grid.cells;
        let far = || vec![S::FAR; grid.count()];
        let groups = nx.div_ceil(LANES);
        let bounds = |columns: usize, length: usize| vec![[0; 2]; columns * groups * anchors(length)];
        let number = ways.len();
        let quadrant = || Quadrant { squares: far(), bounds: bounds(nz, ny) };
        Self {
            ways,
            weights,
            most: (0..=u8::MAX).map(|of| largest(|square: S| byte(square) <= of)).collect(),
            first: (0..number).map(|_| far()).collect(),
            second: (0..number * number).map(|_| quadrant()).collect(),
            third: (0..number * number * number).map(|_| bounds(ny, nz)).collect(),
        }
    }

    fn update(
        &mut self,
        flags: &[bool],
        cells: Option<&[Vec<usize>]>,
        distances: &mut DistanceField,
        byte: impl Fn(S) -> u8 + Sync,
    ) {
        for x in 0..self.ways.len() {
            let after = self.first_two(x, &distances.grid, flags, cells);
            for (y, changes) in after.iter().enumerate() {
                self.last(x + self.ways.len() * y, flags, cells.map(|_| &changes[..]), distances, &byte);
            }
        }
    }

    /// The first two axes, for one way along the first: changes after the second by the place on it, for each way along that.
    fn first_two(&mut self, x: usize, grid: &Grid, flags: &[bool], cells: Option<&[Vec<usize>]>) -> Vec<Vec<Changes<S>>> {
        let [nx, ny, nz] = grid.cells;
        let groups = nx.div_ceil(LANES);
        let (along_x, towards) = (&ways(nx, self.weights[0])[..], self.ways);
        let slabs = self.first[x].chunks_exact_mut(nx * ny).zip(flags.chunks_exact(nx * ny)).enumerate();
        let mut slabs: Vec<Slab<S>> = slabs
            .map(|(z, (squares, flags))| Slab { flags, squares, cells: cells.map(|cells| &cells[z][..]), after: Vec::new() })
            .collect();
        for quadrant in self.second.iter_mut().skip(x).step_by(towards.len()) {
            let rows = by_second_axis(&mut quadrant.squares, nx, nz);
            let bounds = quadrant.bounds.chunks_exact_mut(groups * anchors(ny));
            slabs.iter_mut().zip(rows).zip(bounds).for_each(|((slab, rows), bounds)| slab.after.push((rows, bounds)));
        }
        let found: Vec<Vec<Vec<(usize, usize, Change<S>)>>> = slabs
            .into_par_iter()
            .enumerate()
            .map_init(
                || Repair::new(ny, self.weights[1]),
                |repair, (z, slab)| slab.update(repair, z, nx, along_x, towards[x], towards),
            )
            .collect();
        let mut after: Vec<Vec<Changes<S>>> = towards.iter().map(|_| vec![vec![Vec::new(); groups]; ny]).collect();
        for of_slab in found {
            for (after, changes) in after.iter_mut().zip(of_slab) {
                changes.into_iter().for_each(|(y, group, change)| after[y][group].push(change));
            }
        }
        after
    }

    /// The third axis, of one quadrant, for both ways along it.
    fn last(
        &mut self,
        quadrant: usize,
        flags: &[bool],
        changes: Option<&[Changes<S>]>,
        distances: &mut DistanceField,
        byte: impl Fn(S) -> u8 + Sync,
    ) {
        let [nx, ny, nz] = distances.grid.cells;
        let (octants, groups) = (distances.octants, nx.div_ceil(LANES));
        let rows = by_second_axis(&mut distances.bytes, octants * nx, ny);
        let squares = self.second[quadrant].squares.par_chunks_exact(nx * nz);
        let (most, towards, weight) = (&self.most, self.ways, self.weights[2]);
        let stride = towards.len() * towards.len();
        let mut bounds: Vec<Vec<&mut [Bounds]>> = (0..ny).map(|_| Vec::new()).collect();
        for third in self.third.iter_mut().skip(quadrant).step_by(stride) {
            let of = third.chunks_exact_mut(groups * anchors(nz));
            bounds.iter_mut().zip(of).for_each(|(list, bounds)| list.push(bounds));
        }
        let planes = rows.into_par_iter().zip(squares).zip(bounds).enumerate();
        planes.for_each_init(
            || Repair::new(nz, weight),
            |repair, (y, ((mut rows, squares), mut bounds))| {
                for group in 0..groups {
                    let changes = changes.map(|changes| &changes[y][group][..]);
                    if changes.is_some_and(<[_]>::is_empty) {
                        continue;
                    }
                    let (begin, end) = (group * LANES, nx.min((group + 1) * LANES));
                    repair.load(|z| &squares[z * nx..][begin..end], changes);
                    for (way, bounds) in bounds.iter_mut().enumerate() {
                        let octant = quadrant + stride * way;
                        let bounds = &mut bounds[group * anchors(nz)..][..anchors(nz)];
                        let known = |z: usize| {
                            let bytes = &rows[z][octants * begin..octants * end];
                            let mut known = [S::FAR; LANES];
                            let of = bytes.iter().skip(octant).step_by(octants);
                            known.iter_mut().zip(of).for_each(|(known, byte)| *known = most[usize::from(*byte)]);
                            known
                        };
                        repair.transform(towards[way], bounds, changes, known);
                        for z in (0..nz).filter(|z| repair.stale[*z]) {
                            let flags = &flags[(z * ny + y) * nx..][begin..end];
                            let bytes = rows[z][octants * begin..octants * end].iter_mut().skip(octant).step_by(octants);
                            for ((out, flag), square) in bytes.zip(flags).zip(repair.columns.least[z]) {
                                *out = if *flag { byte_of(true, 0) } else { byte(square) };
                            }
                        }
                    }
                }
            },
        );
    }
}

impl<S: Square> Slab<'_, S> {
    /// Both axes in the slab: changes after the second for each way along it, with the place on it and the group of lanes.
    fn update(
        mut self,
        repair: &mut Repair<S>,
        z: usize,
        nx: usize,
        along_x: &[S],
        towards: Towards,
        ways: &[Towards],
    ) -> Vec<Vec<(usize, usize, Change<S>)>> {
        let groups = nx.div_ceil(LANES);
        let changes = self.rows(nx, along_x, towards);
        let mut found = vec![Vec::new(); ways.len()];
        for group in 0..groups {
            let changes = changes.as_ref().map(|changes| &changes[group][..]);
            if changes.is_some_and(<[_]>::is_empty) {
                continue;
            }
            let (begin, end) = (group * LANES, nx.min((group + 1) * LANES));
            let squares = &self.squares;
            repair.load(|y| &squares[y * nx..][begin..end], changes);
            for ((towards, (rows, bounds)), found) in ways.iter().zip(&mut self.after).zip(&mut found) {
                let anchors = bounds.len() / groups;
                let known = |y: usize| lanes(&rows[y][begin..end]);
                repair.transform(*towards, &mut bounds[group * anchors..][..anchors], changes, known);
                for (y, row) in rows.iter_mut().enumerate().filter(|(y, _)| repair.stale[*y]) {
                    let row = &mut row[begin..end];
                    let least = &repair.columns.least[y][..row.len()];
                    if changes.is_some() && row != least {
                        found.push((y, group, Change { place: z, before: lanes(row) }));
                    }
                    row.copy_from_slice(least);
                }
            }
        }
        found
    }

    /// The first axis: which rows have changed by groups of lanes; none where all may have.
    fn rows(&mut self, nx: usize, along_x: &[S], towards: Towards) -> Option<Changes<S>> {
        let Some(cells) = self.cells else {
            for (squares, flags) in self.squares.chunks_exact_mut(nx).zip(self.flags.chunks_exact(nx)) {
                first_axis(along_x, towards, flags, squares);
            }
            return None;
        };
        let mut changes = vec![Vec::new(); nx.div_ceil(LANES)];
        let mut row = vec![S::FAR; nx];
        for of_row in cells.chunk_by(|a, b| a / nx == b / nx) {
            let y = of_row[0] / nx;
            first_axis(along_x, towards, &self.flags[y * nx..][..nx], &mut row);
            let groups = row.chunks(LANES).zip(self.squares[y * nx..][..nx].chunks_mut(LANES));
            for ((new, old), changes) in groups.zip(&mut changes).filter(|((new, old), _)| new != old) {
                changes.push(Change { place: y, before: lanes(old) });
                old.copy_from_slice(new);
            }
        }
        Some(changes)
    }
}

/// A row of [`LANES`] or fewer, far where there is none.
fn lanes<S: Square>(row: &[S]) -> [S; LANES] {
    row.try_into().unwrap_or_else(|_| {
        let mut lanes = [S::FAR; LANES];
        lanes[..row.len()].copy_from_slice(row);
        lanes
    })
}

/// The largest square of which something holds that holds of all smaller ones; the least where it holds of none.
fn largest<S: Square>(holds: impl Fn(S) -> bool) -> S {
    let (mut holding, mut beyond) = (0, S::FAR.place() + 1);
    while beyond - holding > 1 {
        let middle = holding.midpoint(beyond);
        if holds(S::of_place(middle)) { holding = middle } else { beyond = middle }
    }
    S::of_place(holding)
}
