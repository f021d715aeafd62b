//! The squares of a distance transform after each of its axes, and how a change goes from one to the next: rows of cells that have
//! changed, the squares along x that differ from what they were, and so on, [`LANES`] at a time.
//!
//! Columns of lanes lie together, of one place after the other, for the axis that is transformed next.

use rayon::prelude::*;

use super::axis::{LANES, Square, Towards, first_axis, ways};
use super::distance::by_second_axis;
use super::grid::{DistanceField, Grid};
use super::repair::{Bounds, Change, Known, Repair, anchors};

/// Bytes that come from memory at a time.
const LINE: usize = 64;

/// What is kept of the axes. Of two ways along an axis, what is of the second is as far on in lists as there is of the first.
pub(super) struct Axes<S> {
    ways: &'static [Towards],
    weights: [u32; 3],
    /// Squares after the first axis, for each way along it: of slabs of the same z, by groups of [`LANES`] along x, then y.
    first: Vec<Vec<Row<S>>>,
    /// After the second axis, for the ways along both: of planes of the same y, by groups along x, then z.
    second: Vec<Vec<Row<S>>>,
    /// After the third, for the ways along all; as after the second.
    third: Vec<Vec<Row<S>>>,
    /// Of the columns of `first` in the order of `second`, and of those of `second` in the order of `third`.
    bounds: [Vec<Vec<Bounds>>; 2],
}

type Row<S> = [S; LANES];

/// The squares of a row that are others now: its place along the axis to come, and its group.
#[derive(Clone, Copy)]
struct Found<S> {
    place: usize,
    group: usize,
    row: Row<S>,
}

impl<S: Square> Axes<S> {
    /// What is kept where nothing is interesting, before the first update.
    pub fn new(grid: &Grid, ways: &'static [Towards], weights: [u32; 3]) -> Self {
        let [nx, ny, nz] = grid.cells;
        let groups = nx.div_ceil(LANES);
        let number = ways.len();
        let lists = |axes: u32| (0..number.pow(axes)).map(|_| vec![[S::FAR; LANES]; groups * ny * nz]).collect();
        let bounds = |axes: u32, count: usize| (0..number.pow(axes)).map(|_| vec![[0; 2]; groups * count]).collect();
        Self {
            ways,
            weights,
            first: lists(1),
            second: lists(2),
            third: lists(3),
            bounds: [bounds(2, nz * anchors(ny)), bounds(3, ny * anchors(nz))],
        }
    }

    /// Updates the bytes, of which those of interesting cells are 0 already, for cells that have changed, by slabs of the same z;
    /// none where all may have. `byte` is that of a cell that is not interesting, by its square.
    pub fn update(
        &mut self,
        flags: &[bool],
        cells: Option<&[Vec<usize>]>,
        distances: &mut DistanceField,
        byte: impl Fn(S) -> u8 + Sync,
    ) {
        let [_, ny, _] = distances.grid.cells;
        let quadrants = self.second.len();
        let mut planes: Vec<Vec<Vec<Found<S>>>> = vec![vec![Vec::new(); quadrants]; ny];
        for x in 0..self.ways.len() {
            let slabs = self.first_two(x, &distances.grid, flags, cells);
            for (z, found) in slabs.into_iter().enumerate() {
                for (y_way, found) in found.into_iter().enumerate() {
                    let quadrant = x + self.ways.len() * y_way;
                    for found in found {
                        planes[found.place][quadrant].push(Found { place: z, ..found });
                    }
                }
            }
        }
        self.last(planes, cells.is_none(), distances, byte);
    }

    /// The first two axes, for one way along the first: what has changed in each slab, for each way along the second.
    fn first_two(
        &mut self,
        x: usize,
        grid: &Grid,
        flags: &[bool],
        cells: Option<&[Vec<usize>]>,
    ) -> Vec<Vec<Vec<Found<S>>>> {
        let [nx, ny, nz] = grid.cells;
        let groups = nx.div_ceil(LANES);
        let (along_x, towards) = (&ways(nx, self.weights[0])[..], self.ways);
        let weight = self.weights[1];
        let after: Vec<&[Row<S>]> = self.second.iter().skip(x).step_by(towards.len()).map(|rows| &rows[..]).collect();
        let bounds = self.bounds[0].iter_mut().skip(x).step_by(towards.len());
        let bounds = by_sheets(bounds, groups * anchors(ny), nz);
        let slabs = self.first[x].par_chunks_exact_mut(groups * ny).zip(flags.par_chunks_exact(nx * ny)).zip(bounds);
        slabs
            .enumerate()
            .map_init(
                || Repair::new(ny, weight),
                |repair, (z, ((rows, flags), mut bounds))| {
                    let changes = first(
                        rows,
                        flags,
                        nx,
                        cells.map(|cells| cells.get(z).map_or(&[][..], Vec::as_slice)),
                        along_x,
                        towards[x],
                    );
                    let known = |way: usize, group: usize| Known {
                        rows: after[way],
                        begin: group * nz + z,
                        stride: groups * nz,
                    };
                    next(repair, rows, changes.as_deref(), towards, &mut bounds, known)
                },
            )
            .collect()
    }

