//! Rays of a view in volume space, and where they meet the volume's box.
//!
//! Volume space: the longest side of the volume is 1 and its centre is the origin. A ray's direction has
//! component 1 along the view direction, so its parameter is the depth in front of the eye, in volume units.

use glam::{DMat3, DVec3};

use super::polyhedron::HalfSpace;

/// How the rays of a view lie to each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lens {
    /// All come from the eye: `origin + depth * (base + column * right + row * down)`.
    Perspective,
    /// All go the same way: `origin + column * right + row * down + depth * base`.
    Orthographic,
}

/// The rays of a view, by column and row in pixels, pixel centres at + 0.5, row 0 on top.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ViewRays {
    pub lens: Lens,
    /// Where rays come from: in perspective the eye, else the upper left corner of the picture.
    pub origin: DVec3,
    pub base: DVec3,
    pub right: DVec3,
    pub down: DVec3,
    /// Rays begin at this depth in front of the eye.
    pub near: f64,
}

/// A ray of a view: all `origin + depth * direction`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ViewRay {
    pub origin: DVec3,
    /// With component 1 along the view direction.
    pub direction: DVec3,
}

impl ViewRay {
    /// The place at a depth in front of the eye.
    pub fn at(&self, depth: f64) -> DVec3 {
        self.origin + depth * self.direction
    }
}

impl ViewRays {
    /// The ray through the centre of a pixel.
    pub fn of(&self, column: u32, row: u32) -> ViewRay {
        self.through(f64::from(column) + 0.5, f64::from(row) + 0.5)
    }

    /// The ray through a place of the picture, column and row in pixels.
    pub fn through(&self, column: f64, row: f64) -> ViewRay {
        let &Self { origin, base, right, down, .. } = self;
        match self.lens {
            Lens::Perspective => ViewRay { origin, direction: base + column * right + row * down },
            Lens::Orthographic => ViewRay { origin: origin + column * right + row * down, direction: base },
        }
    }

    /// Whether all rays have one direction.
    pub fn parallel(&self) -> bool {
        self.lens == Lens::Orthographic
    }

    /// The greatest depth of any point of a box, at least that at which rays begin.
    pub fn deepest(&self, least: DVec3, greatest: DVec3) -> f64 {
        let depth = self.to_picture().row(2);
        let corner = DVec3::select(depth.cmpgt(DVec3::ZERO), greatest, least);
        depth.dot(corner - self.origin).max(self.near)
    }

    /// The least depth of any point of a box, at least that at which rays begin.
    pub fn nearest(&self, least: DVec3, greatest: DVec3) -> f64 {
        let depth = self.to_picture().row(2);
        let corner = DVec3::select(depth.cmpgt(DVec3::ZERO), least, greatest);
        depth.dot(corner - self.origin).max(self.near)
    }

    /// What leads from an arm, of a point from `origin`, to its place in the picture: column and row in pixels, both times the depth in
    /// perspective, and the depth.
    pub fn to_picture(&self) -> DMat3 {
        DMat3::from_cols(self.right, self.down, self.base).inverse()
    }
}

/// The depths between which a ray lies inside the box [-half, half] and beyond `near`.
pub fn box_interval(ray: &ViewRay, half: DVec3, near: f64) -> Option<(f64, f64)> {
    let &ViewRay { origin, direction } = ray;
    let mut enter = near;
    let mut leave = f64::INFINITY;
    for axis in 0..3 {
        if direction[axis] == 0.0 {
            if origin[axis].abs() > half[axis] {
                return None;
            }
            continue;
        }
        let a = (-half[axis] - origin[axis]) / direction[axis];
        let b = (half[axis] - origin[axis]) / direction[axis];
        enter = enter.max(a.min(b));
        leave = leave.min(a.max(b));
    }
    (enter < leave).then_some((enter, leave))
}

/// The same of the part of the box that lies in all of these half spaces.
pub fn cut_interval(ray: &ViewRay, half: DVec3, near: f64, spaces: &[HalfSpace]) -> Option<(f64, f64)> {
    let (mut enter, mut leave) = box_interval(ray, half, near)?;
    for space in spaces {
        let (height, rise) = (space.height(ray.origin), space.normal.dot(ray.direction));
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
