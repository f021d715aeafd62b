//! Every pixel of the targets.

use ash::vk;

use crate::part::geometry::{Geometry, Hits};
use crate::resource;

/// A triangle that covers the whole picture.
pub static SCREEN: Geometry = Geometry {
    name: "screen",
    vertex: "box.vert",
    vertices: resource::SCREEN_CORNERS,
    corner: vk::Format::R32G32B32_SFLOAT,
    range: |_, _, _| 0..3,
    numbers: |_, _| None,
    parts: |_, _| None,
    within_box: false,
    front_only: false,
    hits: |_, view, sample| Hits { fragments: view.region.contains(sample.pixel).into(), undecided: false },
};
