//! A camera anywhere, inside the volume too, in perspective or orthographic.

use glam::{DQuat, DVec3};

use super::limits::{Allowed, Limits};
use crate::error::{Error, Result};
use crate::math::ray::{Lens, ViewRays};

/// Rays begin this far in front of the eye, in volume units (the volume's longest side is 1): near enough to
/// miss nothing one could see, far enough from 0 that clip space can divide by it.
pub const NEAR: f64 = 1e-4;

/// Vertical fields of view, in degrees.
pub const FIELDS_OF_VIEW: Limits = Limits::new(Allowed::Between(0.0, 180.0), "a vertical field of view {} degrees");

/// Heights of an orthographic picture, in volume units.
pub const PICTURE_HEIGHTS: Limits = Limits::from_to(1e-6, 1e6, "the height of the picture {} in volume space");

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Positions in volume space.
    pub eye: DVec3,
    pub target: DVec3,
    pub up: DVec3,
    /// Vertical field of view, one of [`FIELDS_OF_VIEW`]; an orthographic camera has none.
    pub fov_y: f64,
    /// The height of an orthographic camera's picture in volume units, one of [`PICTURE_HEIGHTS`]; none of one in perspective.
    pub height: Option<f64>,
}

/// Right, up and forward of a camera, orthonormal.
#[derive(Clone, Copy, Debug)]
pub struct Basis {
    pub right: DVec3,
    pub up: DVec3,
    pub forward: DVec3,
}

impl Camera {
    /// A camera on a sphere about the origin: `azimuth` turns about +y from +z towards +x, `elevation` lifts
    /// towards +y, both in degrees.
    pub fn orbit(azimuth: f64, elevation: f64, distance: f64, fov_y: f64) -> Self {
        let (a, e) = (azimuth.to_radians(), elevation.to_radians());
        let eye = distance * DVec3::new(a.sin() * e.cos(), e.sin(), a.cos() * e.cos());
        Self { eye, target: DVec3::ZERO, up: DVec3::Y, fov_y, height: None }
    }

    /// The same, turned about the axis `up` through the target by so many degrees.
    pub fn turned(self, degrees: f64) -> Self {
        let axis = self.up.normalize_or_zero();
        let turn =
            if axis == DVec3::ZERO { DQuat::IDENTITY } else { DQuat::from_axis_angle(axis, degrees.to_radians()) };
        Self { eye: self.target + turn * (self.eye - self.target), ..self }
    }

    /// The same view of a scene that lies turned in space, told in that scene's own axes: `turn` leads from these to
    /// volume space.
    pub fn in_axes_of(self, turn: DQuat) -> Self {
        if turn == DQuat::IDENTITY {
            return self;
        }
        let back = turn.inverse();
        Self { eye: back * self.eye, target: back * self.target, up: back * self.up, ..self }
    }

    /// # Errors
    /// When the camera has no view direction, `up` lies along it, the field of view is not in (0, 180), or the height is not one.
    pub fn basis(&self) -> Result<Basis> {
        let bad = |problem: String, remedy: &str| Err(Error::usage("camera", problem, remedy));
        if !(self.eye.is_finite() && self.target.is_finite() && self.up.is_finite()) {
            return bad("has a coordinate that is not finite".into(), "give finite numbers for eye, target and up");
        }
        if !FIELDS_OF_VIEW.contains(self.fov_y) {
            return bad(format!("has a field of view of {} degrees", self.fov_y), &FIELDS_OF_VIEW.remedy());
        }
        if let Some(height) = self.height.filter(|height| !PICTURE_HEIGHTS.contains(*height)) {
            return bad(format!("has a picture {height} high"), &PICTURE_HEIGHTS.remedy());
        }
        let Some(forward) = (self.target - self.eye).try_normalize() else {
            return bad(format!("eye and target are both at {}", self.eye), "move one of them");
        };
        let Some(right) = forward
            .cross(self.up)
            .try_normalize()
            .filter(|_| forward.cross(self.up).length() > 1e-9 * self.up.length())
        else {
            return bad(
                format!("`up` {} lies along the view direction", self.up),
                "choose another `up`, --up 0,0,1 for example",
            );
        };
        Ok(Basis { right, up: right.cross(forward), forward })
    }

    /// The rays through the pixels of a `size` = [width, height] image.
    ///
    /// # Errors
    /// As [`Camera::basis`].
    pub fn rays(&self, size: [u32; 2]) -> Result<ViewRays> {
        let basis = self.basis()?;
        let pixel = 2.0 * self.half_height() / f64::from(size[1]);
        let right = basis.right * pixel;
        let down = -basis.up * pixel;
        let (base, near) = (basis.forward, NEAR);
        let corner = |middle: DVec3| middle - right * (0.5 * f64::from(size[0])) - down * (0.5 * f64::from(size[1]));
        Ok(match self.height {
            None => ViewRays { lens: Lens::Perspective, origin: self.eye, base: corner(base), right, down, near },
            Some(_) => ViewRays { lens: Lens::Orthographic, origin: corner(self.eye), base, right, down, near },
        })
    }

    /// Half the height of what the picture shows, in volume units: in perspective of what lies at depth 1.
    pub fn half_height(&self) -> f64 {
        self.height.map_or_else(|| (0.5 * self.fov_y.to_radians()).tan(), |height| 0.5 * height)
    }
}
