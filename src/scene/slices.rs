//! Slices: planes or spheres that rays are sampled on, and their polygons [Thesis §3.4].

use std::ops::Range;

use glam::DVec3;

use super::Scene;
use super::frustum::Frustum;
use crate::error::Result;
use crate::math::ray::{ViewRay, ViewRays};

/// How slices lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Stack {
    /// Across that axis of the volume which is nearest to the view direction [Thesis §3.4.1].
    Objects,
    /// Across the view direction [Thesis §3.4.2].
    View,
    /// Spheres about the eye, between which all rays have the same way to go.
    Shells,
}

/// The surfaces on which all slices lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SliceSurface {
    /// Planes across an axis of the volume, at its coordinates.
    Axis(usize),
    /// Planes at depths in front of the eye.
    Depth,
    /// Spheres at distances from the eye.
    Distance,
}

/// A slice reaches so far beyond the volume, in its sides and, at clip planes and the near plane, in volume units: samples on a face of the box are there on
/// every device, whatever rounding does to them.
pub const SLACK: f64 = 1.0 / (1 << 16) as f64;

/// Polygons are wider than what they show by so many pixels, so that no rasteriser misses a pixel; shaders drop the rest.
pub(super) const MARGIN: f64 = 2.0;

/// What f64 may take from a number of slices.
const ROUNDING: f64 = 1e-9;

/// Corners of the four triangles of a plane in a box, which has six corners at the most.
const CORNERS_OF_PLANE: u32 = 12;

/// Slices at the most; more are refused.
pub const MOST: u32 = 1 << 17;

/// Slices of a view, numbered from the eye on.
#[derive(Clone, Debug, PartialEq)]
pub struct Slices {
    pub surface: SliceSurface,
    /// Where slice 0 lies, by its surface: for rays that go up along the axis, and for those that go down; the same for both of the
    /// others.
    pub first: [f64; 2],
    /// From slice to slice, volume units.
    pub spacing: f64,
    pub count: u32,
    /// Slices of a pass, which are drawn front to back; none where one pass draws all of them back to front.
    pub of_pass: Option<u32>,
}

impl Slices {
    /// Slices of a scene a step apart, drawn front to back in passes of so many of them, or back to front.
    ///
    /// # Errors
    /// When the camera is not one (see [`super::Camera::basis`]).
    pub fn new(scene: &Scene, stack: Stack, of_pass: Option<u32>) -> Result<Self> {
        Ok(Self::placed(scene, &Frustum::new(scene)?, stack, of_pass))
    }

    fn placed(scene: &Scene, frustum: &Frustum, stack: Stack, of_pass: Option<u32>) -> Self {
        let sampling = &scene.settings.sampling;
        let half = 0.5 * scene.field.extent();
        let rays = &frustum.rays;
        let surface = match stack {
            Stack::Objects => SliceSurface::Axis(steepest(frustum.basis.forward)),
            Stack::Shells if !rays.parallel() => SliceSurface::Distance,
            Stack::View | Stack::Shells => SliceSurface::Depth,
        };
        let (spacing, offset) = match surface {
            // At the textures, each across voxels' centres.
            SliceSurface::Axis(axis) if !scene.settings.method.between => (scene.field.voxel()[axis], 0.5),
            _ => (sampling.step * scene.field.finest(), sampling.offset.steps()),
        };
        let offset = offset * spacing;
        // One that is on the far face, but for rounding, shows nothing of the volume.
        let counted = |length: f64| ((length - offset) / spacing - ROUNDING).ceil().max(0.0);
        let (first, count) = match surface {
            SliceSurface::Depth => {
                let nearest = rays.nearest(-half, half);
                ([nearest + offset; 2], counted(rays.deepest(-half, half) - nearest))
            }
            SliceSurface::Distance => {
                let arm = rays.origin.abs();
                // All rays have come beyond the near plane there.
                let near = rays.near * frustum.longest_direction();
                let nearest = (arm - half).max(DVec3::ZERO).length().max(near);
                ([nearest + offset; 2], counted((arm + half).length() - nearest))
            }
            SliceSurface::Axis(axis) => {
                // Those that the eye has passed are left out, on both sides.
                let all = counted(2.0 * half[axis]);
                let passed = |way: f64| if rays.parallel() { 0.0 } else { counted(way).min(all) };
                let [up, down] = [rays.origin[axis] + half[axis], half[axis] - rays.origin[axis]].map(passed);
                let first = [-half[axis] + offset + up * spacing, half[axis] - offset - down * spacing];
                (first, all - up.min(down))
            }
        };
        let count = count.min(f64::from(u32::MAX)) as u32;
        Self { surface, first, spacing, count, of_pass }
    }

    /// The places of the first slice of a pass and one past that of its last one, in the order of drawing.
    pub(super) fn places_in(&self, pass: u32) -> [u32; 2] {
        match self.of_pass {
            None => [0, self.count],
            Some(slices) => [pass, pass + 1].map(|pass| pass.saturating_mul(slices).min(self.count)),
        }
    }

