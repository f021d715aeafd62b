//! Polygons of a scene: meshes as files and built-in shapes have them, and all of a scene's in their places.

mod clip;
mod crossings;
mod cuts;
mod edges;
mod polygons;
mod shapes;
mod snapshot;

pub use clip::{ClipMesh, Keep, MOST_CLIPS, Windings};
pub use crossings::{Crossing, Crossings};
pub use cuts::{Cut, Cuts, DividedRay, ShownSurface};
pub use edges::{OpenEdge, open_edges};
pub use polygons::{Material, Polygons, Triangle};
pub use shapes::{SHAPES, Shape, shape};

use glam::DVec3;

use crate::math::bvh::Bounds;

/// Triangles in the unit of their file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// The file, or the built-in shape.
    pub name: String,
    pub corners: Vec<[f32; 3]>,
    /// Three places among the corners each, counter-clockwise as seen from the front.
    pub triangles: Vec<[u32; 3]>,
    /// What a user should know of the file.
    pub warnings: Vec<String>,
}

impl Mesh {
    /// The least and the greatest corner of the box around its corners; the origin where it has none.
    pub fn bounds(&self) -> [DVec3; 2] {
        let bounds = Bounds::around(self.corners.iter().map(|c| DVec3::from_array(c.map(f64::from))));
        if self.corners.is_empty() { [DVec3::ZERO; 2] } else { [bounds.least, bounds.greatest] }
    }
}
