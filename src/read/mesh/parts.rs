//! What every reader of meshes gathers: corners and triangles, checked as they come.

use std::path::Path;

use crate::error::{Error, Result};
use crate::scene::mesh::Mesh;

/// The greatest coordinate, in the unit of the file: squares of greater ones do not survive single precision.
const FARTHEST: f64 = 1e18;

/// Corners and triangles of a file that may still turn out to be no mesh.
pub struct Parts<'a> {
    path: &'a Path,
    mesh: Mesh,
    /// Faces that have too few corners to be an area.
    thin: usize,
}

impl<'a> Parts<'a> {
    pub fn new(path: &'a Path) -> Self {
        Self { path, mesh: Mesh { name: path.display().to_string(), ..Mesh::default() }, thin: 0 }
    }

    /// How many corners there are so far.
    pub fn corners(&self) -> usize {
        self.mesh.corners.len()
    }

    /// Adds a corner.
    ///
    /// # Errors
    /// When it lies nowhere, or too far away.
    pub fn corner(&mut self, place: [f64; 3]) -> Result<()> {
        let number = self.corners() + 1;
        if !place.iter().all(|x| x.abs() <= FARTHEST) {
            let remedy = format!("give finite coordinates of at most {FARTHEST:e}");
            return Err(Error::input(self.path.display(), format!("has vertex number {number} at {place:?}"), remedy));
        }
        if u32::try_from(number).is_err() {
            let problem = format!("has more than {} vertices", u32::MAX);
            return Err(Error::input(self.path.display(), problem, "split the mesh"));
        }
        self.mesh.corners.push(place.map(|x| x as f32));
        Ok(())
    }

    /// Adds a polygon as a fan of triangles around its first corner.
    pub fn polygon(&mut self, corners: &[u32]) {
        let [first, rest @ ..] = corners else {
            self.thin += 1;
            return;
        };
        self.thin += usize::from(rest.len() < 2);
        self.mesh.triangles.extend(rest.windows(2).map(|pair| [*first, pair[0], pair[1]]));
    }

    /// Tells the user something of the file.
    pub fn warn(&mut self, warning: impl Into<String>) {
        self.mesh.warnings.push(format!("{} {}", self.path.display(), warning.into()));
    }

    /// Tells that so many bytes follow the mesh.
    pub fn warn_of_rest(&mut self, bytes: usize) {
        match bytes {
            0 => {}
            1 => self.warn("holds 1 byte behind its triangles, which is not read"),
            _ => self.warn(format!("holds {bytes} bytes behind its triangles, which are not read")),
        }
    }

    /// The mesh, when it is one.
    ///
    /// # Errors
    /// When it has no triangles, or one whose corners are not there.
    pub fn finish(mut self) -> Result<Mesh> {
        let held = self.corners();
        let bad = |problem: String, remedy| Err(Error::input(self.path.display(), problem, remedy));
        if self.mesh.triangles.is_empty() {
            return bad(format!("holds no triangles ({held} vertices)"), "give a mesh of at least one triangle");
        }
        let out = |corners: &[u32; 3]| corners.iter().copied().find(|&corner| corner as usize >= held);
        let asked = self.mesh.triangles.iter().enumerate().find_map(|(i, corners)| Some((i + 1, out(corners)?)));
        if let Some((number, corner)) = asked {
            let problem = format!("has triangle number {number} at index {corner}, where there are {held} vertices");
            return bad(problem, "correct the indices of the face");
        }
        match self.thin {
            0 => {}
            1 => self.warn("holds 1 face of fewer than three corners, which is left out"),
            thin => self.warn(format!("holds {thin} faces of fewer than three corners, which are left out")),
        }
        Ok(self.mesh)
    }
}
