//! Tiles of pixels behind which something may show.

use ash::vk;

use crate::part::geometry::{Geometry, Hits};
use crate::resource;

/// Squares of 8 x 8 pixels, which end where the picture does: all rays are begun there.
pub static LIVE_TILES: Geometry = Geometry {
    name: "live tiles",
    vertex: "box.vert",
    vertices: resource::LIVE_TILES,
    corner: vk::Format::R32G32B32_SFLOAT,
    range: |_, view, _| 0..view.tiles.as_ref().map_or(0, |tiles| tiles.corners.len() as u32),
    numbers: |_, _| None,
    hits: |_, view, sample| {
        let live = view.tiles.as_ref().is_some_and(|tiles| tiles.contains(sample.pixel));
        Hits { fragments: live.into(), undecided: false }
    },
};
