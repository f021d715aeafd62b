//! Shells, and the polygons that may hide them [Heidrich95 §4].

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
    vertices: resource::SHELL_POLYGONS,
    corner: vk::Format::R32G32B32_SFLOAT,
    range: |scene, _, pass| 0..3 * count(scene, pass)[1],
    numbers: |scene, pass| Some(size_of::<[f32; 3]>() as u64 * u64::from(count(scene, pass)[0])),
    parts: |_, _| None,
    within_box: false,
    front_only: false,
    hits,
};

/// Opaque polygons, in the depth that shells have.
pub static SHELL_SURFACES: Geometry =
    Geometry { name: "surfaces among shells", vertex: "shells.vert", ..OPAQUE_POLYGONS };

/// Vertices and triangles of a shell.
fn count(scene: &Scene, number: u32) -> [u32; 2] {
    scene.shells.as_ref().map_or([0; 2], |shells| shells.count_of(number as usize, &scene.field))
}

/// One fragment for each triangle of any shell that the ray through the pixel's centre meets.
fn hits(scene: &Scene, view: &View, Sample { pixel, raster }: Sample) -> Hits {
    let mut hits = Hits { fragments: 0, undecided: false };
    let Some((shells, depth)) = scene.shells.as_ref().zip(ShellDepth::of(scene, &view.rays)) else { return hits };
    for shell in shells.drawn() {
        let crossings = shell.crossings(&scene.field, &view.rays, pixel, &depth, raster);
        hits.fragments += crossings.list.len() as u32;
        hits.undecided |= crossings.undecided;
    }
    hits
}
