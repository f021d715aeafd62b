//! The volume's box in tiles of pixels behind which something may show.

use super::volume_box::BOX_FRONT;
use crate::part::geometry::{Geometry, Hits};

/// The front faces of the box, in no other tiles: what they cover there is decided as ever.
pub static LIVE_TILES: Geometry = Geometry {
    name: "front faces in live tiles",
    vertex: BOX_FRONT.vertex,
    vertices: BOX_FRONT.vertices,
    corner: BOX_FRONT.corner,
    range: BOX_FRONT.range,
    within_box: true,
    numbers: BOX_FRONT.numbers,
    parts: |view| view.tiles.as_ref().map(|tiles| tiles.live()),
    hits: |scene, view, sample| match view.tiles.as_ref().is_some_and(|tiles| tiles.contains(sample.pixel)) {
        true => (BOX_FRONT.hits)(scene, view, sample),
        false => Hits { fragments: 0, undecided: false },
    },
};
