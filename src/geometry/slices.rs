//! Slices of the volume [Thesis §3.4].

use ash::vk;

use crate::part::geometry::{Geometry, Hits};
use crate::resource;

/// The same, cut by the vertex shader.
pub static SLICES_CUT: Geometry = Geometry {
    name: "slices_cut",
    vertex: "slices_cut.vert",
    vertices: resource::SLICE_NUMBERS,
    corner: vk::Format::R32G32_SFLOAT,
    range: |_, view, pass| view.slices.as_ref().map_or(0..0, |slices| slices.numbers_in(pass)),
    hits: |_, view, _| Hits { fragments: view.slices.as_ref().map_or(0, |slices| slices.count), undecided: false },
};

/// The slices of a main pass, in the order of drawing. Which of them a pixel has, shaders decide, and their twin: polygons are wider than
/// what they show.
pub static SLICES: Geometry = Geometry {
    name: "slices",
    vertex: "slices.vert",
    vertices: resource::SLICE_CORNERS,
    corner: vk::Format::R32G32B32A32_SFLOAT,
    range: |scene, view, pass| view.slices.as_ref().map_or(0..0, |slices| slices.range(scene, pass)),
    hits: |_, view, _| Hits { fragments: view.slices.as_ref().map_or(0, |slices| slices.count), undecided: false },
};
