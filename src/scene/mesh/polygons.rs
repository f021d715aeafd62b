//! All polygons of a scene in their places, and where rays meet them.

use std::ops::Range;

use glam::{DMat4, DVec3};

use super::Mesh;
use super::clip::{ClipMesh, Keep};
use crate::error::{Error, Result};
use crate::math::bvh::{Bounds, Hierarchy};

/// The most triangles of a scene: each has a number that a single-precision number holds.
pub const MOST_TRIANGLES: usize = 1 << 24;

/// How a mesh looks, in linear light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// The linear colours of the mesh's fronts and of its backs.
    pub colors: [[f64; 3]; 2],
    pub opacity: f64,
    /// Whether the mesh's backs show.
    pub two_sided: bool,
    /// Of clip geometry, which has no colour: the mesh's number among the scene's clip meshes.
    pub clip: Option<u8>,
}

impl Material {
    /// That of the clip mesh with a number.
    fn clipping(number: u8) -> Self {
        Self { colors: [[0.0; 3]; 2], opacity: 0.0, two_sided: true, clip: Some(number) }
    }

    /// Whether nothing behind it shows.
    pub fn is_opaque(&self) -> bool {
        self.opacity >= 1.0
    }
}

/// A triangle in its place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Triangle {
    /// Volume space, as devices have them; counter-clockwise as seen from the front.
    pub corners: [[f32; 3]; 3],
    /// Unit normal, on the front.
    pub normal: DVec3,
    /// Its material's place among those of the scene.
    pub material: u16,
}

impl Triangle {
    /// Makes the front the back.
    fn turn(&mut self) {
        self.corners.swap(1, 2);
        self.normal = -self.normal;
    }
}

/// Six times the volume within triangles that are closed, below 0 where their fronts are inside.
fn content(triangles: &[Triangle]) -> f64 {
    let part = |triangle: &Triangle| {
        let [a, b, c] = triangle.corners.map(|c| DVec3::from_array(c.map(f64::from)));
        a.dot(b.cross(c))
    };
    triangles.iter().map(part).sum()
}

/// All polygons of a scene: the transparent ones first, then those of clip geometry, then the opaque ones, each in the order of
/// the scene's meshes.
#[derive(Clone, Debug, Default)]
pub struct Polygons {
    pub triangles: Vec<Triangle>,
    pub materials: Vec<Material>,
    /// What a user should know of the meshes' files.
    pub warnings: Vec<String>,
    /// How many triangles are transparent.
    transparent: usize,
    /// How many triangles are those of clip geometry.
    clipping: usize,
    /// The clip meshes, by their numbers.
    clips: Vec<ClipMesh>,
    /// The box around what shows.
    bounds: Option<Bounds>,
    pub(super) hierarchy: Hierarchy,
}

impl Polygons {
    /// Adds a mesh, each corner taken to its place in volume space.
    ///
    /// # Errors
    /// When the place is singular, a corner comes to lie where single precision has no numbers, or there are too many
    /// triangles.
    pub fn add(&mut self, mesh: &Mesh, place: DMat4, material: Material) -> Result<()> {
        let corners = self.placed(mesh, place)?;
        let added = self.faces(mesh, &corners, place, material)?;
        let at = if material.is_opaque() { self.triangles.len() } else { self.transparent };
        self.transparent += if material.is_opaque() { 0 } else { added.len() };
        self.triangles.splice(at..at, added);
        Ok(())
    }

    /// Adds a mesh that the volume is cut at, in the same way.
    ///
    /// # Errors
    /// As [`Self::add`].
    pub fn add_clip(&mut self, mesh: &Mesh, place: DMat4, keep: Keep) -> Result<()> {
        let corners = self.placed(mesh, place)?;
        // Where there may be more than such a number, no mesh needs its own.
        let number = u8::try_from(self.clips.len()).unwrap_or(u8::MAX);
        let mut added = self.faces(mesh, &corners, place, Material::clipping(number))?;
        if added.is_empty() {
            return Err(Error::input(
                &mesh.name,
                "has no triangle with an area",
                "give a mesh with faces, or leave out [[clip]]",
            ));
        }
        let clip = ClipMesh::new(mesh, &corners, keep);
        // Fronts of a closed mesh that are turned inwards would make an inside of what is outside.
        if clip.open_edges == 0 && content(&added) < 0.0 {
            added.iter_mut().for_each(Triangle::turn);
        }
        self.clips.push(clip);
        let at = self.transparent + self.clipping;
        self.clipping += added.len();
        self.triangles.splice(at..at, added);
        Ok(())
    }

