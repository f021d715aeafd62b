//! Distances that follow a transfer function: a change costs what it reaches.

use rayon::prelude::*;

use super::Lookup;
use super::cells::{self, Support, Values};
use super::grid::{DistanceField, Grid};
use super::transform::Transform;
use crate::projection::Shown;
use crate::scene::Field;
use crate::scene::settings::Distance;

/// The structure of an `nn-*` method that no view has a part in, with what it takes to update it.
pub struct Updatable {
    transform: Transform,
    support: Support,
    nearest: bool,
}

impl Updatable {
    /// As [`super::build`]; none for what is made for a view.
    pub fn new(field: &Field, values: &Values, shown: &Shown, lookup: &Lookup) -> Option<Self> {
        let octants = match lookup.distance {
            Distance::Omni => false,
            Distance::Directional => true,
            Distance::Optimal | Distance::Cone => return None,
        };
        let grid = Grid::new(field, lookup.cell);
        let interesting = cells::interesting(field, values, shown, &grid, lookup.nearest);
        let transform = Transform::new(&grid, octants, interesting);
        Some(Self { transform, support: Support::of(shown), nearest: lookup.nearest })
    }

    /// The distances.
    pub fn distances(&self) -> &DistanceField {
        self.transform.distances()
    }

    /// Makes the distances those of what is shown now, of the same field and values.
    pub fn update(&mut self, field: &Field, values: &Values, shown: &Shown) {
        let support = Support::of(shown);
        if support == self.support {
            return;
        }
        let grid = self.transform.distances().grid;
        let now = cells::interesting(field, values, shown, &grid, self.nearest);
        let [nx, ny, _] = grid.cells;
        let slabs = self.transform.interesting().par_chunks_exact(nx * ny).zip(now.par_chunks_exact(nx * ny));
        let changed = |(before, now): (&[bool], &[bool])| (0..nx * ny).filter(|i| before[*i] != now[*i]).collect();
        let changed: Vec<Vec<usize>> = slabs.map(changed).collect();
        self.transform.flip(&changed);
        self.support = support;
    }
}
