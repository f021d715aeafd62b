//! The volume's box, clipped to the view [KW03 §2.1].

use ash::vk;

use crate::part::geometry::{Geometry, Hits, Sample};
use crate::resource;
use crate::scene::Scene;
use crate::scene::view::View;

/// Its front faces with the caps of the near plane and of clip planes: where rays enter.
pub static BOX_FRONT: Geometry =
    Geometry { name: "front faces", range: |_, view, _| 0..view.front.len() as u32, ..BOX };

/// Its back faces: where rays leave.
pub static BOX_BACK: Geometry = Geometry {
    name: "back faces",
    range: |_, view, _| {
        let front = view.front.len() as u32;
        front..front + view.back.len() as u32
    },
    ..BOX
};

/// What both have in common.
const BOX: Geometry = Geometry {
    name: "box",
    vertex: "box.vert",
    vertices: resource::BOX,
    corner: vk::Format::R32G32B32_SFLOAT,
    range: |_, _, _| 0..0,
    numbers: |_, _| None,
    parts: |_, _| None,
    within_box: true,
    front_only: false,
    hits,
};

/// One fragment where the ray meets the box, which is convex. A rasteriser moves corners by up to half of its raster on
/// each axis; twice that leaves room for its own arithmetic.
fn hits(scene: &Scene, view: &View, Sample { pixel: [column, row], raster }: Sample) -> Hits {
    let hit = |x: f64, y: f64| {
        let ray = view.rays.through(f64::from(column) + 0.5 + x, f64::from(row) + 0.5 + y);
        scene.interval(&ray, view.rays.near).is_some()
    };
    let centre = hit(0.0, 0.0);
    let around = [(raster, raster), (-raster, raster), (raster, -raster), (-raster, -raster)];
    Hits { fragments: u32::from(centre), undecided: around.into_iter().any(|(x, y)| hit(x, y) != centre) }
}
