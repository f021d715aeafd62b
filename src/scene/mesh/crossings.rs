//! Where rays meet polygons.

use glam::DVec3;

use super::polygons::Polygons;
use crate::math::edges::{WithinEdges, within_edges};
use crate::math::ray::{Lens, ViewRay, ViewRays};

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

/// Normals that differ by no more are lit alike, to what f32 can tell.
const LIGHT_ROUNDING: f64 = 1e-6;

impl Polygons {
    /// The colour of a surface under a light at the eye, premultiplied RGBA.
    pub fn lit(&self, direction: DVec3, crossing: &Crossing) -> [f64; 4] {
        let material = self.material(crossing.triangle);
        let slope = self.triangles[crossing.triangle as usize].normal.dot(direction.normalize());
        let light = (AMBIENT + (1.0 - AMBIENT) * slope.abs()) * material.opacity;
        let [r, g, b] = material.colors[usize::from(!crossing.front)].map(|c| c * light);
        [r, g, b, material.opacity]
    }

    /// Where the ray through a pixel's centre meets triangles, beyond the near plane. `raster`: steps of the raster that a
    /// rasteriser moves corners to, in pixels.
    pub fn crossings(&self, rays: &ViewRays, pixel: [u32; 2], raster: f64) -> Crossings {
        let ray = rays.of(pixel[0], pixel[1]);
        let pixel_width = rays.right.length() + rays.down.length();
        let bounds = self.hierarchy.bounds();
        // In perspective that is its width at depth 1; the boxes lie no farther than that.
        let far = match rays.lens {
            Lens::Perspective => (bounds.least - ray.origin).abs().max((bounds.greatest - ray.origin).abs()).length(),
            Lens::Orthographic => 1.0,
        };
        let mut found = Crossings::default();
        let mut unsure: Vec<Crossing> = Vec::new();
        for number in self.hierarchy.met(ray.origin, ray.direction, raster * pixel_width * far) {
            let Some((crossing, within)) = self.crossing(rays, &ray, number, raster) else { continue };
            unsure.extend(within.is_unsure().then_some(crossing));
            found.list.extend(within.here.then_some(crossing));
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

    /// Whether two crossings look the same: by their material, and by their light, which faces that meet at an edge turn to
    /// differently.
    fn alike(&self, one: &Crossing, other: &Crossing) -> bool {
        let [a, b] = [one, other].map(|c| &self.triangles[c.triangle as usize]);
        let lit_alike = self.material(one.triangle).clip.is_some() || (a.normal - b.normal).length() < LIGHT_ROUNDING;
        a.material == b.material && one.front == other.front && lit_alike
    }

    /// Whether f32 may see two crossings in the other order, and the picture would be another one.
    fn may_swap(&self, one: &Crossing, other: &Crossing) -> bool {
        near(one.depth, other.depth) && !self.alike(one, other)
    }

    /// Where a ray meets the plane of a triangle, and whether inside of its edges.
    fn crossing(&self, rays: &ViewRays, ray: &ViewRay, number: u32, raster: f64) -> Option<(Crossing, WithinEdges)> {
        let triangle = &self.triangles[number as usize];
        let arms = triangle.corners.map(|c| DVec3::from_array(c.map(f64::from)) - ray.origin);
        let slope = triangle.normal.dot(ray.direction);
        let depth = triangle.normal.dot(arms[0]) / slope;
        let front = slope < 0.0;
        if slope == 0.0 || depth < rays.near || !(front || self.material(number).two_sided) {
            return None;
        }
        let within = within_edges(rays, ray, arms, front, raster)?;
        Some((Crossing { triangle: number, depth, front }, within))
    }
}

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() <= DEPTH_ROUNDING * a.abs().max(b.abs())
}
