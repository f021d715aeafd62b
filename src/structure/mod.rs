//! Structures that tell where a volume holds nothing to see.

pub mod blocks;
pub mod cells;
pub mod distance;

use crate::scene::{Field, TransferFunction};
use distance::DistanceField;

/// The structure of `nn-omni`: distance from every cell to the nearest interesting one [Thesis §5.3.1].
pub fn omni(field: &Field, transfer: &TransferFunction) -> DistanceField {
    let interesting = cells::interesting(field, transfer);
    distance::omni(field.cells(), distance::cell_sides(field), &interesting)
}