    /// The corners of a mesh in volume space.
    fn placed(&self, mesh: &Mesh, place: DMat4) -> Result<Vec<[f32; 3]>> {
        let bad = |problem: String, remedy: &str| Err(Error::input(&mesh.name, problem, remedy));
        let turn = place.determinant();
        if !(turn.is_finite() && turn != 0.0) {
            return bad(
                format!("is placed by a transform whose determinant is {turn}"),
                "give a transform that can be undone",
            );
        }
        let count = self.triangles.len() + mesh.triangles.len();
        if count > MOST_TRIANGLES {
            let problem = format!("brings the triangles of the scene to {count}");
            return bad(problem, &format!("keep them to {MOST_TRIANGLES}"));
        }
        let in_place = |c: &[f32; 3]| place.transform_point3(DVec3::from_array(c.map(f64::from))).as_vec3().to_array();
        let corners: Vec<[f32; 3]> = mesh.corners.iter().map(in_place).collect();
        match corners.iter().flatten().find(|c| c.abs() > FARTHEST || !c.is_finite()) {
            Some(far) => bad(
                format!("has a corner at {far} of volume space"),
                &format!("place it within {FARTHEST} of the centre"),
            ),
            None => Ok(corners),
        }
    }

    /// The triangles of a mesh whose corners are in their places, fronts where they were.
    fn faces(&mut self, mesh: &Mesh, corners: &[[f32; 3]], place: DMat4, material: Material) -> Result<Vec<Triangle>> {
        let Ok(number) = u16::try_from(self.materials.len()) else {
            let problem = format!("is mesh {} of the scene", self.materials.len());
            return Err(Error::input(&mesh.name, problem, "keep them to 65536"));
        };
        self.warnings.extend(mesh.warnings.iter().cloned());
        self.materials.push(material);
        let mirrored = place.determinant() < 0.0;
        let face = |triangle: &[u32; 3]| {
            let [a, b, c] = triangle.map(|i| corners[i as usize]);
            let corners = if mirrored { [a, c, b] } else { [a, b, c] };
            // Those without an area cover nothing.
            normal(corners).map(|normal| Triangle { corners, normal, material: number })
        };
        Ok(mesh.triangles.iter().filter_map(face).collect())
    }

    /// Makes them ready for rays, once all meshes are there.
    pub fn ready(mut self) -> Self {
        let boxes: Vec<Bounds> = self
            .triangles
            .iter()
            .map(|triangle| Bounds::around(triangle.corners.map(|c| DVec3::from_array(c.map(f64::from)))))
            .collect();
        self.hierarchy = Hierarchy::new(&boxes);
        let shown = boxes[self.transparent()].iter().chain(&boxes[self.opaque()]);
        self.bounds = shown.copied().reduce(Bounds::with);
        self
    }

    /// The transparent triangles, by their numbers.
    pub fn transparent(&self) -> Range<usize> {
        0..self.transparent
    }

    /// The triangles of clip geometry, by their numbers.
    pub fn clipping(&self) -> Range<usize> {
        self.transparent..self.transparent + self.clipping
    }

    /// The opaque triangles, by their numbers.
    pub fn opaque(&self) -> Range<usize> {
        self.transparent + self.clipping..self.triangles.len()
    }

    /// The triangles that divide rays, by their numbers: transparent ones, and those of clip geometry, unless it only cuts in
    /// front of its first surface.
    pub fn peeled(&self) -> Range<usize> {
        if self.cuts_in_front() { self.transparent() } else { 0..self.transparent + self.clipping }
    }

    /// The clip meshes, by their numbers.
    pub fn clips(&self) -> &[ClipMesh] {
        &self.clips
    }

    /// Whether clip geometry cuts all that is in front of its first surface [Thesis ch. 6 §3].
    pub fn cuts_in_front(&self) -> bool {
        self.clips.iter().any(|clip| clip.keep == Keep::Thesis)
    }

    /// Whether there is neither anything that shows nor anything that clips.
    pub fn is_empty(&self) -> bool {
        self.clips.is_empty() && !self.show()
    }

    /// Whether any of them show.
    pub fn show(&self) -> bool {
        !self.transparent().is_empty() || !self.opaque().is_empty()
    }

    /// The box around those that show, in volume space; none where none do.
    pub fn bounds(&self) -> Option<Bounds> {
        self.bounds
    }

    /// How a triangle looks, by its number.
    pub fn material(&self, triangle: u32) -> &Material {
        &self.materials[usize::from(self.triangles[triangle as usize].material)]
    }
}

/// Corners lie no farther from the centre than this, in longest sides of the volume: far enough for every scene, near
/// enough that single precision has squares of it.
const FARTHEST: f32 = 1e6;

/// The unit normal of a triangle; none where it has no area.
fn normal(corners: [[f32; 3]; 3]) -> Option<DVec3> {
    let [a, b, c] = corners.map(|c| DVec3::from_array(c.map(f64::from)));
    (b - a).cross(c - a).try_normalize()
}
