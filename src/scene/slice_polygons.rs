//! Slices cut to polygons: what shows of them, by the host, or what the vertex shader needs to cut them.

use std::ops::Range;

use glam::{DVec3, DVec4};

use super::Scene;
use super::frustum::Frustum;
use super::slices::{MARGIN, SLACK, SliceSurface, Slices};
use crate::error::Result;
use crate::math::polyhedron::{HalfSpace, Polyhedron};
use crate::math::ray::Lens;

/// What shows of slices.
#[derive(Clone, Debug, Default)]
pub struct SlicePolygons {
    /// Clip coordinates x, y and w of the corners of triangles, three each, with the number of their slice; in the order of drawing.
    pub corners: Vec<[f32; 4]>,
    /// Where the corners of each slice begin, and where those of the last one end, by the place of the slice in that order.
    begins: Vec<u32>,
}

impl SlicePolygons {
    pub(super) fn new(scene: &Scene, slices: &Slices) -> Result<Self> {
        let cutter = Cutter::new(scene)?;
        let mut polygons = Self { corners: Vec::new(), begins: vec![0] };
        for place in 0..slices.count {
            let slice = if slices.of_pass.is_some() { place } else { slices.count - 1 - place };
            let triangles = cutter.triangles(slices, slice);
            polygons.corners.extend(triangles.into_iter().map(|corner| {
                let [x, y, w] = cutter.frustum.corner(corner);
                [x, y, w, slice as f32]
            }));
            polygons.begins.push(polygons.corners.len() as u32);
        }
        Ok(polygons)
    }

    /// The corners that are drawn in a pass of the slices that these are of.
    pub fn in_pass(&self, slices: &Slices, pass: u32) -> Range<u32> {
        let [first, end] = slices.places_in(pass);
        let last = self.begins.len().saturating_sub(1) as u32;
        let begin = |place: u32| self.begins.get(place.min(last) as usize).copied().unwrap_or_default();
        begin(first)..begin(end)
    }
}

/// What the vertex shader needs to cut planes by the box around the volume.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CutPlanes {
    /// Half of the sides of the box, which is somewhat wider than the volume.
    pub reach: DVec3,
    /// Rows that lead from a place, with 1 behind its coordinates, to clip coordinates x, y and w.
    pub clip: [DVec4; 3],
    /// The normal of all planes, a unit vector.
    pub normal: DVec3,
    /// Where slice 0 lies along the normal: of planes that rays meet on their way up, and on their way down.
    pub first: [f64; 2],
    /// Planes on the way up show beyond the first, those on the way down before the second.
    pub beyond: [f64; 2],
    pub spacing: f64,
}

impl CutPlanes {
    /// Those of the slices of a scene; none of spheres, or where the camera is not one.
    pub fn new(scene: &Scene, slices: &Slices) -> Option<Self> {
        let Cutter { frustum, half, .. } = Cutter::new(scene).ok()?;
        let (rays, forward) = (&frustum.rays, frustum.basis.forward);
        let everywhere = [f64::from(f32::MIN), f64::from(f32::MAX)];
        let nowhere = [everywhere[1], everywhere[0]];
        let (normal, first, beyond) = match slices.surface {
            SliceSurface::Distance => return None,
            SliceSurface::Depth => {
                let first = forward.dot(frustum.eye) + slices.first[0];
                (forward, [first; 2], [everywhere[0], nowhere[1]])
            }
            SliceSurface::Axis(axis) => {
                let beyond = match rays.lens {
                    // Rays go up above the eye and down below it.
                    Lens::Perspective => [rays.origin[axis]; 2],
                    Lens::Orthographic if rays.base[axis] > 0.0 => [everywhere[0], nowhere[1]],
                    Lens::Orthographic => [nowhere[0], everywhere[1]],
                };
                (DVec3::AXES[axis], slices.first, beyond)
            }
        };
        let (clip, spacing) = (frustum.clip_rows(), slices.spacing);
        Some(Self { reach: half, clip, normal, first, beyond, spacing })
    }
}

/// Cuts slices to what a view shows of them.
struct Cutter {
    frustum: Frustum,
    /// Where everything lies that shows, with a margin.
    spaces: Vec<HalfSpace>,
    /// Half of the sides of a box around the volume and its margin.
    half: DVec3,
}

