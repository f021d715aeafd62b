//! Which cells are interesting: a bit for each, from the volume or from the ranges of larger cells.

use super::{dispatch, slice, words_of_bits};
use crate::pass::Step;
use crate::pass::resource::Resource;
use crate::structure::grid::Grid;

/// `holes`: the volume has cells that stay transparent. Larger cells do not look at them.
pub fn interesting(grid: &Grid, holes: bool) -> Step {
    let (shader, mut reads) = match (grid.cell, holes) {
        (1, false) => ("structure/interesting.comp:voxels", vec![("volume", Resource::Volume)]),
        (1, true) => {
            let reads = vec![("volume", Resource::Volume), ("holes", Resource::Holes)];
            ("structure/interesting.comp:voxels+holes", reads)
        }
        _ => ("structure/interesting.comp:ranges", vec![("cell_range", Resource::CellRange)]),
    };
    reads.push(("support", Resource::Support));
    let writes = [("interesting", Resource::Interesting)];
    let count = words_of_bits(grid);
    dispatch("interesting".to_owned(), shader, &reads, &writes, slice(grid, count), 32)
}
