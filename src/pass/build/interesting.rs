//! Which cells are interesting: a bit for each, from the volume or from the ranges of larger cells.

use super::{dispatch, slice};
use crate::glsl::Shader;
use crate::part::Step;
use crate::resource;
use crate::resource::words_of_bits;
use crate::structure::Lookup;
use crate::structure::grid::Grid;

/// `holes`: the volume has cells that stay transparent. Larger cells do not look at them. With a nearest filter samples have the value
/// of the nearest voxel, and every voxel of a cell is looked at by itself.
pub fn interesting(grid: &Grid, holes: bool, lookup: &Lookup) -> Step {
    let nearest = lookup.nearest;
    let holes = holes && grid.cell == 1;
    let mut shader = Shader::new("structure/interesting.comp", []);
    shader.defines.extend(nearest.then_some("NEAREST"));
    shader.defines.extend(holes.then_some("HOLES"));
    let mut reads = match lookup.reads_ranges() {
        true => {
            shader.defines.insert("RANGES");
            vec![("cell_range", resource::CELL_RANGE.at(grid.cell as u16))]
        }
        false => vec![("volume", resource::VOLUME)],
    };
    reads.extend(holes.then_some(("holes", resource::HOLES)));
    reads.push(("support", resource::SUPPORT));
    let writes = [("interesting", resource::INTERESTING)];
    let count = words_of_bits(grid);
    let voxels = if nearest { (grid.cell + 1).pow(3) } else { 1 };
    dispatch("interesting".to_owned(), shader, &reads, &writes, slice(grid, count), 32 * voxels)
}
