//! Linear cells of all kinds, cut into tetrahedra so that cells beside each other cut the face between them alike.
//!
//! A cell is cut from its corner of the least number, over the faces that lack it, and a quadrilateral from its own corner of the least
//! number: how a face is cut depends on its corners alone [Dompierre et al. 1999].

use crate::error::{Error, Result};

/// A kind of linear cells.
pub struct CellKind {
    pub name: &'static str,
    pub corners: usize,
    /// The corners of each face, in a ring; of triangles the first three.
    faces: &'static [Face],
}

/// Corners of a face, and how many there are.
type Face = ([usize; 4], usize);

const fn three(a: usize, b: usize, c: usize) -> Face {
    ([a, b, c, c], 3)
}

const fn four(a: usize, b: usize, c: usize, d: usize) -> Face {
    ([a, b, c, d], 4)
}

pub static TETRAHEDRON: CellKind = CellKind {
    name: "tetrahedron",
    corners: 4,
    faces: &[three(1, 2, 3), three(0, 3, 2), three(0, 1, 3), three(0, 2, 1)],
};

/// A square, and the apex.
pub static PYRAMID: CellKind = CellKind {
    name: "pyramid",
    corners: 5,
    faces: &[four(0, 1, 2, 3), three(0, 1, 4), three(1, 2, 4), three(2, 3, 4), three(3, 0, 4)],
};

/// A triangle and the one opposite.
pub static WEDGE: CellKind = CellKind {
    name: "wedge",
    corners: 6,
    faces: &[three(0, 1, 2), three(3, 4, 5), four(0, 1, 4, 3), four(1, 2, 5, 4), four(2, 0, 3, 5)],
};

/// A ring of four and the one opposite.
pub static HEXAHEDRON: CellKind = CellKind {
    name: "hexahedron",
    corners: 8,
    faces: &[
        four(0, 1, 2, 3),
        four(4, 5, 6, 7),
        four(0, 1, 5, 4),
        four(1, 2, 6, 5),
        four(2, 3, 7, 6),
        four(3, 0, 4, 7),
    ],
};

/// A hexahedron whose corners are numbered along the axes, the first fastest.
pub static VOXEL: CellKind = CellKind {
    name: "voxel",
    corners: 8,
    faces: &[
        four(0, 1, 3, 2),
        four(4, 5, 7, 6),
        four(0, 1, 5, 4),
        four(1, 3, 7, 5),
        four(3, 2, 6, 7),
        four(2, 0, 4, 6),
    ],
};

/// Tetrahedra as they are cut.
pub struct Cutter<'a> {
    name: &'a str,
    pub cells: Vec<[u32; 4]>,
}

impl<'a> Cutter<'a> {
    /// For cells of an input of that name.
    pub fn new(name: &'a str) -> Self {
        Self { name, cells: Vec::new() }
    }

    /// Adds a cell; its parts that have no four corners are left out.
    ///
    /// # Errors
    /// When there are more cells than can be, or not enough memory.
    pub fn add(&mut self, kind: &CellKind, corners: &[u32]) -> Result<()> {
        let from = corners.iter().copied().min().unwrap_or(0);
        for (face, count) in kind.faces {
            let ring = &face.map(|corner| corners[corner])[..*count];
            if ring.contains(&from) {
                continue;
            }
            let first = (0..ring.len()).min_by_key(|at| ring[*at]).unwrap_or(0);
            let at = |i: usize| ring[(first + i) % ring.len()];
            for i in 1..ring.len() - 1 {
                self.push([from, at(0), at(i), at(i + 1)])?;
            }
        }
        Ok(())
    }

    fn push(&mut self, cell: [u32; 4]) -> Result<()> {
        let repeats = (1..4).any(|i| cell[..i].contains(&cell[i]));
        if repeats {
            return Ok(());
        }
        if self.cells.len() == super::MOST_CELLS {
            let problem = format!("has more than {} tetrahedra", super::MOST_CELLS);
            return Err(Error::input(self.name, problem, "use a smaller mesh"));
        }
        if self.cells.len() == self.cells.capacity() && self.cells.try_reserve(1).is_err() {
            let problem = "has more cells than there is memory for";
            return Err(Error::input(self.name, problem, "use a smaller mesh"));
        }
        self.cells.push(cell);
        Ok(())
    }
}
