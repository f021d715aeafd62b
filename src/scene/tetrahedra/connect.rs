//! Which cells share a face, and which side of them is outside.

use glam::DVec3;
use rayon::prelude::*;

use crate::error::{Error, Result};

/// What lies across a face of the boundary.
pub const NOTHING: u32 = u32::MAX;

/// The corners of the face opposite to each corner of a cell; seen from outside of a right-handed cell they go round to the left.
pub const FACES: [[usize; 3]; 4] = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]];

/// A cell counts as flat where its volume is this part of the product of its edges, or less: f64 has no sign of it.
const FLAT: f64 = 1e-14;

/// A face: its corners, rising, the cell and the side that have it.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Face {
    corners: [u32; 3],
    /// The cell times 4, and the corner that the face is opposite to.
    side: u32,
}

/// The volume of a cell, above 0 where it is right-handed; 0 where it is flat.
pub fn volume(points: &[[f32; 3]], cell: [u32; 4]) -> f64 {
    let [a, b, c, d] = cell.map(|corner| DVec3::from_array(points[corner as usize].map(f64::from)));
    let edges = [b - a, c - a, d - a];
    let six = edges[0].cross(edges[1]).dot(edges[2]);
    let most = edges.iter().map(|edge| edge.length()).product::<f64>();
    if six.abs() <= FLAT * most { 0.0 } else { six / 6.0 }
}

/// The side across each face of each cell, as the cell times 4 and the side, by the corner that the face is opposite to.
///
/// # Errors
/// When three cells share a face, or there is not enough memory.
pub fn across(name: &str, cells: &[[u32; 4]]) -> Result<Vec<[u32; 4]>> {
    let too_much = |_| Error::input(name, "has more cells than there is memory for", "use a smaller mesh");
    let mut faces: Vec<Face> = Vec::new();
    faces.try_reserve_exact(4 * cells.len()).map_err(too_much)?;
    faces.par_extend((0..4 * cells.len()).into_par_iter().map(|side| {
        let cell = cells[side / 4];
        let mut corners = FACES[side % 4].map(|corner| cell[corner]);
        corners.sort_unstable();
        Face { corners, side: side as u32 }
    }));
    faces.par_sort_unstable();
    let mut across = Vec::new();
    across.try_reserve_exact(cells.len()).map_err(too_much)?;
    across.resize(cells.len(), [NOTHING; 4]);
    for shared in faces.chunk_by(|a, b| a.corners == b.corners) {
        match shared {
            [a, b] => {
                across[a.side as usize / 4][a.side as usize % 4] = b.side;
                across[b.side as usize / 4][b.side as usize % 4] = a.side;
            }
            [a, b, c, ..] => {
                let [a, b, c] = [a, b, c].map(|face| face.side / 4);
                let problem = format!("has cells {a}, {b} and {c}, which share one face");
                return Err(Error::input(name, problem, "leave one of them out"));
            }
            _ => {}
        }
    }
    Ok(across)
}

/// Makes cells right-handed, with what lies across their faces. Flat ones are taken as their neighbours are.
///
/// # Errors
/// When two cells lie on one side of the face they share.
pub fn orient(name: &str, points: &[[f32; 3]], cells: &mut [[u32; 4]], across: &mut [[u32; 4]]) -> Result<()> {
    let mut turned: Vec<Option<bool>> = cells
        .par_iter()
        .map(|cell| {
            let volume = volume(points, *cell);
            (volume != 0.0).then_some(volume < 0.0)
        })
        .collect();
    // Flat cells beside those that are known, and those beside them.
    let flat = |turned: &[Option<bool>], side: u32| side != NOTHING && turned[side as usize / 4].is_none();
    let beside_flat =
        |cell: &u32| turned[*cell as usize].is_some() && across[*cell as usize].iter().any(|side| flat(&turned, *side));
    let mut known: Vec<u32> = (0..cells.len() as u32).filter(beside_flat).collect();
    while let Some(cell) = known.pop() {
        let Some(of_cell) = turned[cell as usize] else { continue };
        for (side, beside) in (0u32..).zip(across[cell as usize]).collect::<Vec<_>>() {
            if !flat(&turned, beside) {
                continue;
            }
            turned[beside as usize / 4] = Some(of_cell != alike(cells, 4 * cell + side, beside));
            known.push(beside / 4);
        }
    }
    let is_turned = |cell: u32| turned[cell as usize] == Some(true);
    for (cell, sides) in (0u32..).zip(across.iter()) {
        for (side, beside) in (0u32..).zip(sides).filter(|(_, beside)| **beside != NOTHING) {
            let sure = [cell, beside / 4].iter().all(|cell| volume(points, cells[*cell as usize]) != 0.0);
            let overlap = alike(cells, 4 * cell + side, *beside) == (is_turned(cell) == is_turned(beside / 4));
            if sure && overlap {
                let problem =
                    format!("has cells {cell} and {}, which lie on one side of the face they share", beside / 4);
                return Err(Error::input(name, problem, "leave one of them out, or repair the mesh"));
            }
        }
    }
    // Two corners of each change their places, and with them the sides opposite to them.
    let exchanged = |side: u32| match (is_turned(side / 4), side % 4) {
        (true, 2) => side + 1,
        (true, 3) => side - 1,
        _ => side,
    };
    across.iter_mut().flatten().filter(|side| **side != NOTHING).for_each(|side| *side = exchanged(*side));
    for cell in (0..cells.len() as u32).filter(|cell| is_turned(*cell)) {
        cells[cell as usize].swap(2, 3);
        across[cell as usize].swap(2, 3);
    }
    Ok(())
}

/// Whether two sides that share a face go round it the same way.
fn alike(cells: &[[u32; 4]], a: u32, b: u32) -> bool {
    let corners = |side: u32| FACES[side as usize % 4].map(|corner| cells[side as usize / 4][corner]);
    let (a, b) = (corners(a), corners(b));
    let at = b.iter().position(|corner| *corner == a[0]).unwrap_or(0);
    b[(at + 1) % 3] == a[1]
}
