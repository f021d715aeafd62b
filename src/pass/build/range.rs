//! Value range of every cell of a grid; with a side of 8, of the blocks of [KW03 §2.3]. Depends on the volume alone.

use super::{dispatch, slice};
use crate::glsl::Shader;
use crate::part::Step;
use crate::resource;
use crate::structure::grid::Grid;

pub fn cell_range(grid: &Grid) -> Step {
    dispatch(
        "cell_range".to_owned(),
        Shader::new("structure/cell_range.comp", []),
        &[("volume", resource::VOLUME)],
        &[("cell_range", resource::CELL_RANGE.at(grid.cell as u16))],
        slice(grid, grid.count()),
        (grid.cell + 1).pow(3),
    )
}
