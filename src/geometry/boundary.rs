//! The boundary of a mesh of tetrahedra [Weiler03 "First Hit"].

use ash::vk;

use crate::part::geometry::{Geometry, Hits, Sample};
use crate::resource;
use crate::scene::Scene;
use crate::scene::tetrahedra::seen::Line;
use crate::scene::view::View;

/// Faces with nothing across, in the order of their numbers.
pub static BOUNDARY: Geometry = Geometry {
    name: "boundary",
    vertex: "polygons.vert",
    vertices: resource::TET_CORNERS,
    corner: vk::Format::R32G32B32_SFLOAT,
    range: |scene, _, _| 0..scene.tetrahedra.as_ref().map_or(0, |mesh| 3 * mesh.boundary.len() as u32),
    numbers: |_, _| None,
    parts: |_, _| None,
    within_box: false,
    front_only: true,
    hits,
};

/// As many fragments as there are faces by which the ray through the pixel's centre enters; undecided beside the outline, where a
/// rasteriser may see more of them or fewer.
fn hits(scene: &Scene, view: &View, Sample { pixel: [column, row], raster }: Sample) -> Hits {
    let Some(mesh) = &scene.tetrahedra else { return Hits { fragments: 0, undecided: false } };
    let entered = |x: f64, y: f64| {
        let ray = view.rays.through(f64::from(column) + 0.5 + x, f64::from(row) + 0.5 + y);
        let line = Line::new(ray.origin, ray.direction);
        let entries = mesh.entries(&line, (ray.origin, ray.direction));
        entries.iter().filter(|entry| entry.at.depth >= view.rays.near).count() as u32
    };
    let fragments = entered(0.0, 0.0);
    let around = [(raster, raster), (-raster, raster), (raster, -raster), (-raster, -raster)];
    Hits { fragments, undecided: around.into_iter().any(|(x, y)| entered(x, y) != fragments) }
}
