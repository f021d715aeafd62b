//! Clip geometry [Thesis ch. 6 §3]: which parts of a ray it keeps.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::Mesh;
use super::edges::open_edges;
use crate::math::bvh::Bounds;
use crate::math::ray::ViewRays;

/// The part of the volume that a clip mesh keeps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Keep {
    /// What is inside: where a ray has entered the mesh, by its fronts, more often than it has left it, by its backs. A ray
    /// that leaves the mesh more often than it enters it begins inside, which is right for closed meshes; an open one has no
    /// inside but this.
    #[default]
    Inside,
    /// What is not inside.
    Outside,
    /// What lies behind the first surface that a ray meets, and nothing of a ray that meets none [Thesis ch. 6 §3].
    Thesis,
}

/// Clip meshes at the most: the state of a ray within all of them is kept in one number of single precision.
pub const MOST_CLIPS: usize = 4;

/// A ray that has entered a clip mesh this often more than left it is taken to have done so no more often.
const MOST_WINDINGS: i32 = 31;

/// How often a ray has entered each clip mesh more than it has left it, at a place of its way.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Windings([i32; MOST_CLIPS]);

impl Windings {
    /// Where a ray begins that enters each mesh so many times more than it leaves it.
    pub fn of_begin(entered: [i32; MOST_CLIPS]) -> Self {
        Self(entered.map(|more| (-more).clamp(0, MOST_WINDINGS)))
    }

    /// Behind a front or a back of a mesh.
    pub fn behind(mut self, mesh: u8, front: bool) -> Self {
        let one = &mut self.0[usize::from(mesh)];
        *one = (*one + if front { 1 } else { -1 }).clamp(-MOST_WINDINGS, MOST_WINDINGS);
        self
    }

    /// Whether every mesh keeps what is there.
    pub fn kept_by(self, meshes: &[ClipMesh]) -> bool {
        meshes.iter().zip(self.0).all(|(mesh, winding)| (winding > 0) == (mesh.keep == Keep::Inside))
    }
}

/// A mesh that the volume is cut at, in its place.
#[derive(Clone, Debug, PartialEq)]
pub struct ClipMesh {
    /// The mesh's file or shape.
    pub name: String,
    pub keep: Keep,
    /// The box around the mesh, volume space.
    pub bounds: Bounds,
    /// Edges that do not belong to as many faces on one side as on the other: 0 where the mesh is closed, or where that is of no
    /// matter, since only its first surface counts.
    pub open_edges: usize,
}

impl ClipMesh {
    /// A mesh with its corners in volume space.
    pub fn new(mesh: &Mesh, corners: &[[f32; 3]], keep: Keep) -> Self {
        let bounds = Bounds::around(corners.iter().map(|c| DVec3::from_array(c.map(f64::from))));
        let open_edges = if keep == Keep::Thesis { 0 } else { open_edges(&mesh.triangles, corners).len() };
        Self { name: mesh.name.clone(), keep, bounds, open_edges }
    }

    /// Whether every ray of a picture of `size` = [width, height] begins outside of the mesh.
    pub fn rays_begin_outside(&self, rays: &ViewRays, size: [u32; 2]) -> bool {
        let [width, height] = size.map(f64::from);
        let begins =
            [[0.0, 0.0], [width, 0.0], [0.0, height], [width, height]].map(|[x, y]| rays.through(x, y).at(rays.near));
        let near = Bounds::around(begins);
        let apart = near.greatest.cmplt(self.bounds.least) | near.least.cmpgt(self.bounds.greatest);
        self.open_edges == 0 && apart.any()
    }
}