    /// Corners of triangles that the vertex shader makes of a slice.
    fn corners_of_slice(&self) -> u32 {
        let sides = if matches!(self.surface, SliceSurface::Axis(_)) { 2 } else { 1 };
        sides * CORNERS_OF_PLANE
    }

    /// Numbers of slices and of their corners, in the order of drawing, where the vertex shader cuts them.
    pub fn numbers(&self) -> Vec<[f32; 2]> {
        let slice = |place: u32| if self.of_pass.is_some() { place } else { self.count - 1 - place };
        let of = |place: u32| (0..self.corners_of_slice()).map(move |corner| [slice(place) as f32, corner as f32]);
        (0..self.count).flat_map(of).collect()
    }

    /// How many of these there are.
    pub fn numbers_in_all(&self) -> u32 {
        self.count * self.corners_of_slice()
    }

    /// Which of these are of a pass.
    pub fn numbers_in(&self, pass: u32) -> Range<u32> {
        let [first, end] = self.places_in(pass).map(|place| place * self.corners_of_slice());
        first..end
    }

    /// The slices of a pass, in the order of drawing.
    pub fn in_pass(&self, pass: u32) -> Box<dyn Iterator<Item = u32>> {
        match self.of_pass {
            None => Box::new((0..self.count).rev()),
            Some(slices) => {
                let end = |pass: u32| pass.saturating_mul(slices).min(self.count);
                Box::new(end(pass)..end(pass + 1))
            }
        }
    }

    /// The depth at which a ray meets a slice; not a number where it never does.
    pub fn depth(&self, ray: &ViewRay, slice: u32) -> f64 {
        let by = f64::from(slice) * self.spacing;
        match self.surface {
            SliceSurface::Depth => self.first[0] + by,
            SliceSurface::Distance => (self.first[0] + by) / ray.direction.length(),
            SliceSurface::Axis(axis) => {
                let up = ray.direction[axis] > 0.0;
                let at = if up { self.first[0] + by } else { self.first[1] - by };
                (at - ray.origin[axis]) / ray.direction[axis]
            }
        }
    }

    /// The number, with a fraction, that a slice at a depth of the ray would have; not a number where the ray meets none.
    pub fn number(&self, ray: &ViewRay, depth: f64) -> f64 {
        match self.surface {
            SliceSurface::Depth => (depth - self.first[0]) / self.spacing,
            SliceSurface::Distance => (depth * ray.direction.length() - self.first[0]) / self.spacing,
            SliceSurface::Axis(axis) if ray.direction[axis] == 0.0 => f64::NAN,
            SliceSurface::Axis(axis) => {
                let at = ray.origin[axis] + depth * ray.direction[axis];
                let way = if ray.direction[axis] > 0.0 { at - self.first[0] } else { self.first[1] - at };
                way / self.spacing
            }
        }
    }

    /// From slice to slice along a ray, volume units.
    pub fn stride(&self, ray: &ViewRay) -> f64 {
        let length = ray.direction.length();
        match self.surface {
            SliceSurface::Depth => self.spacing * length,
            SliceSurface::Distance => self.spacing,
            SliceSurface::Axis(axis) => self.spacing * length / ray.direction[axis].abs(),
        }
    }

    /// From slice to slice along the ray that goes farthest between them, in spacings; infinite where one never meets the next slice.
    pub fn longest_stride(&self, rays: &ViewRays, size: [u32; 2]) -> f64 {
        let corners = [[0, 0], [0, 1], [1, 0], [1, 1]].map(|corner: [u32; 2]| {
            let [column, row] = [0, 1].map(|axis| f64::from(corner[axis] * size[axis]));
            rays.through(column, row)
        });
        // Between the corners an axis may lie that no ray of theirs goes along.
        let along = |ray: &ViewRay, axis: usize| ray.direction[axis] * corners[0].direction[axis] > 0.0;
        let meets = |ray: &ViewRay| match self.surface {
            SliceSurface::Axis(axis) => along(ray, axis),
            SliceSurface::Depth | SliceSurface::Distance => true,
        };
        let stride = |ray: &ViewRay| if meets(ray) { self.stride(ray) / self.spacing } else { f64::INFINITY };
        corners.iter().map(stride).fold(1.0, f64::max)
    }

    /// Whether the opacities of all samples are those of a step.
    pub fn evenly_spaced(&self, rays: &ViewRays) -> bool {
        match self.surface {
            SliceSurface::Depth => rays.parallel(),
            SliceSurface::Distance => true,
            SliceSurface::Axis(_) => false,
        }
    }
}

/// The axis along which a direction goes farthest.
fn steepest(direction: DVec3) -> usize {
    let by = direction.abs();
    (0..3).max_by(|a, b| by[*a].total_cmp(&by[*b])).unwrap_or(2)
}

/// How far a place is within the volume and where clip planes keep it, grown by `slack`: in sides of the volume, at planes in volume units;
/// negative outside.
pub fn within(scene: &Scene, place: DVec3, slack: f64) -> f64 {
    let faces = 0.5 - (place / scene.field.extent()).abs();
    let planes = scene.clip_planes().iter().map(|plane| plane.height(place));
    planes.fold(faces.min_element(), f64::min) + slack
}