    /// The third axis and the bytes, from what has changed in each plane of the same y, for the ways along the first two.
    fn last(
        &mut self,
        planes: Vec<Vec<Vec<Found<S>>>>,
        whole: bool,
        distances: &mut DistanceField,
        byte: impl Fn(S) -> u8 + Sync,
    ) {
        let [nx, ny, nz] = distances.grid.cells;
        let (octants, groups) = (distances.octants, nx.div_ceil(LANES));
        let (ways, weight) = (self.ways, self.weights[2]);
        let bytes = by_second_axis(&mut distances.bytes, octants * nx, ny);
        let second = by_sheets(&mut self.second, groups * nz, ny);
        let third = by_sheets(&mut self.third, groups * nz, ny);
        let bounds = by_sheets(&mut self.bounds[1], groups * anchors(nz), ny);
        let kept = second.into_par_iter().zip(third).zip(bounds).zip(bytes);
        planes.into_par_iter().zip(kept).for_each_init(
            || (Repair::new(nz, weight), vec![Vec::new(); groups]),
            |(repair, changes), (found, (((second, third), bounds), bytes))| {
                let mut plane = Plane { second, third, bounds, bytes, octants };
                for (quadrant, found) in found.into_iter().enumerate() {
                    plane.take(quadrant, nz, found, changes);
                    let changes = Some(&changes[..]).filter(|_| !whole);
                    plane.update(quadrant, nz, ways, repair, changes, &byte);
                }
            },
        );
    }
}

/// What is kept of the cells of the same y, with their bytes by z.
struct Plane<'a, S> {
    second: Vec<&'a mut [Row<S>]>,
    third: Vec<&'a mut [Row<S>]>,
    bounds: Vec<&'a mut [Bounds]>,
    bytes: Vec<&'a mut [u8]>,
    octants: usize,
}

impl<S: Square> Plane<'_, S> {
    /// Takes over what the second axis has found for a quadrant, as changes by groups.
    fn take(&mut self, quadrant: usize, nz: usize, found: Vec<Found<S>>, changes: &mut [Vec<Change<S>>]) {
        changes.iter_mut().for_each(Vec::clear);
        let rows = &mut self.second[quadrant];
        for Found { place, group, row } in found {
            let before = std::mem::replace(&mut rows[group * nz + place], row);
            changes[group].push(Change { place, before });
        }
    }

    /// Updates the octants of a quadrant.
    fn update(
        &mut self,
        quadrant: usize,
        nz: usize,
        ways: &[Towards],
        repair: &mut Repair<S>,
        changes: Option<&[Vec<Change<S>>]>,
        byte: impl Fn(S) -> u8,
    ) {
        let quadrants = self.second.len();
        let (rows, third) = (&*self.second[quadrant], &self.third);
        let mut bounds: Vec<&mut [Bounds]> =
            self.bounds.iter_mut().skip(quadrant).step_by(quadrants).map(|bounds| &mut **bounds).collect();
        let octant = |way: usize| quadrant + quadrants * way;
        let known = |way: usize, group: usize| Known { rows: third[octant(way)], begin: group * nz, stride: 1 };
        let found = next(repair, rows, changes, ways, &mut bounds, known);
        for (way, found) in found.into_iter().enumerate() {
            self.put(octant(way), nz, &found, &byte);
        }
    }

    /// Puts squares that are others now and their bytes where they belong.
    fn put(&mut self, octant: usize, nz: usize, found: &[Found<S>], byte: impl Fn(S) -> u8) {
        let octants = self.octants;
        // Rows of bytes lie far apart: asked for before the first is needed, they come side by side.
        for Found { place, group, .. } in found {
            let row = self.bytes[*place][octants * LANES * group..].iter();
            row.take(octants * LANES).step_by(LINE).for_each(|byte| _ = std::hint::black_box(*byte));
        }
        for Found { place, group, row } in found {
            self.third[octant][group * nz + place] = *row;
            let bytes = self.bytes[*place].chunks_exact_mut(octants).skip(group * LANES);
            for (bytes, square) in bytes.zip(row) {
                // Those of interesting cells stay 0; without a branch.
                bytes[octant] = byte(*square) * u8::from(bytes[octant] > 0);
            }
        }
    }
}

