//! All polygons of a scene in their places, and where rays meet them.

use std::ops::Range;

use glam::{DMat4, DVec3};
use rayon::prelude::*;

use super::Mesh;
use crate::error::{Error, Result};
use crate::math::bvh::{Bounds, Hierarchy};
use crate::math::ray::ViewRays;

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
}

impl Material {
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

/// All polygons of a scene: the transparent ones first, then the opaque ones, each in the order of the scene's meshes.
#[derive(Clone, Debug, Default)]
pub struct Polygons {
    pub triangles: Vec<Triangle>,
    pub materials: Vec<Material>,
    /// What a user should know of the meshes' files.
    pub warnings: Vec<String>,
    /// Triangles that are transparent.
    transparent: usize,
    hierarchy: Hierarchy,
}

/// Where the ray of a pixel meets a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// The triangle's number.
    pub triangle: u32,
    /// Depth in front of the eye, the ray's own parameter.
    pub depth: f64,
    /// Whether the front is seen.
    pub front: bool,
}

/// The crossings of a pixel's ray.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Crossings {
    /// From the eye on; of equal ones in the order of their triangles.
    pub list: Vec<Crossing>,
    /// Whether a rasteriser, which moves corners to its raster, may find others.
    pub undecided: bool,
}

/// Of a light at the eye, as in `glsl/peel.frag`: the part of a colour that shows where it is seen from the side.
const AMBIENT: f64 = 0.3;

/// Near over depth in f32, by which devices order surfaces: the greater the nearer.
fn nearness(near: f64, depth: f64) -> f32 {
    near as f32 / depth as f32
}

/// Two crossings that are nearer to each other, as a part of their depth, are in an order that f32 may see otherwise.
const DEPTH_ROUNDING: f64 = 1e-6;

impl Polygons {
    /// Adds a mesh, each corner taken to its place in volume space.
    ///
    /// # Errors
    /// When the place is singular, a corner comes to lie where single precision has no numbers, or there are too many
    /// triangles.
    pub fn add(&mut self, mesh: &Mesh, place: DMat4, material: Material) -> Result<()> {
        let bad = |problem: String, remedy: &str| Err(Error::input(&mesh.name, problem, remedy));
        let turn = place.determinant();
        if !(turn.is_finite() && turn != 0.0) {
            return bad(
                format!("is placed by a transform whose determinant is {turn}"),
                "give a transform that can be undone",
            );
        }
        if self.triangles.len() + mesh.triangles.len() > MOST_TRIANGLES {
            let problem =
                format!("brings the triangles of the scene to {}", self.triangles.len() + mesh.triangles.len());
            return bad(problem, &format!("keep them to {MOST_TRIANGLES}"));
        }
        let corners: Vec<[f32; 3]> = mesh
            .corners
            .iter()
            .map(|c| place.transform_point3(DVec3::from_array(c.map(f64::from))).as_vec3().to_array())
            .collect();
        if let Some(far) = corners.iter().flatten().find(|c| c.abs() > FARTHEST || !c.is_finite()) {
            let problem = format!("has a corner at {far} of volume space");
            return bad(problem, &format!("place it within {FARTHEST} of the centre"));
        }
        let Ok(number) = u16::try_from(self.materials.len()) else {
            return bad(format!("is mesh {} of the scene", self.materials.len()), "keep them to 65536");
        };
        self.warnings.extend(mesh.warnings.iter().cloned());
        self.materials.push(material);
        let mut added: Vec<Triangle> = Vec::new();
        for triangle in &mesh.triangles {
            let [a, mut b, mut c] = triangle.map(|i| corners[i as usize]);
            if turn < 0.0 {
                std::mem::swap(&mut b, &mut c);
            }
            // Those without an area cover nothing.
            if let Some(normal) = normal([a, b, c]) {
                added.push(Triangle { corners: [a, b, c], normal, material: number });
            }
        }
        if material.is_opaque() {
            self.triangles.extend(added);
        } else {
            let count = added.len();
            self.triangles.splice(self.transparent..self.transparent, added);
            self.transparent += count;
        }
        Ok(())
    }

