//! What a camera sees: the half spaces of its frustum, and places in clip coordinates.

use super::Scene;
use super::camera::Basis;
use crate::error::Result;
use crate::math::polyhedron::HalfSpace;
use crate::math::ray::{Lens, ViewRays};
use glam::{DVec3, DVec4};

/// The view frustum is clipped this much wider than the picture, so that its sides never show; what is left
/// stays within what every rasteriser handles.
const GUARD: f64 = 2.0;

/// What a scene's camera sees.
#[derive(Clone, Copy, Debug)]
pub struct Frustum {
    pub rays: ViewRays,
    pub basis: Basis,
    pub eye: DVec3,
    /// Half of the sides of the picture, volume units: in perspective of what lies at depth 1.
    half: [f64; 2],
}

impl Frustum {
    /// # Errors
    /// When the camera is not one (see [`super::Camera::basis`]).
    pub fn new(scene: &Scene) -> Result<Self> {
        let size = scene.settings.image.size;
        let half_height = scene.camera.half_height();
        let half = [half_height * f64::from(size[0]) / f64::from(size[1]), half_height];
        let (rays, basis) = (scene.camera.rays(size)?, scene.camera.basis()?);
        Ok(Self { rays, basis, eye: scene.camera.eye, half })
    }

    /// What lies beyond the near plane.
    pub fn near(&self) -> HalfSpace {
        let Basis { forward, .. } = self.basis;
        HalfSpace { normal: forward, distance: forward.dot(self.eye) + self.rays.near }
    }

    /// What lies between its sides, wider than the picture.
    pub fn sides(&self) -> [HalfSpace; 4] {
        let Basis { right, up, forward } = self.basis;
        // What lies no farther to a side than this, in perspective at depth 1.
        let within = |side: DVec3, reach: f64| match self.rays.lens {
            Lens::Perspective => {
                let normal = GUARD * reach * forward - side;
                HalfSpace { normal, distance: normal.dot(self.eye) }
            }
            Lens::Orthographic => HalfSpace { normal: -side, distance: -side.dot(self.eye) - GUARD * reach },
        };
        let [width, height] = self.half;
        [within(right, width), within(-right, width), within(up, height), within(-up, height)]
    }

    /// Whether rays enter a half space by its plane: they come from the side that is cut off.
    pub fn enters(&self, space: &HalfSpace) -> bool {
        match self.rays.lens {
            Lens::Perspective => space.height(self.eye) < 0.0,
            Lens::Orthographic => space.normal.dot(self.basis.forward) > 0.0,
        }
    }

    /// A place in clip coordinates: x, y (down) and w.
    pub fn corner(&self, place: DVec3) -> [f32; 3] {
        let arm = place - self.eye;
        let (x, y) = (arm.dot(self.basis.right) / self.half[0], -arm.dot(self.basis.up) / self.half[1]);
        let w = if self.rays.parallel() { 1.0 } else { arm.dot(self.basis.forward) };
        [x, y, w].map(|c| c as f32)
    }

    /// Rows that lead from a place, with 1 behind its coordinates, to clip coordinates x, y (down) and w.
    pub fn clip_rows(&self) -> [DVec4; 3] {
        let Basis { right, up, forward } = self.basis;
        let row = |way: DVec3| way.extend(-way.dot(self.eye));
        let w = if self.rays.parallel() { DVec4::W } else { row(forward) };
        [row(right / self.half[0]), row(-up / self.half[1]), w]
    }

    /// The length of the longest direction of a ray in the picture, each with component 1 along the view direction.
    pub fn longest_direction(&self) -> f64 {
        let [width, height] = self.half;
        if self.rays.parallel() { 1.0 } else { (1.0 + width * width + height * height).sqrt() }
    }
}