/// Lists by the `count` sheets that they are of, `length` elements of each list.
fn by_sheets<'a, T: 'a>(
    lists: impl IntoIterator<Item = &'a mut Vec<T>>,
    length: usize,
    count: usize,
) -> Vec<Vec<&'a mut [T]>> {
    let mut sheets: Vec<Vec<&mut [T]>> = (0..count).map(|_| Vec::new()).collect();
    for list in lists {
        sheets.iter_mut().zip(list.chunks_exact_mut(length)).for_each(|(sheet, part)| sheet.push(part));
    }
    sheets
}

/// The first axis in a slab: which rows have changed by groups of lanes; none where all may have.
fn first<S: Square>(
    rows: &mut [Row<S>],
    flags: &[bool],
    nx: usize,
    cells: Option<&[usize]>,
    along_x: &[S],
    towards: Towards,
) -> Option<Vec<Vec<Change<S>>>> {
    let ny = flags.len() / nx;
    let mut squares = vec![S::FAR; nx.next_multiple_of(LANES)];
    let Some(cells) = cells else {
        for (y, flags) in flags.chunks_exact(nx).enumerate() {
            first_axis(along_x, towards, flags, &mut squares[..nx]);
            for (row, of) in rows.iter_mut().skip(y).step_by(ny).zip(squares.as_chunks().0) {
                *row = *of;
            }
        }
        return None;
    };
    let mut changes = vec![Vec::new(); nx.div_ceil(LANES)];
    for of_row in cells.chunk_by(|a, b| a / nx == b / nx) {
        let y = of_row[0] / nx;
        let flags = &flags[y * nx..][..nx];
        // Only up to the flags beside those that have changed.
        let [begin, last] = [of_row[0], of_row[of_row.len() - 1]].map(|cell| cell % nx);
        let begin = flags[..begin].iter().rposition(|flag| *flag).unwrap_or(0);
        let end = flags[last + 1..].iter().position(|flag| *flag).map_or(nx, |after| last + 1 + after + 1);
        let groups = begin / LANES..end.div_ceil(LANES);
        let (parts, _) = squares.as_chunks_mut();
        groups.clone().for_each(|group| parts[group] = rows[group * ny + y]);
        first_axis(along_x, towards, &flags[begin..end], &mut squares[begin..end]);
        let (parts, _) = squares.as_chunks();
        for group in groups {
            let row = &mut rows[group * ny + y];
            if *row != parts[group] {
                changes[group].push(Change { place: y, before: *row });
                *row = parts[group];
            }
        }
    }
    Some(changes)
}

/// The next axis in a sheet of rows: what has changed after it, for each way along it. `known` has rows as they were by the way,
/// the group and the place.
fn next<'a, S: Square>(
    repair: &mut Repair<S>,
    rows: &[Row<S>],
    changes: Option<&[Vec<Change<S>>]>,
    ways: &[Towards],
    bounds: &mut [&mut [Bounds]],
    known: impl Fn(usize, usize) -> Known<'a, S>,
) -> Vec<Vec<Found<S>>> {
    let length = repair.stale.len();
    let mut found: Vec<Vec<Found<S>>> = ways.iter().map(|_| Vec::new()).collect();
    for (group, rows) in rows.chunks_exact(length).enumerate() {
        let changes = changes.map(|changes| &changes[group][..]);
        if changes.is_some_and(<[_]>::is_empty) {
            continue;
        }
        repair.load(rows, changes);
        for (way, (bounds, found)) in bounds.iter_mut().zip(&mut found).enumerate() {
            let bounds = &mut bounds[group * anchors(length)..][..anchors(length)];
            let known = known(way, group);
            repair.transform(ways[way], bounds, changes, &known);
            for place in (0..length).filter(|place| repair.stale[*place]) {
                let row = &repair.columns.least[place];
                if known.row(place) != row {
                    found.push(Found { place, group, row: *row });
                }
            }
        }
    }
    found
}