    /// Makes them ready for rays, once all meshes are there.
    pub fn ready(mut self) -> Self {
        let boxes: Vec<Bounds> = self
            .triangles
            .iter()
            .map(|triangle| Bounds::around(triangle.corners.map(|c| DVec3::from_array(c.map(f64::from)))))
            .collect();
        self.hierarchy = Hierarchy::new(&boxes);
        self
    }

    /// The transparent triangles, by their numbers.
    pub fn transparent(&self) -> Range<usize> {
        0..self.transparent
    }

    /// The opaque triangles, by their numbers.
    pub fn opaque(&self) -> Range<usize> {
        self.transparent..self.triangles.len()
    }

    pub fn is_empty(&self) -> bool {
        self.triangles.is_empty()
    }

    /// The box around them in volume space.
    pub fn bounds(&self) -> Bounds {
        self.hierarchy.bounds()
    }

    /// The nearest surfaces of a ray, up to `most` transparent ones and the opaque one that ends it: their depths and their
    /// lit colours, premultiplied.
    pub fn surfaces(&self, rays: &ViewRays, pixel: [u32; 2], most: u32) -> Vec<(f64, [f64; 4])> {
        let crossings = self.crossings(rays, pixel, 0.0).list;
        let (transparent, opaque) = self.seen(&crossings);
        let shown = transparent.iter().take(most as usize).chain(opaque);
        shown.map(|one| (one.depth, self.lit(rays.direction(pixel[0], pixel[1]), one))).collect()
    }

