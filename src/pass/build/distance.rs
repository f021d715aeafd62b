//! Exact Euclidean distance transforms, axis by axis [Thesis §5.3.1]: in any direction, or for each octant.

use super::{dispatch, slice, unpack};
use crate::glsl::Shader;
use crate::part::resource::Resource;
use crate::part::{Step, Work};
use crate::resource;
use crate::resource::{words_of_bits, words_of_bytes};
use crate::shared::Slice;
use crate::structure::grid::Grid;
use crate::structure::square::{reach, weight};

/// The define of scans for octants, in shaders of one axis.
const ONE_SIDED: Option<&str> = Some("ONE_SIDED");

/// `omni`: from the interesting cells to the texture `to`.
pub fn omni(grid: &Grid, to: Resource) -> Vec<Step> {
    // Each column is read before it is written, so one buffer does.
    let squares = resource::SQUARES;
    vec![
        first_axis(grid, "distance_x".to_owned(), None, squares, 0),
        scan(grid, "distance_y".to_owned(), None, 1, [squares, squares], 0),
        scan(grid, "distance_z".to_owned(), None, 2, [squares, squares], 0),
        dispatch(
            "distance_pack".to_owned(),
            Shader::new("structure/distance_pack.comp", []),
            &[("interesting", resource::INTERESTING), ("squares", squares)],
            &[("distance_bytes", resource::DISTANCE_BYTES)],
            slice(grid, words_of_bytes(grid.cells)),
            4,
        ),
        unpack(resource::DISTANCE_BYTES, to),
    ]
}

/// `directional`: the octants share the scans along x and y where they go the same way.
pub fn directional(grid: &Grid) -> Vec<Step> {
    let mut steps = Vec::new();
    let name = |axis: &str, octant: usize| format!("distance_{axis}.{octant}");
    for x in 0..2 {
        steps.push(first_axis(grid, name("x", x), ONE_SIDED, resource::SQUARES, x));
        for xy in [x, x | 2] {
            let through = [resource::SQUARES, resource::SQUARES_AFTER];
            steps.push(scan(grid, name("y", xy), ONE_SIDED, 1, through, xy));
            for octant in [xy, xy | 4] {
                let through = [resource::SQUARES_AFTER, resource::DISTANCE_BYTES];
                steps.push(scan(grid, name("z", octant), Some("OCTANT"), 2, through, octant));
            }
        }
    }
    steps.push(unpack(resource::DISTANCE_BYTES, resource::NEAREST_DISTANCE));
    steps
}

fn along(grid: &Grid, axis: usize, count: usize, octant: usize) -> Slice {
    let weight = weight(grid.sides[axis]);
    Slice { weight, reach: reach(weight), octant: octant as u32, ..slice(grid, count) }
}

fn first_axis(grid: &Grid, name: String, define: Option<&'static str>, squares: Resource, octant: usize) -> Step {
    dispatch(
        name,
        Shader::new("structure/distance_x.comp", define),
        &[("interesting", resource::INTERESTING)],
        &[("squares", squares)],
        along(grid, 0, words_of_bits(grid), octant),
        32,
    )
}

/// Along axis 1 or 2, from the first of `through` to the second.
fn scan(
    grid: &Grid,
    name: String,
    define: Option<&'static str>,
    axis: usize,
    through: [Resource; 2],
    octant: usize,
) -> Step {
    let [nx, ny, nz] = grid.cells;
    let (columns, inner, outer, stride) =
        if axis == 1 { (nx * nz, nx, nx * ny, nx) } else { (nx * ny, nx * ny, 0, nx * ny) };
    let slice =
        Slice { inner: inner as u32, outer: outer as u32, stride: stride as u32, ..along(grid, axis, columns, octant) };
    let [from, to] = through;
    let (mut reads, mut writes) = (vec![("squares", from)], "squares_after");
    if to == resource::DISTANCE_BYTES {
        reads.push(("interesting", resource::INTERESTING));
        writes = "distance_bytes";
    }
    let shader = Shader::new("structure/distance_scan.comp", define);
    let mut step = dispatch(name, shader, &reads, &[(writes, to)], slice, grid.cells[axis]);
    if let Work::Dispatch(dispatch) = &mut step.work {
        dispatch.constants = vec![("LENGTH", grid.cells[axis] as u32), ("AXIS", axis as u32)];
    }
    step
}
