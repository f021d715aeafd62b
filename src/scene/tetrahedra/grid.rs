//! Cells as a file has them, before they are a mesh.

use std::collections::HashMap;

use glam::DVec3;

use crate::error::{Error, Result};
use crate::scene::volume::{Volume, Voxels};

/// Points with a value each, and the tetrahedra between them.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    /// The file's path or `builtin:NAME:SIZE`, as the user gave it.
    pub name: String,
    pub points: Vec<[f64; 3]>,
    pub values: Vec<f64>,
    /// Corners of each cell.
    pub cells: Vec<[u32; 4]>,
    /// What reading did with the file that its user may want to know: one sentence each.
    pub notes: Vec<String>,
}

impl Grid {
    /// The values as voxels in a row, for what asks for their range.
    ///
    /// # Errors
    /// When there are none.
    pub fn as_volume(&self) -> Result<Volume> {
        let mut volume =
            Volume::new(&self.name, [self.values.len(), 1, 1], [1.0; 3], Voxels::F64(self.values.clone()))?;
        volume.notes.clone_from(&self.notes);
        Ok(volume)
    }

    /// Makes one of points that lie at one place and have one value; leaves out cells that have less than four corners then, cells that
    /// come twice, and points of no cell. What was done is told in notes.
    ///
    /// # Errors
    /// When a point is not finite, or nothing is left.
    pub fn cleaned(mut self) -> Result<Self> {
        let finite = |point: &[f64; 3]| point.iter().all(|c| c.is_finite());
        if let Some(bad) = self.points.iter().position(|point| !finite(point)) {
            let problem = format!("has the point {bad} at {:?}", self.points[bad]);
            return Err(Error::input(&self.name, problem, "give finite coordinates"));
        }
        self.merge();
        let before = self.cells.len();
        self.cells.retain(|cell| (1..4).all(|i| !cell[..i].contains(&cell[i])));
        let no_volume = before - self.cells.len();
        if no_volume > 0 {
            self.notes.push(format!("{no_volume} cells with two corners at one place were left out"));
        }
        let mut seen = std::collections::HashSet::with_capacity(self.cells.len());
        let before = self.cells.len();
        self.cells.retain(|cell| {
            let mut key = *cell;
            key.sort_unstable();
            seen.insert(key)
        });
        let doubled = before - self.cells.len();
        if doubled > 0 {
            self.notes.push(format!("{doubled} cells that came twice were left out"));
        }
        self.used();
        if self.cells.is_empty() {
            return Err(Error::input(
                &self.name,
                "has no cells with a volume",
                "give tetrahedra, or cells that can be cut into them",
            ));
        }
        Ok(self)
    }

    /// Lets cells share points that are one.
    fn merge(&mut self) {
        let one = one_of_each(&self.points, Some(&self.values));
        let merged = (0u32..).zip(&one).filter(|(number, one)| number != *one).count();
        if merged > 0 {
            self.cells.iter_mut().flatten().for_each(|corner| *corner = one[*corner as usize]);
            self.notes
                .push(format!("{merged} points that lie where another of the same value does were taken for that one"));
        }
    }

    /// Leaves out points that no cell has, without a word: they were merged, or nobody sees them.
    fn used(&mut self) {
        let mut is_used = vec![false; self.points.len()];
        self.cells.iter().flatten().for_each(|corner| is_used[*corner as usize] = true);
        let mut next = 0;
        let number: Vec<u32> = is_used
            .iter()
            .map(|used| {
                let number = next;
                next += u32::from(*used);
                number
            })
            .collect();
        self.cells.iter_mut().flatten().for_each(|corner| *corner = number[*corner as usize]);
        let mut used = is_used.iter();
        self.points.retain(|_| used.next() == Some(&true));
        let mut used = is_used.iter();
        self.values.retain(|_| used.next() == Some(&true));
    }

    /// Leaves out cells that have a corner without a value, as its number says, with a note.
    pub fn without(mut self, is_missing: impl Fn(usize) -> bool) -> Self {
        let before = self.cells.len();
        self.cells.retain(|cell| !cell.iter().any(|corner| is_missing(*corner as usize)));
        let left_out = before - self.cells.len();
        if left_out > 0 {
            self.notes
                .push(format!("{left_out} cells with a point that has no finite value, or no data, were left out"));
        }
        self
    }

    /// The points in volume space, and the sides of the box around them.
    ///
    /// # Errors
    /// When the box has no size that arithmetic survives.
    pub(super) fn in_volume_space(&self) -> Result<(Vec<[f32; 3]>, DVec3)> {
        let corners = self.cells.iter().flatten().map(|corner| DVec3::from_array(self.points[*corner as usize]));
        let (least, greatest) = corners.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(least, greatest), point| {
            (least.min(point), greatest.max(point))
        });
        let sides = greatest - least;
        let longest = sides.max_element();
        if !(LONGEST.contains(&longest) && sides.min_element() > 0.0) {
            let problem = format!("lies in a box with the sides {sides}");
            let remedy = format!(
                "give points whose longest side is from {:e} to {:e}, and none 0",
                LONGEST.start(),
                LONGEST.end()
            );
            return Err(Error::input(&self.name, problem, remedy));
        }
        let middle = least + 0.5 * sides;
        let placed = |point: &[f64; 3]| ((DVec3::from_array(*point) - middle) / longest).as_vec3().to_array();
        Ok((self.points.iter().map(placed).collect(), sides / longest))
    }

    /// # Errors
    /// When lengths have no unit, since cells have no volume.
    pub(super) fn check_unit(&self, unit: f64) -> Result<()> {
        if unit > LEAST_UNIT {
            return Ok(());
        }
        Err(Error::input(&self.name, "has no volume in its cells", "give cells whose corners do not lie in one plane"))
    }
}

/// For each point the first that lies at the same place, of the same value where values are given.
pub fn one_of_each(points: &[[f64; 3]], values: Option<&Vec<f64>>) -> Vec<u32> {
    let mut first: HashMap<[u64; 4], u32> = HashMap::with_capacity(points.len());
    let one = |(number, [x, y, z]): (usize, &[f64; 3])| {
        let value = values.and_then(|values| values.get(number)).copied().unwrap_or_default();
        // The two zeros are one place.
        let key = [*x + 0.0, *y + 0.0, *z + 0.0, value].map(f64::to_bits);
        *first.entry(key).or_insert(number as u32)
    };
    points.iter().enumerate().map(one).collect()
}

/// Longest sides that arithmetic survives.
const LONGEST: std::ops::RangeInclusive<f64> = 1e-30..=1e30;

/// The least unit of lengths, in volume space: that of single precision.
const LEAST_UNIT: f64 = 1e-7;
