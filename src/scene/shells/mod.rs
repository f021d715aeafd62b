//! Shells: iso-surfaces of a volume as polygons, one for each level [Heidrich95 §2], by marching cubes over the voxels.
//!
//! [`Crossings`] tells which edges of the lattice a level crosses, and with that how many vertices and triangles there are before any
//! memory is taken for them; [`polygons()`] makes these.

mod cases;
mod crossings;
mod depth;
mod lattice;
mod levels;
mod polygons;
mod rays;

pub use cases::{CASES, CORNERS, EDGES, MOST_TRIANGLES, edge};
pub use crossings::Crossings;
pub use depth::ShellDepth;
pub use lattice::{Faces, Lattice};
pub use levels::{Shell, ShellMesh, Shells, in_the_middle};
pub use polygons::polygons;
pub use rays::{ShellCrossing, ShellCrossings, crossing_of};