    /// Of sorted crossings the transparent ones that an opaque one does not hide, and that opaque one.
    pub fn seen<'a>(&self, crossings: &'a [Crossing]) -> (&'a [Crossing], Option<&'a Crossing>) {
        let end = crossings.iter().position(|one| self.material(one.triangle).is_opaque());
        (&crossings[..end.unwrap_or(crossings.len())], end.map(|at| &crossings[at]))
    }

    /// Of each pixel, row by row, how many transparent surfaces lie behind the first `most`, in front of opaque ones.
    pub fn lacking(&self, rays: &ViewRays, size: [u32; 2], most: u32) -> Vec<u32> {
        if self.transparent().is_empty() {
            return Vec::new();
        }
        let pixel = |i: u32| {
            let crossings = self.crossings(rays, [i % size[0], i / size[0]], 0.0).list;
            (self.seen(&crossings).0.len() as u32).saturating_sub(most)
        };
        (0..size[0] * size[1]).into_par_iter().map(pixel).collect()
    }

    /// The colour of a surface under a light at the eye, premultiplied RGBA.
    pub fn lit(&self, direction: DVec3, crossing: &Crossing) -> [f64; 4] {
        let material = self.material(crossing.triangle);
        let slope = self.triangles[crossing.triangle as usize].normal.dot(direction.normalize());
        let light = (AMBIENT + (1.0 - AMBIENT) * slope.abs()) * material.opacity;
        let [r, g, b] = material.colors[usize::from(!crossing.front)].map(|c| c * light);
        [r, g, b, material.opacity]
    }

    pub fn material(&self, triangle: u32) -> &Material {
        &self.materials[usize::from(self.triangles[triangle as usize].material)]
    }

    /// Where the ray through a pixel's centre meets triangles, beyond the near plane. `raster`: steps of the raster that a
    /// rasteriser moves corners to, in pixels.
    pub fn crossings(&self, rays: &ViewRays, pixel: [u32; 2], raster: f64) -> Crossings {
        let direction = rays.direction(pixel[0], pixel[1]);
        // A pixel is as wide at that depth; the boxes lie no farther than that.
        let wide = raster * (rays.right.length() + rays.down.length());
        let bounds = self.bounds();
        let far = (bounds.least - rays.eye).abs().max((bounds.greatest - rays.eye).abs()).length();
        let mut found = Crossings::default();
        let mut unsure: Vec<Crossing> = Vec::new();
        for number in self.hierarchy.met(rays.eye, direction, wide * far) {
            let Some((crossing, inside)) = self.crossing(rays, direction, number, raster) else { continue };
            match inside {
                Inside::Yes => found.list.push(crossing),
                Inside::Unsure(here) => {
                    unsure.push(crossing);
                    if here {
                        found.list.push(crossing);
                    }
                }
            }
        }
        let key = |one: &Crossing| nearness(rays.near, one.depth);
        found.list.sort_by(|a, b| key(b).total_cmp(&key(a)).then(a.triangle.cmp(&b.triangle)));
        // Where two triangles share the edge, one of them is met there whatever the rasteriser does.
        found.undecided = unsure.iter().any(|one| !unsure.iter().any(|other| self.stand_in(one, other)));
        found.undecided |=
            found.list.windows(2).any(|pair| key(&pair[0]) != key(&pair[1]) && self.may_swap(&pair[0], &pair[1]));
        found
    }

    /// Whether one crossing may be taken for another: the same surface at the same place.
    fn stand_in(&self, one: &Crossing, other: &Crossing) -> bool {
        one.triangle != other.triangle && self.alike(one, other) && near(one.depth, other.depth)
    }

    fn alike(&self, one: &Crossing, other: &Crossing) -> bool {
        let material = |c: &Crossing| self.triangles[c.triangle as usize].material;
        material(one) == material(other) && one.front == other.front
    }

    /// Whether f32 may see two crossings in the other order, and the picture would be another one.
    fn may_swap(&self, one: &Crossing, other: &Crossing) -> bool {
        near(one.depth, other.depth) && !self.alike(one, other)
    }

    /// Where a ray meets the plane of a triangle, and whether inside of its edges.
    fn crossing(&self, rays: &ViewRays, direction: DVec3, number: u32, raster: f64) -> Option<(Crossing, Inside)> {
        let triangle = &self.triangles[number as usize];
        let arms = triangle.corners.map(|c| DVec3::from_array(c.map(f64::from)) - rays.eye);
        let slope = triangle.normal.dot(direction);
        let depth = triangle.normal.dot(arms[0]) / slope;
        let front = slope < 0.0;
        if slope == 0.0 || depth < rays.near || !(front || self.material(number).two_sided) {
            return None;
        }
        // Each edge's plane through the eye; the ray passes on the inner side of all three, by so many pixels.
        let turn = if front { -1.0 } else { 1.0 };
        let (mut inside, mut unsure) = (true, false);
        for i in 0..3 {
            let edge = turn * arms[i].cross(arms[(i + 1) % 3]);
            let side = edge.dot(direction);
            let reach = raster * (edge.dot(rays.right).abs() + edge.dot(rays.down).abs());
            if side < -reach {
                return None;
            }
            // A ray through the very edge meets one of the two triangles that share it.
            let first = edge.to_array().into_iter().find(|c| *c != 0.0).unwrap_or(0.0);
            inside &= side > 0.0 || side == 0.0 && first > 0.0;
            unsure |= side <= reach;
        }
        let crossing = Crossing { triangle: number, depth, front };
        Some((crossing, if unsure { Inside::Unsure(inside) } else { Inside::Yes }))
    }
}

/// Whether a ray passes within the edges of a triangle.
enum Inside {
    Yes,
    /// A rasteriser may see it otherwise.
    Unsure(bool),
}

/// Corners lie no farther from the centre than this, in longest sides of the volume: far enough for every scene, near
/// enough that single precision has squares of it.
const FARTHEST: f32 = 1e6;

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() <= DEPTH_ROUNDING * a.abs().max(b.abs())
}

/// The unit normal of a triangle; none where it has no area.
fn normal(corners: [[f32; 3]; 3]) -> Option<DVec3> {
    let [a, b, c] = corners.map(|c| DVec3::from_array(c.map(f64::from)));
    (b - a).cross(c - a).try_normalize()
}
