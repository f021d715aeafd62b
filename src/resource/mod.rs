//! Every image and buffer there is, said once: [`RESOURCES`] is the one list.
//!
//! To add one: a row in the file of its kind and a line in [`RESOURCES`] (the order in which lists of resources are printed).
//! Passes name it in their accesses; who makes it stands in its [`crate::part::resource::Origin`]: frames, the host, or a build
//! in `crate::pass::build`.

mod clip_volume;
mod environment;
mod frame;
mod gradients;
mod importance;
mod layers;
mod look;
mod refraction;
mod shells;
mod structure;
mod surface;
mod tetrahedra;
pub mod texels;

pub use clip_volume::{CLIP_VOLUME, CLIP_VOLUME_PLACE};
pub use environment::{ENVIRONMENT, ENVIRONMENT_PLACE};
pub use frame::{
    ACCUMULATED, BOX, CLIP_PLANES, DIRECTION, ENTRY, FRAME, MARKS, MARKS_BUFFER, SINGLE_RAYS, SLICE_CORNERS, SLICE_CUT,
    SLICE_NUMBERS, SLICES, STORED,
};
pub use gradients::{GRADIENT_TEXELS, GRADIENTS, gradient_bytes, gradients};
pub use importance::{IMPORTANCE, REACHED};
pub use layers::{
    CLIP_WINDING, LAYER, LAYER_COLOR, MATERIALS, PEEL_DEPTH, PLACEMENT, POLYGON_CORNERS, SCREEN_CORNERS, TRIANGLES,
};
pub use look::{AXIS, FEW_GREY_TRANSFER, FEW_TRANSFER, GREY_TRANSFER, HOLES, PREINTEGRATED, STACKS, TRANSFER, VOLUME};
pub use refraction::{BACKDROP, REFRACTIVE_INDEX};
pub use shells::{
    SHELL_CASES, SHELL_CUE, SHELL_DEPTH, SHELL_EDGES, SHELL_LEVELS, SHELL_PLACEMENT, SHELL_POLYGONS, SHELL_SIDES,
    SHELL_SUMS, SUMMED, largest_shell_buffer, lattice_words, shell_bytes, sum_counts,
};
pub use structure::{
    BLOCK_TABLE, BOXES_2, BOXES_4, BUNDLE, CELL_RANGE, DISTANCE_BYTES, INTERESTING, NEAREST_DISTANCE, OMNI_DISTANCE,
    SQUARES, SQUARES_AFTER, SUPPORT, WIDE_2, WIDE_4, block_ranges, largest_buffer, words_of_bits, words_of_bytes,
};
pub use surface::{LIGHTS, SURFACE_HIT, SURFACE_LEVELS, WHITE_LIGHTS};
pub use tetrahedra::{
    TET_ACROSS, TET_BEGIN, TET_BOUNDARY, TET_CELL, TET_CELLS, TET_CORNERS, TET_ENTRY, TET_PLACES, TET_POINT,
    TET_POINTS, TET_TABLE, TET_VIEW,
};

use crate::part::resource::Resource;

/// Every resource, in the order of lists.
pub const RESOURCES: [Resource; 83] = [
    BOX,
    FRAME,
    SINGLE_RAYS,
    SLICE_CORNERS,
    SLICE_NUMBERS,
    SLICE_CUT,
    SLICES,
    CLIP_PLANES,
    ENTRY,
    DIRECTION,
    ACCUMULATED,
    REACHED,
    SURFACE_HIT,
    STORED,
    MARKS,
    MARKS_BUFFER,
    SCREEN_CORNERS,
    POLYGON_CORNERS,
    TRIANGLES,
    MATERIALS,
    PLACEMENT,
    LAYER,
    LAYER_COLOR,
    PEEL_DEPTH,
    CLIP_WINDING,
    SHELL_POLYGONS,
    SHELL_PLACEMENT,
    SHELL_LEVELS,
    SHELL_CUE,
    SHELL_DEPTH,
    TET_CORNERS,
    TET_PLACES,
    TET_POINTS,
    TET_CELLS,
    TET_ACROSS,
    TET_BOUNDARY,
    TET_VIEW,
    TET_BEGIN,
    TET_TABLE,
    TET_ENTRY,
    TET_CELL,
    TET_POINT,
    SURFACE_LEVELS,
    LIGHTS,
    WHITE_LIGHTS,
    ENVIRONMENT,
    ENVIRONMENT_PLACE,
    REFRACTIVE_INDEX,
    BACKDROP,
    VOLUME,
    STACKS[0],
    STACKS[1],
    STACKS[2],
    CLIP_VOLUME,
    CLIP_VOLUME_PLACE,
    HOLES,
    GRADIENTS,
    GRADIENT_TEXELS,
    TRANSFER,
    GREY_TRANSFER,
    FEW_TRANSFER,
    FEW_GREY_TRANSFER,
    PREINTEGRATED,
    AXIS,
    IMPORTANCE,
    NEAREST_DISTANCE,
    CELL_RANGE,
    BLOCK_TABLE,
    SUPPORT,
    INTERESTING,
    WIDE_2,
    WIDE_4,
    SQUARES,
    SQUARES_AFTER,
    DISTANCE_BYTES,
    BOXES_2,
    BOXES_4,
    OMNI_DISTANCE,
    BUNDLE,
    SHELL_CASES,
    SHELL_SIDES,
    SHELL_EDGES,
    SHELL_SUMS,
];

/// The place of a resource in lists.
pub fn order(resource: Resource) -> (usize, u16) {
    let row = RESOURCES.iter().position(|row| std::ptr::eq(row.of, resource.of));
    (row.unwrap_or(RESOURCES.len()), resource.index)
}
