//! Distances along bundles of rays: `optimal` and `cone` [Thesis §5.3.1, §5.7].

use super::{dispatch, slice, unpack, words_of_bits, words_of_bytes};
use crate::glsl::Shader;
use crate::part::Step;
use crate::part::resource::Resource;
use crate::shared::Slice;
use crate::structure::bundle::SCALES;
use crate::structure::grid::Grid;

/// Interesting cells among 2^3 and 4^3, from each cell on. Depends on volume and transfer function.
pub fn widen(grid: &Grid) -> Vec<Step> {
    let widen = |from, to: Resource, by: u32| {
        let mut slice = slice(grid, words_of_bits(grid));
        slice.reach = by;
        let (reads, writes) = ([("narrow", from)], [("wide", to)]);
        dispatch(to.name().to_owned(), Shader::new("structure/widen.comp", []), &reads, &writes, slice, 32)
    };
    vec![widen(Resource::Interesting, Resource::Wide2, 1), widen(Resource::Wide2, Resource::Wide4, 2)]
}

/// For the rays of a view, given by the uniform buffer `bundle`: boxes of several cells first.
pub fn bundle(grid: &Grid) -> Vec<Step> {
    let mut steps = Vec::new();
    let mut larger = None;
    for (scale, to) in SCALES.into_iter().zip([Resource::Boxes4, Resource::Boxes2, Resource::DistanceBytes]) {
        let mut reads = vec![
            ("bundle", Resource::Bundle),
            ("omni_distance", Resource::OmniDistance),
            ("interesting", Resource::Interesting),
            ("wide_2", Resource::Wide2),
            ("wide_4", Resource::Wide4),
        ];
        reads.extend(larger.map(|larger| ("larger", larger)));
        let shader = Shader::new("structure/bundle.comp", larger.map(|_| "LARGER"));
        let boxes = grid.cells.map(|n| n.div_ceil(scale));
        let slice = Slice { cell: scale as u32, ..slice(grid, words_of_bytes(boxes)) };
        // Some dozen steps along a ray for each of four boxes.
        steps.push(dispatch(format!("bundle.{scale}"), shader, &reads, &[("distance_bytes", to)], slice, 64));
        larger = Some(to);
    }
    steps.push(unpack(Resource::NearestDistance));
    steps
}
