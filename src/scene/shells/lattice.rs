//! Where the corners of cells lie: at the voxels' centres and, one more on each side, on the faces of the volume, where the value of the
//! outermost voxel stays what it is. Shells that are closed have another one on each side, in the same place, which is outside of all of
//! them.

use glam::DVec3;
use rayon::prelude::*;

use crate::error::{Error, Result};
use crate::scene::Field;

/// Nodes in a word of bits.
pub const BITS: usize = 64;

/// How shells end at the faces of the volume.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Faces {
    /// They have a rim there.
    Open,
    /// They go on along the faces, as if all values beyond were below every level.
    Closed,
}

/// The nodes of a volume.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Lattice {
    /// Voxels along x, y and z.
    pub dims: [usize; 3],
    /// Whether shells are closed at the faces of the volume.
    closed: bool,
}

impl Lattice {
    pub fn new(field: &Field, faces: Faces) -> Self {
        Self { dims: field.dims(), closed: faces == Faces::Closed }
    }

    /// Nodes on each side that are no voxels.
    fn margin(&self) -> usize {
        if self.closed { 2 } else { 1 }
    }

    /// Whether a node is outside of every shell.
    pub fn is_outside(&self, node: [usize; 3]) -> bool {
        let nodes = self.nodes();
        self.closed && (0..3).any(|axis| node[axis] == 0 || node[axis] == nodes[axis] - 1)
    }

    /// Nodes along x, y and z.
    pub fn nodes(&self) -> [usize; 3] {
        self.dims.map(|n| n + 2 * self.margin())
    }

    /// Rows of nodes along x.
    pub fn rows(&self) -> usize {
        self.nodes()[1] * self.nodes()[2]
    }

    /// Words of bits of a row.
    pub fn words(&self) -> usize {
        self.nodes()[0].div_ceil(BITS)
    }

    /// The voxel whose value a node has along an axis.
    pub fn voxel(&self, axis: usize, node: usize) -> usize {
        node.saturating_sub(self.margin()).min(self.dims[axis] - 1)
    }

    /// Where a node lies along an axis, in voxels from the volume's face on.
    pub fn place(&self, axis: usize, node: usize) -> f64 {
        (node as f64 + 0.5 - self.margin() as f64).clamp(0.0, self.dims[axis] as f64)
    }

    /// Where a node lies, in the volume's own axes, from its middle on; the longest side of the volume is 1.
    pub fn position(&self, field: &Field, node: [usize; 3]) -> DVec3 {
        let place = DVec3::from_array(std::array::from_fn(|axis| self.place(axis, node[axis])));
        (place - 0.5 * DVec3::from_array(self.dims.map(|n| n as f64))) * field.voxel()
    }

    /// The value of a node.
    pub fn value(&self, field: &Field, node: [usize; 3]) -> f32 {
        let [x, y, z] = std::array::from_fn(|axis| self.voxel(axis, node[axis]));
        field.values[(z * self.dims[1] + y) * self.dims[0] + x]
    }

    /// The row of voxels that a row of nodes has its values from.
    pub fn row_of_values<'a>(&self, field: &'a Field, row: usize) -> &'a [f32] {
        let [nx, ny, _] = self.dims;
        let (y, z) = (row % self.nodes()[1], row / self.nodes()[1]);
        let first = (self.voxel(2, z) * ny + self.voxel(1, y)) * nx;
        &field.values[first..first + nx]
    }

    /// A bit for each node of each row: whether its value is above the level, or at it.
    ///
    /// # Errors
    /// When there is not enough memory.
    pub fn above(&self, field: &Field, level: f32) -> Result<Vec<u64>> {
        let words = self.words();
        let mut bits = Vec::new();
        bits.try_reserve_exact(words * self.rows()).map_err(|_| too_little_memory(field))?;
        bits.resize(words * self.rows(), 0);
        bits.par_chunks_mut(words).enumerate().for_each(|(row, bits)| {
            let [_, rows, _] = self.nodes();
            let (first, values) = (self.margin(), self.row_of_values(field, row));
            if self.is_outside([first, row % rows, row / rows]) {
                return;
            }
            let mut set = |node: usize, value: f32| bits[node / BITS] |= u64::from(value >= level) << (node % BITS);
            set(first - 1, values[0]);
            values.iter().enumerate().for_each(|(voxel, value)| set(first + voxel, *value));
            set(first + values.len(), values[values.len() - 1]);
        });
        Ok(bits)
    }
}

/// The error where there is not enough memory for a shell.
pub(super) fn too_little_memory(field: &Field) -> Error {
    Error::input(&field.volume.name, "has a shell for which there is not enough memory", "use a smaller volume")
}
