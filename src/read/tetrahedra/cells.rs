//! Points, cells of all kinds and values, before they are tetrahedra.

use std::path::Path;

use super::arrays::{Array, At, pick};
use crate::error::{Error, Result};
use crate::scene::settings::Component;
use crate::scene::tetrahedra::cut::{CellKind, Cutter, HEXAHEDRON, PYRAMID, TETRAHEDRON, VOXEL, WEDGE};
use crate::scene::tetrahedra::{Grid, MOST_CELLS, one_of_each};

/// The kinds of cells with a volume that can be cut, by their numbers in VTK.
static KINDS: [(i64, &CellKind); 5] =
    [(10, &TETRAHEDRON), (11, &VOXEL), (12, &HEXAHEDRON), (13, &WEDGE), (14, &PYRAMID)];

/// Kinds up to this one that are not among [`KINDS`] have no volume: points, lines and polygons.
const LAST_FLAT: i64 = 9;

/// The least kind that has a volume.
const FIRST_SOLID: i64 = 10;

/// What a file holds.
#[derive(Debug, Default)]
pub struct CellData {
    /// Coordinates, three for each point.
    pub points: Vec<f64>,
    pub cells: Cells,
    pub arrays: Vec<Array>,
    pub notes: Vec<String>,
}

/// Which points are the corners of cells.
#[derive(Debug)]
pub enum Cells {
    /// Points stand in rows, so many along each axis, the first fastest; between eight of them is a hexahedron.
    Structured([usize; 3]),
    /// Of each cell the kind, and where its corners end in their list.
    Listed { kinds: Vec<i64>, ends: Vec<usize>, corners: Vec<u32> },
}

impl Default for Cells {
    fn default() -> Self {
        Self::Listed { kinds: Vec::new(), ends: Vec::new(), corners: Vec::new() }
    }
}

impl CellData {
    /// The cells cut into tetrahedra, with the values of one array.
    ///
    /// # Errors
    /// When there is no such array, or cells cannot be cut.
    pub fn grid(self, path: &Path, array: Option<&str>, component: Option<Component>) -> Result<Grid> {
        let name = path.display().to_string();
        let count = self.points.len() / 3;
        let array = pick(path, &self.arrays, array)?;
        let values = array.scalars(component)?;
        let mut notes = self.notes.clone();
        if self.arrays.len() > 1 {
            let others = self.arrays.iter().map(|other| other.name.as_str()).filter(|other| *other != array.name);
            let others = others.collect::<Vec<_>>().join(", ");
            notes.push(format!("of several arrays of values {} is shown; the others are {others}", array.name));
        }
        let cells = self.cells.count();
        let (expected, of) = if array.at == At::Points { (count, "points") } else { (cells, "cells") };
        check_count(path, &array.name, values.len(), expected, of)?;
        let points: Vec<[f64; 3]> = self.points.chunks_exact(3).map(|p| [p[0], p[1], p[2]]).collect();
        // Cells that meet at points which stand there more than once meet all the same.
        let one = one_of_each(&points, (array.at == At::Points).then_some(&values));
        let values = match array.at {
            At::Points => values,
            At::Cells => {
                notes.push(format!("{} has values at cells; each point has the mean of those around it", array.name));
                self.cells.at_points(&one, &values)
            }
        };
        let mut cutter = Cutter::new(&name);
        self.cells.cut(path, &one, &mut cutter, &mut notes)?;
        let cells = cutter.cells;
        Ok(Grid { name, points, values, cells, notes })
    }
}

/// How many points stand in rows of these lengths, so that there are cells between them, and not too many; else what is wrong.
pub fn points_in_rows(dims: [usize; 3]) -> std::result::Result<usize, String> {
    let product = |sides: [usize; 3]| sides.iter().try_fold(1usize, |n, side| n.checked_mul(*side));
    let boxes = product(dims.map(|side| side.saturating_sub(1)));
    match (product(dims), boxes) {
        (_, Some(0)) => Err("between which there are no cells with a volume".to_owned()),
        (Some(points), Some(boxes)) if boxes <= MOST_CELLS / 6 => Ok(points),
        _ => Err(format!("and at most {MOST_CELLS} tetrahedra are possible, six a box")),
    }
}

fn check_count(path: &Path, array: &str, values: usize, expected: usize, of: &str) -> Result<()> {
    if values == expected {
        return Ok(());
    }
    let problem = format!("has {values} values in the array `{array}` for {expected} {of}");
    Err(Error::input(path.display(), problem, "correct the file"))
}

