//! What draws may cover pixels with, as rows.
//!
//! To add one: a file here with its row, its vertex shader in `glsl`, and a row for its corners in [`mod@crate::resource`].

mod boundary;
mod polygons;
mod screen;
mod shells;
mod slices;
mod tiles;
mod volume_box;

pub use boundary::BOUNDARY;
pub use polygons::{CLIP_POLYGONS, OPAQUE_POLYGONS, PEELED_POLYGONS};
pub use screen::SCREEN;
pub use shells::{SHELL_SURFACES, SHELLS};
pub use slices::{SLICES, SLICES_CUT};
pub use tiles::{
    BACK_IN_TILES, FRONT_FROM_PASS, FRONT_IN_TILES, FRONT_OF_PASS, of_pass, ray_begins, ray_ends, rest_begins,
    segment_begins,
};
pub use volume_box::{BOX_BACK, BOX_FRONT};
