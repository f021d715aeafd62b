//! The cells of a distance structure, and distances kept for each of them.

use glam::DVec3;

use crate::scene::Field;

/// The largest distance kept: at least so many voxels, or nothing interesting at all.
pub const FAR: u8 = u8::MAX - 1;

/// What a distance is less than the true one before it is floored, in voxels: room for the rounding of whoever jumps
/// by it, so that a sample exactly at the distance is not on the wrong side of a face.
pub const SLACK: f64 = 1.0 / 512.0;

/// Octants a ray may point into; bit a is set where it goes down on axis a.
pub const OCTANTS: usize = 8;

/// Boxes of `cell`^3 cells of a volume. Lengths are in voxels of the finest spacing; the origin is the centre of the
/// first voxel, where the first cell begins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    /// Cells of the volume along a side of one of the grid's; the last ones may hold fewer.
    pub cell: usize,
    /// Cells of the grid along x, y and z.
    pub cells: [usize; 3],
    /// Sides of one of the grid's cells, each at least `cell`.
    pub sides: DVec3,
    /// Cells of the volume.
    pub volume_cells: [usize; 3],
}

impl Grid {
    pub fn new(field: &Field, cell: u32) -> Self {
        let cell = cell as usize;
        let spacing = DVec3::from_array(field.volume.spacing);
        let volume_cells = field.cells();
        Self {
            cell,
            cells: volume_cells.map(|n| n.div_ceil(cell)),
            // Exactly `cell` where spacings are equal.
            sides: spacing / spacing.min_element() * cell as f64,
            volume_cells,
        }
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.cells.iter().product()
    }

    /// Where a cell lies in lists, x fastest.
    pub fn index(&self, [x, y, z]: [usize; 3]) -> usize {
        (z * self.cells[1] + y) * self.cells[0] + x
    }
}

/// The byte kept of a cell: 0 where it is interesting, else one more than the whole voxels that are free from it on; so
/// the neighbours of interesting cells have 1, as in distances from voxel to voxel.
pub fn byte_of(interesting: bool, free: u8) -> u8 {
    if interesting { 0 } else { free.min(FAR) + 1 }
}

/// Whole voxels (of the finest spacing) that a ray may go from anywhere in a cell and not enter an interesting one.
#[derive(Clone, Debug, PartialEq)]
pub struct DistanceField {
    pub grid: Grid,
    /// 1 for rays in any direction (of those the field was made for), or [`OCTANTS`].
    pub octants: usize,
    /// One [`byte_of`] a cell and octant, octants side by side, x fastest.
    pub bytes: Vec<u8>,
}

impl DistanceField {
    /// From a cell of the volume on, for a ray that points into `octant`, up to [`FAR`]; none where the cell itself is
    /// interesting.
    pub fn free(&self, cell: [usize; 3], octant: usize) -> Option<u8> {
        let octant = if self.octants == 1 { 0 } else { octant };
        self.bytes[self.grid.index(cell.map(|c| c / self.grid.cell)) * self.octants + octant].checked_sub(1)
    }
}

/// The octant that a direction points into.
pub fn octant_of(direction: DVec3) -> usize {
    (0..3).map(|axis| usize::from(direction[axis] < 0.0) << axis).sum()
}
