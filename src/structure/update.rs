//! Distances that follow a transfer function: a change that leaves the interesting cells as they are costs nothing, and another
//! one what it reaches.

use super::Lookup;
use super::cells::{Support, Values, interesting_where};
use super::changes::changed;
use super::ends::Ends;
use super::grid::{DistanceField, Grid};
use super::transform::Transform;
use crate::projection::Shown;
use crate::scene::Field;
use crate::scene::settings::Distance;

/// The distances of an `nn-*` method that no view has a part in, with what it takes to update them: 7 bytes a cell for rays in
/// any direction, 29 for octants, besides the distances themselves; 13 and 57 where cells are no cubes; and one more where voxels
/// are codes of 8 bits.
pub struct Updatable {
    transform: Transform,
    lookup: Lookup,
    support: Support,
    /// Of codes of 8 bits that are judged by ranges.
    ends: Option<Ends>,
}

impl Updatable {
    /// As [`super::build`]; none for distances that are made for a view.
    pub fn new(field: &Field, values: &Values, shown: &Shown, lookup: &Lookup) -> Option<Self> {
        let octants = match lookup.distance {
            Distance::Omni => false,
            Distance::Directional => true,
            Distance::Optimal | Distance::Cone => return None,
        };
        let (grid, support) = (Grid::new(field, lookup.cell), Support::of(shown));
        let interesting = interesting_where(field, values, &support, &grid, lookup.nearest);
        let ends = match values {
            Values::Unorm8(codes) if grid.cell == 1 && !lookup.nearest => Some(Ends::new(field, codes)),
            _ => None,
        };
        Some(Self { transform: Transform::new(&grid, octants, interesting), lookup: *lookup, support, ends })
    }

    /// What the distances are looked up by.
    pub fn lookup(&self) -> &Lookup {
        &self.lookup
    }

    pub fn distances(&self) -> &DistanceField {
        self.transform.distances()
    }

    /// Makes the distances those of what is shown now. `field` and `values` are those that the distances were built for.
    pub fn update(&mut self, field: &Field, values: &Values, shown: &Shown) {
        let support = Support::of(shown);
        let (grid, flags) = (&self.transform.distances().grid, self.transform.interesting());
        let cells =
            changed(field, values, [&self.support, &support], grid, self.lookup.nearest, flags, self.ends.as_ref());
        self.transform.flip(&cells);
        self.support = support;
    }
}
