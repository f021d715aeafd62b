//! Rays of a view in volume space, and where they meet the volume's box.
//!
//! Volume space: the longest side of the volume is 1 and its centre is the origin. A ray's direction has
//! component 1 along the view direction, so its parameter is the depth in front of the eye, in volume units.

use glam::DVec3;

use super::polyhedron::HalfSpace;

/// The rays of a view: `eye + depth * (base + column * right + row * down)`, with column and row in pixels,
/// pixel centres at + 0.5, row 0 on top.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ViewRays {
    pub eye: DVec3,
    pub base: DVec3,
    pub right: DVec3,
    pub down: DVec3,
    /// Rays begin at this depth in front of the eye.
    pub near: f64,
}

impl ViewRays {
    /// Direction through the centre of the pixel, with component 1 along the view direction.
    pub fn direction(&self, column: u32, row: u32) -> DVec3 {
        self.base + (f64::from(column) + 0.5) * self.right + (f64::from(row) + 0.5) * self.down
    }
}

/// The depths between which `eye + depth * direction` lies inside the box [-half, half] and beyond `near`.
pub fn box_interval(eye: DVec3, direction: DVec3, half: DVec3, near: f64) -> Option<(f64, f64)> {
    let mut enter = near;
    let mut leave = f64::INFINITY;
    for axis in 0..3 {
        if direction[axis] == 0.0 {
            if eye[axis].abs() > half[axis] {
                return None;
            }
            continue;
        }
        let a = (-half[axis] - eye[axis]) / direction[axis];
        let b = (half[axis] - eye[axis]) / direction[axis];
        enter = enter.max(a.min(b));
        leave = leave.min(a.max(b));
    }
    (enter < leave).then_some((enter, leave))
}

/// The same of the part of the box that lies in all of these half spaces.
pub fn cut_interval(eye: DVec3, direction: DVec3, half: DVec3, near: f64, spaces: &[HalfSpace]) -> Option<(f64, f64)> {
    let (mut enter, mut leave) = box_interval(eye, direction, half, near)?;
    for space in spaces {
        let (height, rise) = (space.height(eye), space.normal.dot(direction));
        if rise > 0.0 {
            enter = enter.max(-height / rise);
        } else if rise < 0.0 {
            leave = leave.min(-height / rise);
        } else if height < 0.0 {
            return None;
        }
    }
    (enter < leave).then_some((enter, leave))
}
