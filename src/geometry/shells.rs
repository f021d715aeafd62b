//! Shells, and the polygons that may hide them [Heidrich95 §4].

use std::ops::Range;

use ash::vk;

use super::polygons::OPAQUE_POLYGONS;
use crate::part::geometry::{Geometry, Hits, Sample};
use crate::resource;
use crate::scene::Scene;
use crate::scene::shells::ShellDepth;
use crate::scene::view::View;

/// The shell whose number is that of the main pass, from the dimmest on.
pub static SHELLS: Geometry = Geometry {
    name: "shells",
    vertex: "shells.vert",
    vertices: resource::SHELL_CORNERS,
    corner: vk::Format::R32G32B32_SFLOAT,
    range: |scene, _, pass| corners(scene, pass as usize),
    hits,
};

/// Opaque polygons, in the depth that shells have.
pub static SHELL_SURFACES: Geometry =
    Geometry { name: "surfaces among shells", vertex: "shells.vert", ..OPAQUE_POLYGONS };

fn corners(scene: &Scene, number: usize) -> Range<u32> {
    let Some(shells) = &scene.shells else { return 0..0 };
    let before = shells.triangles_before(&scene.field);
    let corner = |triangles: u64| 3 * triangles as u32;
    match before.get(number..number + 2) {
        Some(ends) => corner(ends[0])..corner(ends[1]),
        None => 0..0,
    }
}

/// One fragment for each triangle of any shell that the ray through the pixel's centre meets.
fn hits(scene: &Scene, view: &View, Sample { pixel, raster }: Sample) -> Hits {
    let mut hits = Hits { fragments: 0, undecided: false };
    let Some((shells, depth)) = scene.shells.as_ref().zip(ShellDepth::of(scene, &view.rays)) else { return hits };
    for shell in &shells.list {
        let crossings = shell.crossings(&scene.field, &view.rays, pixel, &depth, raster);
        hits.fragments += crossings.list.len() as u32;
        hits.undecided |= crossings.undecided;
    }
    hits
}
