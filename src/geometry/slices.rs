//! Slices of the volume [Thesis §3.4].

use std::sync::Arc;

use ash::vk;

use crate::part::geometry::{Geometry, Hits};
use crate::resource;
use crate::scene::slices::Slices;

/// The same, cut by the vertex shader.
pub static SLICES_CUT: Geometry = Geometry {
    name: "slices_cut",
    vertex: "slices_cut.vert",
    vertices: resource::SLICE_NUMBERS,
    corner: vk::Format::R32G32_SFLOAT,
    range: |_, view, pass| view.slices.as_ref().map_or(0..0, |slices| slices.numbers_in(pass)),
    numbers: |_, _| None,
    parts: |_, _| None,
    within_box: false,
    front_only: false,
    hits: |_, view, _| Hits { fragments: view.slices.as_ref().map_or(0, |slices| slices.count), undecided: false },
};

/// The slices of a main pass, in the order of drawing. Which of them a pixel has, shaders decide, and their twin: polygons are wider than
/// what they show.
pub static SLICES: Geometry = Geometry {
    name: "slices",
    vertex: "slices.vert",
    vertices: resource::SLICE_CORNERS,
    corner: vk::Format::R32G32B32A32_SFLOAT,
    range: |scene, view, pass| {
        let in_pass = |slices: &Arc<Slices>| view.slice_polygons(scene).in_pass(slices, pass);
        view.slices.as_ref().map_or(0..0, in_pass)
    },
    numbers: |_, _| None,
    parts: |_, _| None,
    within_box: false,
    front_only: false,
    hits: |_, view, _| Hits { fragments: view.slices.as_ref().map_or(0, |slices| slices.count), undecided: false },
};
