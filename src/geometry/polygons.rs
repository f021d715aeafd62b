//! The polygons of a scene, wherever they are: they are not cut off at the volume's box.

use std::ops::Range;

use ash::vk;

use crate::part::geometry::{Geometry, Hits, Sample};
use crate::resource;
use crate::scene::Scene;
use crate::scene::view::View;

/// Those that divide rays, in the order of their numbers: transparent ones, and those of clip geometry.
pub static PEELED_POLYGONS: Geometry = Geometry {
    name: "peeled polygons",
    range: |scene, _, _| corners(scene.polygons.peeled()),
    hits: |scene, view, sample| hits(scene, view, sample, scene.polygons.peeled()),
    ..POLYGONS
};

/// Those of clip geometry, in the order of their numbers.
pub static CLIP_POLYGONS: Geometry = Geometry {
    name: "clip geometry",
    range: |scene, _, _| corners(scene.polygons.clipping()),
    hits: |scene, view, sample| hits(scene, view, sample, scene.polygons.clipping()),
    ..POLYGONS
};

/// Those that hide what is behind, in the order of their numbers.
pub static OPAQUE_POLYGONS: Geometry = Geometry {
    name: "opaque polygons",
    range: |scene, _, _| corners(scene.polygons.opaque()),
    hits: |scene, view, sample| hits(scene, view, sample, scene.polygons.opaque()),
    ..POLYGONS
};

/// What all have in common.
const POLYGONS: Geometry = Geometry {
    name: "polygons",
    vertex: "polygons.vert",
    vertices: resource::POLYGON_CORNERS,
    corner: vk::Format::R32G32B32_SFLOAT,
    range: |_, _, _| 0..0,
    numbers: |_, _| None,
    parts: |_, _| None,
    within_box: false,
    front_only: false,
    hits: |_, _, _| Hits { fragments: 0, undecided: false },
};

fn corners(triangles: Range<usize>) -> Range<u32> {
    3 * triangles.start as u32..3 * triangles.end as u32
}

/// One fragment for each triangle that the ray through the pixel's centre meets.
fn hits(scene: &Scene, view: &View, sample: Sample, triangles: Range<usize>) -> Hits {
    let crossings = scene.polygons.crossings(&view.rays, sample.pixel, sample.raster);
    let fragments = crossings.list.iter().filter(|one| triangles.contains(&(one.triangle as usize))).count();
    Hits { fragments: fragments as u32, undecided: crossings.undecided }
}