impl Cutter {
    fn new(scene: &Scene) -> Result<Self> {
        let frustum = Frustum::new(scene)?;
        let (rays, half) = (&frustum.rays, 0.5 * scene.field.extent());
        let pixel = rays.right.length().max(rays.down.length());
        let pixels_at = |depth: f64| SLACK + MARGIN * pixel * if rays.parallel() { 1.0 } else { depth };
        // Pixels are largest far away.
        let margin = pixels_at(rays.deepest(-half, half));
        let face = |i: usize| {
            let sign = if i.is_multiple_of(2) { 1.0 } else { -1.0 };
            HalfSpace { normal: sign * DVec3::AXES[i / 2], distance: -half[i / 2] }
        };
        let grown = |space: HalfSpace| HalfSpace { distance: space.distance - margin * space.normal.length(), ..space };
        let kept = (0..6).map(face).chain(scene.clip_planes().iter().copied()).map(grown);
        // Of a slice at the near plane nothing is to be cut off, and of one across it no pixel.
        let near = HalfSpace { distance: frustum.near().distance - pixels_at(rays.near), ..frustum.near() };
        let spaces = kept.chain([near]).chain(frustum.sides()).collect();
        Ok(Self { frustum, spaces, half: half + margin })
    }

    /// The corners of triangles that cover what shows of a slice.
    fn triangles(&self, slices: &Slices, slice: u32) -> Vec<DVec3> {
        let by = f64::from(slice) * slices.spacing;
        let (rays, forward) = (&self.frustum.rays, self.frustum.basis.forward);
        match slices.surface {
            SliceSurface::Depth => {
                let distance = forward.dot(self.frustum.eye) + slices.first[0] + by;
                self.polygon(HalfSpace { normal: forward, distance })
            }
            SliceSurface::Distance => self.shell(slices.first[0] + by),
            SliceSurface::Axis(axis) => {
                // In perspective rays go up above the eye and down below it.
                let goes = |sign: f64, at: f64| match rays.lens {
                    Lens::Orthographic => sign * rays.base[axis] > 0.0,
                    Lens::Perspective => sign * (at - rays.origin[axis]) > 0.0,
                };
                let planes = [(1.0, slices.first[0] + by), (-1.0, slices.first[1] - by)];
                let seen = planes.into_iter().filter(|(sign, at)| goes(*sign, *at));
                seen.flat_map(|(_, at)| self.polygon(HalfSpace { normal: DVec3::AXES[axis], distance: at })).collect()
            }
        }
    }

    /// What shows of a plane, whose normal is a unit vector.
    fn polygon(&self, plane: HalfSpace) -> Vec<DVec3> {
        // More than the way between any two places of the box.
        let reach = 4.0 * (1.0 + self.half.length());
        let middle = plane.normal * plane.distance;
        let u = plane.normal.any_orthonormal_vector();
        let v = plane.normal.cross(u);
        let square = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
        let square = square.map(|(a, b)| middle + reach * (a * u + b * v)).to_vec();
        let corners = self.spaces.iter().fold(square, |corners, space| clipped(&corners, *space));
        (1..corners.len().saturating_sub(1)).flat_map(|i| [0, i, i + 1].map(|c| corners[c])).collect()
    }

    /// The front of the part of the volume that lies as deep as some place of a sphere about the eye: what shows of it, and more.
    fn shell(&self, distance: f64) -> Vec<DVec3> {
        let (eye, forward) = (self.frustum.eye, self.frustum.basis.forward);
        let least = distance / self.frustum.longest_direction();
        let near = HalfSpace { normal: forward, distance: forward.dot(eye) + least };
        let far = HalfSpace { normal: -forward, distance: -forward.dot(eye) - distance };
        let enters = |space: &HalfSpace| self.frustum.enters(space);
        let solid = Polyhedron::cuboid(self.half, enters);
        let spaces = self.spaces.iter().chain([&near, &far]);
        spaces.fold(solid, |solid, space| solid.clipped(*space, Some(enters(space)))).triangles(true)
    }
}

/// What of a convex polygon lies in a half space.
fn clipped(corners: &[DVec3], space: HalfSpace) -> Vec<DVec3> {
    let mut kept = Vec::with_capacity(corners.len() + 1);
    for (i, &a) in corners.iter().enumerate() {
        let b = corners[(i + 1) % corners.len()];
        let (over_a, over_b) = (space.height(a), space.height(b));
        if over_a >= 0.0 {
            kept.push(a);
        }
        if (over_a >= 0.0) != (over_b >= 0.0) {
            kept.push(a + over_a / (over_a - over_b) * (b - a));
        }
    }
    kept
}
