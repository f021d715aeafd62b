//! The cells that a line passes through [after Garrity 1990, Weiler03 "Ray Propagation Approach"].

use super::seen::{Line, Seen, left, through, weights};
use super::{FACES, NOTHING, Tetrahedra};

/// Where a line passes through a face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FacePoint {
    /// The parameter of the line.
    pub depth: f64,
    /// x there.
    pub value: f64,
}

/// The way of a line through a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CellWay {
    pub cell: u32,
    pub from: FacePoint,
    pub to: FacePoint,
    /// Whether the line comes from outside of the mesh, or begins here.
    pub begins: bool,
}

/// A face of the boundary by which a line enters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Entry {
    /// The cell times 4, and the side.
    pub side: u32,
    pub at: FacePoint,
}

impl Tetrahedra {
    /// A corner of a cell as a line sees it.
    fn seen(&self, line: &Line, cell: u32, corner: usize) -> Seen {
        let number = self.cells[cell as usize][corner];
        line.sees(number, self.point(number))
    }

    /// The corners of a face as a line sees them.
    pub fn face(&self, line: &Line, side: u32) -> [Seen; 3] {
        FACES[side as usize % 4].map(|corner| self.seen(line, side / 4, corner))
    }

    /// Where a line passes through a face that it passes through.
    fn face_point(&self, corners: [&Seen; 3]) -> FacePoint {
        let weights = weights(corners);
        let sum =
            |of: &dyn Fn(&Seen) -> f64| corners.iter().zip(weights).map(|(corner, weight)| weight * of(corner)).sum();
        FacePoint { depth: sum(&|seen| seen.depth), value: sum(&|seen| f64::from(self.values[seen.number as usize])) }
    }

    /// The faces of the boundary by which a line enters, at rising parameters.
    pub fn entries(&self, line: &Line, ray: (glam::DVec3, glam::DVec3)) -> Vec<Entry> {
        let (origin, direction) = ray;
        // Boxes are met from a place in front of all of them.
        let back = 4.0 + origin.length();
        let from = origin - direction * (back / direction.length());
        let mut entries: Vec<Entry> = Vec::new();
        for number in self.hierarchy.met(from, direction, BESIDE) {
            let side = self.boundary[number as usize];
            let [a, b, c] = self.face(line, side);
            // Its corners go round to the left seen from outside, and to the right from within.
            if through([&a, &b, &c]) == Some(false) {
                entries.push(Entry { side, at: self.face_point([&a, &b, &c]) });
            }
        }
        entries.sort_by(|a, b| a.at.depth.total_cmp(&b.at.depth).then(a.side.cmp(&b.side)));
        entries
    }

    /// The ways through cells from a face of the boundary, by which the line enters, to the next.
    pub fn chain(&self, line: &Line, entry: Entry) -> impl Iterator<Item = CellWay> {
        let (mut side, mut from) = (entry.side, entry.at);
        let mut left_over = self.cells.len();
        let mut begins = true;
        std::iter::from_fn(move || {
            if side == NOTHING || left_over == 0 {
                return None;
            }
            // A chain has no cell twice.
            left_over -= 1;
            let (leaves, to) = self.leave(line, side)?;
            let way = CellWay { cell: side / 4, from, to, begins };
            begins = false;
            (side, from) = (self.across[leaves as usize / 4][leaves as usize % 4], to);
            Some(way)
        })
    }

    /// The side at which a line leaves a cell that it enters by another, and where.
    pub fn leave(&self, line: &Line, enters: u32) -> Option<(u32, FacePoint)> {
        let (cell, entered) = (enters / 4, enters as usize % 4);
        let apex = self.seen(line, cell, entered);
        let corners = FACES[entered];
        let seen = corners.map(|corner| self.seen(line, cell, corner));
        let turn = left(&seen[0], &seen[1]);
        let apart = [0, 1, 2].map(|i| left(&apex, &seen[i]) == turn);
        // Of the three faces at the apex it is the one whose edge the line passes on the other side of than the two others.
        let edge = (0..3).find(|i| apart[*i] && !apart[(i + 1) % 3])?;
        let opposite = corners[(edge + 2) % 3];
        let to = self.face_point([&apex, &seen[edge], &seen[(edge + 1) % 3]]);
        Some((4 * cell + opposite as u32, to))
    }
}

/// Boxes of faces are wider by this on all sides, in volume space: places across a line are rounded.
const BESIDE: f64 = 1e-12;
