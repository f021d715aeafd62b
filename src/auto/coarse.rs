//! A coarse grid over a volume: where something shows, of some voxels of each cell, and how far it is from there.

use crate::scene::Field;
use crate::structure::blocks::BLOCK;
use crate::structure::grid::OCTANTS;

/// Cells along the longest side of the grid, at the most.
const MOST_CELLS: usize = 24;

/// Voxels looked at along a side of a cell, at the most.
const LOOKED_AT: usize = 3;

/// Distances are not told apart beyond so many cells.
const FAR: u8 = u8::MAX;

/// The grid.
#[derive(Clone, Debug)]
pub struct Coarse {
    /// Voxels along a side of a cell.
    pub side: usize,
    cells: [usize; 3],
    /// Whether anything shows.
    open: Vec<bool>,
    /// Cells to the nearest that is open, in any direction.
    omni: Vec<u8>,
    /// The same within each octant.
    octants: Vec<Vec<u8>>,
    blocks: Blocks,
}

impl Coarse {
    /// Looks at some voxels of each cell: whether they show, `shows` says of their values.
    pub fn of(field: &Field, shows: impl Fn(f32) -> bool) -> Self {
        let dims = field.dims();
        let side = dims.into_iter().max().unwrap_or(1).div_ceil(MOST_CELLS);
        let cells = dims.map(|n| n.div_ceil(side));
        let mut open = vec![false; cells.iter().product()];
        let mut blocks = Blocks::new(dims);
        let looked: [Vec<usize>; 3] = dims.map(|n| (0..n).step_by(side.div_ceil(LOOKED_AT)).collect());
        for z in &looked[2] {
            for y in &looked[1] {
                let row = &field.values[(z * dims[1] + y) * dims[0]..][..dims[0]];
                let of_row = (z / side * cells[1] + y / side) * cells[0];
                for x in &looked[0] {
                    let cell = of_row + x / side;
                    if shows(row[*x]) {
                        open[cell] = true;
                        blocks.open([*x, *y, *z]);
                    }
                }
            }
        }
        let swept = |octant: usize| sweep(cells, &open, octant);
        let octants: Vec<Vec<u8>> = (0..OCTANTS).map(swept).collect();
        let omni = (0..open.len()).map(|cell| octants.iter().map(|of| of[cell]).min().unwrap_or(FAR)).collect();
        Self { side, cells, open, omni, octants, blocks }
    }

    /// The cell of a voxel.
    pub fn cell_of(&self, voxel: [usize; 3]) -> u32 {
        let [x, y, z] = voxel.map(|n| n / self.side);
        ((z * self.cells[1] + y) * self.cells[0] + x) as u32
    }

    /// The part of the cells in which something shows.
    pub fn open_share(&self) -> f64 {
        self.open.iter().filter(|open| **open).count() as f64 / self.open.len().max(1) as f64
    }

    /// Cells from one to the nearest that is open, in any direction or within an octant.
    pub fn distance(&self, cell: u32, octant: Option<usize>) -> u8 {
        octant.map_or(&self.omni, |octant| &self.octants[octant])[cell as usize]
    }

    /// Something shows at a voxel.
    pub fn open_block(&mut self, voxel: [u16; 3]) {
        self.blocks.open(voxel.map(usize::from));
    }

    /// Whether anything shows in the blocks from that of one voxel to that of another.
    pub fn blocks_are_open(&self, from: [u16; 3], to: [u16; 3]) -> bool {
        self.blocks.between(from.map(usize::from), to.map(usize::from))
    }
}

/// Blocks of [`BLOCK`] cells of the volume, and whether anything shows in them.
#[derive(Clone, Debug)]
struct Blocks {
    count: [usize; 3],
    open: Vec<bool>,
}

impl Blocks {
    fn new(voxels: [usize; 3]) -> Self {
        let count = voxels.map(|n| n.saturating_sub(1).max(1).div_ceil(BLOCK));
        Self { count, open: vec![false; count.iter().product()] }
    }

    fn of(&self, voxel: [usize; 3]) -> [usize; 3] {
        std::array::from_fn(|axis| (voxel[axis] / BLOCK).min(self.count[axis] - 1))
    }

    /// Something shows at a voxel, with which the cells on both sides of it interpolate.
    fn open(&mut self, voxel: [usize; 3]) {
        let (low, high) = (self.of(voxel.map(|n| n.saturating_sub(1))), self.of(voxel));
        for z in low[2]..=high[2] {
            for y in low[1]..=high[1] {
                let row = self.row(y, z);
                self.open[row..][low[0]..=high[0]].fill(true);
            }
        }
    }

    fn between(&self, from: [usize; 3], to: [usize; 3]) -> bool {
        let (a, b) = (self.of(from), self.of(to));
        let along = |axis: usize| a[axis].min(b[axis])..=a[axis].max(b[axis]);
        along(2).any(|z| along(1).any(|y| self.open[self.row(y, z)..][along(0)].contains(&true)))
    }

    /// Where the blocks along x with that y and z begin.
    fn row(&self, y: usize, z: usize) -> usize {
        (z * self.count[1] + y) * self.count[0]
    }
}

/// Cells from each to the nearest that is open where an octant's rays go: one way along each axis.
fn sweep(cells: [usize; 3], open: &[bool], octant: usize) -> Vec<u8> {
    // A cell more on each side, in which nothing is near, so that every cell has one ahead.
    let padded = cells.map(|n| n + 2);
    let strides = [1, padded[0], padded[0] * padded[1]];
    let ahead: [isize; 3] = std::array::from_fn(|axis| {
        let stride = strides[axis] as isize;
        if octant >> axis & 1 == 0 { stride } else { -stride }
    });
    let mut around = [0; 7];
    for (place, by) in around.iter_mut().enumerate() {
        *by = (0..3).filter(|axis| (place + 1) >> axis & 1 == 1).map(|axis| ahead[axis]).sum();
    }
    let mut far = vec![FAR; padded.iter().product()];
    // Against the rays, so that what lies ahead is known.
    let against = |axis: usize, i: usize| if octant >> axis & 1 == 0 { cells[axis] - 1 - i } else { i };
    for (z, y) in (0..cells[2]).flat_map(|z| (0..cells[1]).map(move |y| (against(2, z), against(1, y)))) {
        let row = (z * cells[1] + y) * cells[0];
        let padded_row = (z + 1) * strides[2] + (y + 1) * strides[1] + 1;
        for x in (0..cells[0]).map(|x| against(0, x)) {
            let cell = padded_row + x;
            far[cell] = match open[row + x] {
                true => 0,
                false => {
                    let near = around.iter().map(|by| far[cell.wrapping_add_signed(*by)]);
                    near.min().unwrap_or(FAR).saturating_add(1)
                }
            };
        }
    }
    let rows = (0..cells[2]).flat_map(|z| (0..cells[1]).map(move |y| (z + 1) * strides[2] + (y + 1) * strides[1] + 1));
    rows.flat_map(|row| far[row..row + cells[0]].iter().copied()).collect()
}
