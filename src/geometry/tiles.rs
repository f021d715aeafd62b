//! The volume's box in tiles of pixels behind which something may show: what its faces cover there is decided as ever.

use super::volume_box::{BOX_BACK, BOX_FRONT};
use crate::part::geometry::Geometry;
use crate::scene::region::Region;
use crate::scene::view::View;

/// What rays begin by: the front faces of the box, in live tiles where others are left out.
pub fn ray_begins(view: &View) -> &'static Geometry {
    if view.tiles.is_some() { &FRONT_IN_TILES } else { &BOX_FRONT }
}

/// What a main pass draws, or what decides about it: the same, in the tiles that are live in this pass.
pub fn segment_begins(view: &View) -> &'static Geometry {
    if view.tiles.is_some() { &FRONT_OF_PASS } else { &BOX_FRONT }
}

/// What rays go on by: the same, in the tiles that are live in this main pass or in a later one.
pub fn rest_begins(view: &View) -> &'static Geometry {
    if view.tiles.is_some() { &FRONT_FROM_PASS } else { &BOX_FRONT }
}

/// What rays end by: the back faces, in live tiles where others are left out.
pub fn ray_ends(view: &View) -> &'static Geometry {
    if view.tiles.is_some() { &BACK_IN_TILES } else { &BOX_BACK }
}

/// The front faces in live tiles alone.
pub static FRONT_IN_TILES: Geometry = Geometry {
    name: "front faces in live tiles",
    parts: |view, _| view.tiles.as_ref().map(|tiles| tiles.live()),
    ..BOX_FRONT
};

/// The front faces in tiles that are live in the main pass.
pub static FRONT_OF_PASS: Geometry = Geometry { name: "front faces in tiles of the pass", parts: of_pass, ..BOX_FRONT };

/// The front faces in tiles that are live in the main pass or in a later one.
pub static FRONT_FROM_PASS: Geometry = Geometry {
    name: "front faces in tiles from the pass on",
    parts: |view, pass| view.tiles.as_ref().map(|tiles| tiles.live_from(pass)),
    ..BOX_FRONT
};

/// The back faces in live tiles alone.
pub static BACK_IN_TILES: Geometry = Geometry {
    name: "back faces in live tiles",
    parts: |view, _| view.tiles.as_ref().map(|tiles| tiles.live()),
    ..BOX_BACK
};

/// The tiles that are live in a main pass; none where all are drawn.
pub fn of_pass(view: &View, pass: u32) -> Option<&[Region]> {
    view.tiles.as_ref().map(|tiles| tiles.live_in(pass))
}
