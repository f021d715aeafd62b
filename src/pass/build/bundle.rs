//! Distances along bundles of rays: `optimal` and `cone` [Thesis §5.3.1, §5.7].

use super::{dispatch, slice, unpack, words_of_bits, words_of_bytes};
use crate::pass::Step;
use crate::pass::resource::Resource;
use crate::structure::grid::Grid;

/// Interesting cells among 2^3 and 4^3, from each cell on. Depends on volume and transfer function.
pub fn widen(grid: &Grid) -> Vec<Step> {
    let widen = |from, to: Resource, by: u32| {
        let mut slice = slice(grid, words_of_bits(grid));
        slice.reach = by;
        let (reads, writes) = ([("narrow", from)], [("wide", to)]);
        dispatch(to.name().to_owned(), "structure/widen.comp", &reads, &writes, slice, 32)
    };
    vec![widen(Resource::Interesting, Resource::Wide2, 1), widen(Resource::Wide2, Resource::Wide4, 2)]
}

/// For the rays of a view, given by the uniform buffer `bundle`.
pub fn bundle(grid: &Grid) -> Vec<Step> {
    let reads = [
        ("bundle", Resource::Bundle),
        ("omni_distance", Resource::OmniDistance),
        ("wide_2", Resource::Wide2),
        ("wide_4", Resource::Wide4),
    ];
    let writes = [("distance_bytes", Resource::DistanceBytes)];
    let slice = slice(grid, words_of_bytes(grid));
    // Some dozen steps along a ray for each of four cells.
    let step = dispatch("bundle".to_owned(), "structure/bundle.comp", &reads, &writes, slice, 64);
    vec![step, unpack(Resource::NearestDistance)]
}