impl Cells {
    fn count(&self) -> usize {
        match self {
            Self::Listed { ends, .. } => ends.len(),
            Self::Structured(dims) => dims.iter().map(|side| side.saturating_sub(1)).product(),
        }
    }

    /// The mean of the values of the cells around each point, where `one` is the point that each is taken for; NaN where there are none.
    fn at_points(&self, one: &[u32], values: &[f64]) -> Vec<f64> {
        let mut sums = vec![(0.0, 0u32); one.len()];
        let added: std::result::Result<(), ()> = self.each(|cell, corners| {
            for corner in corners {
                let point = one.get(*corner as usize).map(|point| *point as usize);
                if let (Some(point), Some(value)) = (point, values.get(cell)) {
                    sums[point] = (sums[point].0 + value, sums[point].1 + 1);
                }
            }
            Ok(())
        });
        // Nothing can fail.
        let _ = added;
        sums.into_iter().map(|(sum, count)| sum / f64::from(count)).collect()
    }

    /// Goes through cells, their numbers and corners, up to the first that fails.
    fn each<E>(&self, mut see: impl FnMut(usize, &[u32]) -> std::result::Result<(), E>) -> std::result::Result<(), E> {
        match self {
            Self::Listed { ends, corners, .. } => {
                let mut from = 0;
                for (cell, end) in ends.iter().enumerate() {
                    see(cell, &corners[from..*end])?;
                    from = *end;
                }
            }
            Self::Structured(dims) => {
                let [x, y, _] = dims.map(|n| n.saturating_sub(1));
                for cell in 0..self.count() {
                    see(cell, &box_corners(*dims, [cell % x, cell / x % y, cell / (x * y)]))?;
                }
            }
        }
        Ok(())
    }

    /// Cuts all cells, whose corners are taken for those that `one` has; those without a volume are left out, with a note.
    fn cut(&self, path: &Path, one: &[u32], cutter: &mut Cutter, notes: &mut Vec<String>) -> Result<()> {
        let mut flat = 0;
        self.each(|cell, corners| {
            let (kind, corners) = match self {
                Self::Structured(_) => (&HEXAHEDRON, corners),
                Self::Listed { kinds, .. } => match kind_of(path, one.len(), (cell, kinds[cell]), corners)? {
                    Some(kind) => (kind, corners),
                    None => {
                        flat += 1;
                        return Ok(());
                    }
                },
            };
            let taken: Vec<u32> = corners.iter().map(|corner| one[*corner as usize]).collect();
            cutter.add(kind, &taken)
        })?;
        if flat > 0 {
            notes.push(format!("{flat} cells without a volume (points, lines, polygons) were left out"));
        }
        Ok(())
    }
}

/// The corners of a box between points in rows.
fn box_corners([nx, ny, _]: [usize; 3], [x, y, z]: [usize; 3]) -> [u32; 8] {
    const RING: [[usize; 2]; 4] = [[0, 0], [1, 0], [1, 1], [0, 1]];
    std::array::from_fn(|corner| {
        let ([i, j], k) = (RING[corner % 4], corner / 4);
        (((z + k) * ny + y + j) * nx + x + i) as u32
    })
}

/// What a cell is; none where it has no volume.
fn kind_of(
    path: &Path,
    points: usize,
    (cell, kind): (usize, i64),
    corners: &[u32],
) -> Result<Option<&'static CellKind>> {
    if (0..=LAST_FLAT).contains(&kind) {
        return Ok(None);
    }
    let bad = |problem: String, remedy: &str| Err(Error::input(path.display(), problem, remedy));
    let Some((_, found)) = KINDS.iter().find(|(number, _)| *number == kind) else {
        let names: Vec<String> = KINDS.iter().map(|(number, kind)| format!("{} ({number})", kind.name)).collect();
        let problem = match kind {
            FIRST_SOLID.. => {
                format!("has the cell {cell} of the kind {kind}, which is not linear or has no fixed corners")
            }
            _ => format!("has the cell {cell} of the kind {kind}, which there is not"),
        };
        return bad(problem, &format!("give cells of the kinds {}", names.join(", ")));
    };
    if corners.len() != found.corners {
        let problem =
            format!("has the cell {cell} with {} corners, and a {} has {}", corners.len(), found.name, found.corners);
        return bad(problem, "correct the cell");
    }
    if let Some(corner) = corners.iter().find(|corner| **corner as usize >= points) {
        let problem =
            format!("has the cell {cell} with the point {corner}, and there are {points} points, counted from 0");
        return bad(problem, "correct the cell");
    }
    Ok(Some(found))
}
