//! Distances along bundles of rays: `optimal` and `cone` [Thesis §5.3.1, §5.7].

use super::{dispatch, slice, unpack};
use crate::glsl::Shader;
use crate::part::Step;
use crate::part::resource::Resource;
use crate::resource;
use crate::resource::{words_of_bits, words_of_bytes};
use crate::shared::Slice;
use crate::structure::bundle::SCALES;
use crate::structure::grid::Grid;

/// Interesting cells among 2^3, from each cell on. Depends on volume and transfer function.
pub fn widen_2(grid: &Grid) -> Step {
    widen(grid, resource::INTERESTING, resource::WIDE_2, 1)
}

/// Interesting cells among 4^3, from each cell on.
pub fn widen_4(grid: &Grid) -> Step {
    widen(grid, resource::WIDE_2, resource::WIDE_4, 2)
}

fn widen(grid: &Grid, from: Resource, to: Resource, by: u32) -> Step {
    let slice = Slice { reach: by, ..slice(grid, words_of_bits(grid)) };
    let shader = Shader::new("structure/widen.comp", []);
    dispatch(to.name().to_owned(), shader, &[("narrow", from)], &[("wide", to)], slice, 32)
}

/// For the rays of a view, given by the uniform buffer `bundle`: boxes of several cells first. `parallel`: whether all of them have one
/// direction.
pub fn bundle(grid: &Grid, parallel: bool) -> Vec<Step> {
    let mut steps = Vec::new();
    let mut larger = None;
    for (scale, to) in SCALES.into_iter().zip([resource::BOXES_4, resource::BOXES_2, resource::DISTANCE_BYTES]) {
        let mut reads = vec![
            ("bundle", resource::BUNDLE),
            ("omni_distance", resource::OMNI_DISTANCE),
            ("interesting", resource::INTERESTING),
            ("wide_2", resource::WIDE_2),
            ("wide_4", resource::WIDE_4),
        ];
        reads.extend(larger.map(|larger| ("larger", larger)));
        let defines = [larger.map(|_| "LARGER"), parallel.then_some("PARALLEL")];
        let shader = Shader::new("structure/bundle.comp", defines.into_iter().flatten());
        let boxes = grid.cells.map(|n| n.div_ceil(scale));
        let slice = Slice { cell: scale as u32, ..slice(grid, words_of_bytes(boxes)) };
        // Some dozen steps along a ray for each of four boxes.
        steps.push(dispatch(format!("bundle.{scale}"), shader, &reads, &[("distance_bytes", to)], slice, 64));
        larger = Some(to);
    }
    steps.push(unpack(resource::DISTANCE_BYTES, resource::NEAREST_DISTANCE));
    steps
}
