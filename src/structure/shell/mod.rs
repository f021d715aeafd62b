//! Shells: iso-surfaces of a volume as polygons, one for each level [Heidrich95 §2], by marching cubes over the voxels.
//!
//! [`Crossings`] tells which edges of the lattice a level crosses, and with that how many vertices and triangles there are before any
//! memory is taken for them; [`polygons()`] makes these.

mod cases;
mod crossings;
mod lattice;
mod polygons;

pub use cases::{CASES, CORNERS, EDGES, MOST_TRIANGLES, edge};
pub use crossings::Crossings;
pub use lattice::Lattice;
pub use polygons::polygons;
