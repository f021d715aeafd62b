//! How many cells a ray of a view goes through at the most.

use glam::DVec3;

use super::{FACES, NOTHING, Tetrahedra};
use crate::math::ray::ViewRays;

/// Faces that are seen from the side are passed in either direction by rays in single precision: so many cells more.
const MORE: u32 = 8;

impl Tetrahedra {
    /// A bound of the cells that any ray of a view goes through: the longest way from cell to cell over faces whose backs are seen. Where cells
    /// hide each other in a circle it is cut open, and a way may come there from any other.
    pub fn most_cells(&self, rays: &ViewRays) -> u32 {
        let count = self.cells.len();
        let mut before = vec![0u8; count];
        // A bit a side: whether rays leave by it.
        let mut leaves = vec![0u8; count];
        for (cell, across) in self.across.iter().enumerate() {
            for (side, other) in
                across.iter().enumerate().filter(|(_, other)| **other as usize / 4 > cell && **other != NOTHING)
            {
                let (from, by, to) = match self.is_left(4 * cell as u32 + side as u32, rays) {
                    true => (cell, side, *other as usize / 4),
                    false => (*other as usize / 4, *other as usize % 4, cell),
                };
                leaves[from] |= 1 << by;
                before[to] += 1;
            }
        }
        let mut longest = vec![1u32; count];
        let mut ready: Vec<u32> = (0..count as u32).filter(|cell| before[*cell as usize] == 0).collect();
        // Cells with some before them that were seen, and others that were not.
        let mut waiting: Vec<u32> = Vec::new();
        let mut is_seen = vec![false; count];
        let (mut most, mut circles, mut next_unseen) = (0, 0u32, 0);
        loop {
            let unseen = |is_seen: &[bool]| (next_unseen..count).find(|cell| !is_seen[*cell]);
            let cell = match ready.pop() {
                Some(cell) => cell as usize,
                // One of a circle, or behind one: what was before it counts as another way.
                None => match waiting.pop().map(|cell| cell as usize).or_else(|| unseen(&is_seen)) {
                    Some(cell) if is_seen[cell] => continue,
                    Some(cell) => {
                        circles += 1;
                        cell
                    }
                    None => break,
                },
            };
            if std::mem::replace(&mut is_seen[cell], true) {
                continue;
            }
            while next_unseen < count && is_seen[next_unseen] {
                next_unseen += 1;
            }
            most = most.max(longest[cell]);
            for side in (0..4).filter(|side| leaves[cell] >> side & 1 == 1) {
                let next = self.across[cell][side] as usize / 4;
                if is_seen[next] {
                    continue;
                }
                longest[next] = longest[next].max(longest[cell] + 1);
                before[next] -= 1;
                if before[next] == 0 { ready.push(next as u32) } else { waiting.push(next as u32) }
            }
        }
        // A way goes through each cell where circles were cut open once at the most.
        most.saturating_mul(circles + 1).saturating_add(MORE).min(count as u32)
    }

    /// Whether rays leave a cell by a side.
    fn is_left(&self, side: u32, rays: &ViewRays) -> bool {
        let [a, b, c]: [DVec3; 3] =
            FACES[side as usize % 4].map(|corner| self.point(self.cells[side as usize / 4][corner]));
        let outward = (b - a).cross(c - a);
        outward.dot(if rays.parallel() { rays.base } else { a - rays.origin }) > 0.0
    }
}
