//! Meshes of tetrahedra with a value at each vertex, linear within each (Weiler03).

mod boundary;
pub mod builtin;
mod connect;
pub mod cut;
mod grid;
mod longest;
pub mod seen;
mod surface;
mod walk;

pub use boundary::CellsView;
pub use connect::{FACES, NOTHING};
pub use grid::{Grid, one_of_each};
pub use surface::{CellGradient, MetInCell};
pub use walk::{CellWay, Entry, FacePoint};

use glam::DVec3;
use rayon::prelude::*;

use crate::error::Result;
use crate::math::bvh::{Bounds, Hierarchy};
use crate::math::ray::ViewRay;
use seen::Line;

/// The most cells: a cell times 4 and a side, and one more, are whole numbers of single precision.
pub const MOST_CELLS: usize = (1 << 22) - 1;

/// Cells that a box of a regular grid is cut into: what the unit of lengths goes by.
const CELLS_OF_BOX: f64 = 6.0;

/// A mesh of tetrahedra, in volume space.
#[derive(Clone, Debug)]
pub struct Tetrahedra {
    /// Vertices: the longest side of the box around them is 1, and its middle is the origin.
    pub points: Vec<[f32; 3]>,
    /// x of each vertex.
    pub values: Vec<f32>,
    /// Corners of each cell, right-handed.
    pub cells: Vec<[u32; 4]>,
    /// The side across the face opposite to each corner, as its cell times 4 and its number; [`NOTHING`] on the boundary.
    pub across: Vec<[u32; 4]>,
    /// Sides with nothing across, as cells times 4 and their numbers.
    pub boundary: Vec<u32>,
    /// The faces of the boundary beside each, over the edges from each of its corners to the next.
    pub beside: Vec<[u32; 3]>,
    /// Sides of the box around it.
    pub extent: DVec3,
    /// The side of a cube that six cells of the mean volume fill: a voxel, where the mesh is a grid of voxels cut into six.
    pub unit: f64,
    /// The longest edge of any cell, volume space: no way through one is longer.
    pub longest_edge: f64,
    /// Around the faces of the boundary.
    hierarchy: Hierarchy,
}

impl Tetrahedra {
    /// The mesh of a grid, whose points have these values as x.
    ///
    /// # Errors
    /// When three cells share a face, two lie on one side of a face, there is no volume in it, or not enough memory.
    pub fn new(grid: &Grid, values: &[f32]) -> Result<Self> {
        let (points, extent) = grid.in_volume_space()?;
        let mut cells = grid.cells.clone();
        let mut across = connect::across(&grid.name, &cells)?;
        connect::orient(&grid.name, &points, &mut cells, &mut across)?;
        let sides = (0u32..).zip(across.iter().flatten());
        let boundary: Vec<u32> = sides.filter(|(_, across)| **across == NOTHING).map(|(side, _)| side).collect();
        let volume: f64 = cells.par_iter().map(|cell| connect::volume(&points, *cell)).sum();
        let unit = (CELLS_OF_BOX * volume / cells.len() as f64).cbrt();
        grid.check_unit(unit)?;
        let at = |number: u32| DVec3::from_array(points[number as usize].map(f64::from));
        let around = |side: &u32| {
            let cell = cells[*side as usize / 4];
            Bounds::around(FACES[*side as usize % 4].map(|corner| at(cell[corner])))
        };
        let hierarchy = Hierarchy::new(&boundary.iter().map(around).collect::<Vec<_>>());
        let beside = boundary::beside(&cells, &boundary);
        let longest = |cell: &[u32; 4]| {
            let corners = cell.map(at);
            (1..4)
                .flat_map(|i| (0..i).map(move |j| (i, j)))
                .map(|(i, j)| corners[i].distance(corners[j]))
                .fold(0.0, f64::max)
        };
        let longest_edge = cells.par_iter().map(longest).reduce(|| 0.0, f64::max);
        let values = values.to_vec();
        Ok(Self { points, values, cells, across, boundary, beside, extent, unit, longest_edge, hierarchy })
    }

    /// A vertex.
    pub fn point(&self, number: u32) -> DVec3 {
        DVec3::from_array(self.points[number as usize].map(f64::from))
    }

    /// Rows of the longest list of mesh data: vertices, two for a face of the boundary, or four for the sides of a cell.
    pub fn rows(&self) -> usize {
        self.points.len().max(2 * self.boundary.len()).max(4 * self.cells.len())
    }

    /// The number of a face of the boundary among them all.
    pub fn face_number(&self, side: u32) -> u32 {
        self.boundary.binary_search(&side).unwrap_or_default() as u32
    }

    /// The ways of a ray through cells, from the parameter `near` on.
    pub fn ways(&self, ray: &ViewRay, near: f64) -> Vec<CellWay> {
        let line = Line::new(ray.origin, ray.direction);
        let entries = self.entries(&line, (ray.origin, ray.direction));
        let ways = entries.into_iter().flat_map(|entry| self.chain(&line, entry));
        ways.filter_map(|way| way.behind(near)).collect()
    }
}

impl CellWay {
    /// What of it lies behind a parameter; none where nothing does.
    pub fn behind(self, near: f64) -> Option<Self> {
        let (from, to) = (self.from, self.to);
        if from.depth >= near {
            return Some(Self { begins: self.begins || from.depth == near, ..self });
        }
        let part = (near - from.depth) / (to.depth - from.depth);
        let value = from.value + part * (to.value - from.value);
        (to.depth > near).then_some(Self { from: FacePoint { depth: near, value }, begins: true, ..self })
    }
}
