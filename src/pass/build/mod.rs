//! Compute steps that build structures: which cells are interesting, and how far it is to the nearest of them.
//!
//! They are run before frames, once for what they depend on: the volume, the transfer function, the view. Each step is
//! cut into slices, so that a large volume takes many short dispatches.

mod bundle;
mod distance;
mod interesting;
mod range;

pub use bundle::{bundle, widen};
pub use distance::{directional, omni};
use interesting::interesting;
pub use range::cell_range;

use std::sync::Arc;

use crate::glsl::Shader;
use crate::part::resource::{Access, Resource, Usage};
use crate::part::{Dispatch, Group, Step, Work};
use crate::scene::Field;
use crate::scene::settings::Distance;
use crate::shared::Slice;
use crate::structure::Lookup;
use crate::structure::grid::Grid;

/// Every step from the volume to the distances.
pub fn steps(field: &Field, lookup: &Lookup) -> Vec<Step> {
    let grid = Grid::new(field, lookup.cell);
    let mut steps = Vec::new();
    steps.extend(cells(&grid, field, lookup));
    match lookup.distance {
        Distance::Omni => steps.extend(omni(&grid, Resource::NearestDistance)),
        Distance::Directional => steps.extend(directional(&grid)),
        Distance::Optimal | Distance::Cone => {
            steps.extend(omni(&grid, Resource::OmniDistance));
            steps.extend(widen(&grid));
            steps.extend(bundle(&grid));
        }
    }
    steps
}

/// The steps from the volume to which cells are interesting.
pub fn cells(grid: &Grid, field: &Field, lookup: &Lookup) -> Vec<Step> {
    let ranges = lookup.reads_ranges().then(|| cell_range(grid));
    ranges.into_iter().chain([interesting(grid, field.holes.is_some(), lookup)]).collect()
}

/// What a step of `count` invocations knows of the grid.
fn slice(grid: &Grid, count: usize) -> Slice {
    let [cells_x, cells_y, cells_z] = grid.cells.map(|n| n as u32);
    Slice { end: count as u32, cells_x, cells_y, cells_z, cell: grid.cell as u32, ..Slice::default() }
}

/// Words of a row of the grid that have a bit a cell, and all rows together.
fn words_of_bits(grid: &Grid) -> usize {
    grid.cells[0].div_ceil(32) * grid.cells[1] * grid.cells[2]
}

/// Words of rows that have a byte a cell.
fn words_of_bytes([x, y, z]: [usize; 3]) -> usize {
    x.div_ceil(4) * y * z
}

/// Bytes a resource of a build takes; 0 for those that are not made for one.
pub fn bytes(grid: &Grid, octants: usize, resource: Resource) -> u64 {
    let bytes = match resource {
        Resource::CellRange => 8 * grid.count(),
        Resource::Interesting | Resource::Wide2 | Resource::Wide4 => 4 * words_of_bits(grid),
        Resource::Squares | Resource::SquaresAfter => 4 * grid.count(),
        Resource::DistanceBytes if octants > 1 => octants * grid.count(),
        Resource::DistanceBytes => 4 * words_of_bytes(grid.cells),
        Resource::Boxes2 => 4 * words_of_bytes(grid.cells.map(|n| n.div_ceil(2))),
        Resource::Boxes4 => 4 * words_of_bytes(grid.cells.map(|n| n.div_ceil(4))),
        _ => 0,
    };
    bytes as u64
}

/// A dispatch that reads and writes these, bound under their own names or those given.
fn dispatch(
    name: String,
    shader: Shader,
    reads: &[(&'static str, Resource)],
    writes: &[(&'static str, Resource)],
    slice: Slice,
    cells: usize,
) -> Step {
    let used = |usage: Usage| move |(_, resource): &(&str, Resource)| usage.of(*resource);
    let mut accesses: Vec<Access> = reads.iter().map(used(Usage::ComputeRead)).collect();
    accesses.extend(writes.iter().map(used(Usage::ComputeWrite)));
    let work = Work::Dispatch(Dispatch {
        shader: Arc::new(shader),
        constants: Vec::new(),
        bound: [reads, writes].concat(),
        slice,
        cells: cells as u32,
    });
    Step { name, group: Group::Structure, pass: 0, accesses: accesses.into(), work }
}

/// Distances as packed, to the texture `to`.
fn unpack(to: Resource) -> Step {
    Step {
        name: to.name().to_owned(),
        group: Group::Structure,
        pass: 0,
        accesses: vec![Usage::CopySource.of(Resource::DistanceBytes), Usage::CopyTarget.of(to)].into(),
        work: Work::Unpack { from: Resource::DistanceBytes, to },
    }
}
