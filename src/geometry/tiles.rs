//! The volume's box in tiles of pixels behind which something may show: what its faces cover there is decided as ever.

use super::volume_box::{BOX_BACK, BOX_FRONT};
use crate::part::geometry::{Geometry, Hits, Sample};
use crate::scene::Scene;
use crate::scene::view::View;

/// What rays begin by: the front faces of the box, in live tiles where others are left out.
pub fn ray_begins(view: &View) -> &'static Geometry {
    if view.tiles.is_some() { &FRONT_IN_TILES } else { &BOX_FRONT }
}

/// What rays end by: the back faces in the same way.
pub fn ray_ends(view: &View) -> &'static Geometry {
    if view.tiles.is_some() { &BACK_IN_TILES } else { &BOX_BACK }
}

/// The front faces in live tiles alone.
pub static FRONT_IN_TILES: Geometry =
    in_tiles("front faces in live tiles", &BOX_FRONT, |scene, view, sample| hits(&BOX_FRONT, scene, view, sample));

/// The back faces in live tiles alone.
pub static BACK_IN_TILES: Geometry =
    in_tiles("back faces in live tiles", &BOX_BACK, |scene, view, sample| hits(&BOX_BACK, scene, view, sample));

const fn in_tiles(name: &'static str, faces: &Geometry, hits: fn(&Scene, &View, Sample) -> Hits) -> Geometry {
    Geometry {
        name,
        vertex: faces.vertex,
        vertices: faces.vertices,
        corner: faces.corner,
        range: faces.range,
        within_box: true,
        front_only: false,
        numbers: faces.numbers,
        parts: |view| view.tiles.as_ref().map(|tiles| tiles.live()),
        hits,
    }
}

fn hits(faces: &Geometry, scene: &Scene, view: &View, sample: Sample) -> Hits {
    match view.tiles.as_ref().is_some_and(|tiles| tiles.contains(sample.pixel)) {
        true => (faces.hits)(scene, view, sample),
        false => Hits { fragments: 0, undecided: false },
    }
}
