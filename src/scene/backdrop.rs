//! What is behind the volume: a plane across the view, with a checker or a picture [Stegmaier05 §4].
//!
//! The plane lies behind the volume as the eye sees it, and its picture fills the view for rays that go straight. Beside the picture it
//! goes on mirrored. A ray that never comes to the plane sees black.

use glam::DVec3;

use super::environment::Picture;
use crate::math::ray::{Lens, ViewRays};

/// What is on the plane.
#[derive(Clone, Debug, PartialEq)]
pub enum Pattern {
    /// Squares of two greys, so many in the height of the view.
    Checker(f64),
    /// As large as it has to be so that it fills the view, about its middle.
    Picture(Picture),
}

/// A plane behind the volume.
#[derive(Clone, Debug, PartialEq)]
pub struct Backdrop {
    pub pattern: Pattern,
    /// How far it is behind the corner of the volume that is farthest from the eye, in volume units.
    pub distance: f64,
}

/// The greys of a checker, that in the upper left corner of the view first.
pub const GREYS: [f64; 2] = [0.8, 0.2];

/// The greatest number of squares, or of pixels, that a place is told apart by from the middle: beyond it lies too far away to be told.
pub const FARTHEST: f64 = 1e6;

impl Backdrop {
    /// The place of the picture, column and row in pixels of the view, that is met from a `point` along a vector, in volume space; none
    /// where the plane is not in front. `half`: half the sides of the volume.
    pub fn met(&self, rays: &ViewRays, half: DVec3, point: DVec3, way: DVec3) -> Option<[f64; 2]> {
        let across = rays.right.cross(rays.down).normalize();
        let forward = across * across.dot(rays.base).signum();
        let depth = half.dot(forward.abs()) - rays.origin.dot(forward) + self.distance;
        let rise = way.dot(forward);
        if rise <= 0.0 {
            return None;
        }
        let on = point + (depth - (point - rays.origin).dot(forward)) / rise * way;
        let arm = match rays.lens {
            Lens::Perspective => (on - rays.origin) / depth - rays.base,
            Lens::Orthographic => on - rays.origin,
        };
        let place =
            [arm.dot(rays.right) / rays.right.length_squared(), arm.dot(rays.down) / rays.down.length_squared()];
        place.iter().all(|at| at.abs() <= FARTHEST).then_some(place)
    }

    /// The linear colour in a place of a view of that size, column and row in pixels.
    pub fn color(&self, [width, height]: [u32; 2], [column, row]: [f64; 2]) -> [f64; 3] {
        match &self.pattern {
            Pattern::Checker(squares) => {
                let [x, y] = [column, row].map(|at| (at * squares / f64::from(height)).floor());
                [GREYS[(x + y).rem_euclid(2.0) as usize]; 3]
            }
            Pattern::Picture(picture) => {
                let [x, y] = texel_at(picture, [width, height], [column, row]);
                let (low, weight) = ([x.floor(), y.floor()], [x - x.floor(), y - y.floor()]);
                let texel = |right: f64, down: f64| {
                    let at = [mirrored(low[0] + right, picture.size[0]), mirrored(low[1] + down, picture.size[1])];
                    picture.texels[at[1] * picture.size[0] + at[0]].map(f64::from)
                };
                let mix = |a: f64, b: f64, weight: f64| a + weight * (b - a);
                let (above, below) = ([texel(0.0, 0.0), texel(1.0, 0.0)], [texel(0.0, 1.0), texel(1.0, 1.0)]);
                let across = |row: [[f64; 3]; 2], c: usize| mix(row[0][c], row[1][c], weight[0]);
                std::array::from_fn(|c| mix(across(above, c), across(below, c), weight[1]))
            }
        }
    }

    /// How far it is in pixels from a place to the next edge of a square; infinite where there are none.
    pub fn to_edge(&self, height: u32, place: [f64; 2]) -> f64 {
        match self.pattern {
            Pattern::Checker(squares) => {
                let side = f64::from(height) / squares;
                place.map(|at| (at / side - (at / side).round()).abs() * side).into_iter().fold(f64::INFINITY, f64::min)
            }
            Pattern::Picture(_) => f64::INFINITY,
        }
    }
}

/// Pixels of a view in a texel of a picture that fills it.
pub fn pixels_in_texel(picture: &Picture, view: [u32; 2]) -> f64 {
    (0..2).map(|axis| f64::from(view[axis]) / picture.size[axis] as f64).fold(0.0, f64::max)
}

/// The place of a view in a picture that fills it, in texels from the centre of the first one.
fn texel_at(picture: &Picture, view: [u32; 2], place: [f64; 2]) -> [f64; 2] {
    let scale = pixels_in_texel(picture, view);
    std::array::from_fn(|axis| {
        (place[axis] - 0.5 * f64::from(view[axis])) / scale + 0.5 * picture.size[axis] as f64 - 0.5
    })
}

/// The texel in a row of `count` that goes on mirrored at both ends.
fn mirrored(at: f64, count: usize) -> usize {
    let count = count as f64;
    let turn = at.rem_euclid(2.0 * count);
    (if turn < count { turn } else { 2.0 * count - 1.0 - turn }) as usize
}
