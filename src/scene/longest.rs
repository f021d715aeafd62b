//! The longest ray of a view, by branch and bound: a picture of 65535 x 65535 pixels costs some ten thousand rays, not
//! four thousand million.
//!
//! For all pixels of a tile the direction's components lie between those of its corners, and so do the depths at which
//! rays enter and leave each slab of the box, and meet each clip plane. A tile whose bound is no longer than a ray already found is left out;
//! the others are cut in four.

use glam::DVec3;

use super::region::Region;
use crate::math::polyhedron::HalfSpace;
use crate::math::ray::{ViewRays, cut_interval};

/// Tiles of at most so many pixels are gone through one by one.
const FEW: u64 = 16;
/// Relative slack of bounds: some dozen roundings of f64, so that none hides a longer ray.
const ROUNDING: f64 = 1e-14;

/// What rays are inside of.
struct Solid<'a> {
    rays: &'a ViewRays,
    half: DVec3,
    planes: &'a [HalfSpace],
}

/// Length of the longest ray through the pixels of `region` inside the box [-half, half] and all half spaces of `planes`, 0
/// where none meets that.
pub fn longest_ray(rays: &ViewRays, half: DVec3, planes: &[HalfSpace], region: Region) -> f64 {
    let solid = Solid { rays, half, planes };
    let mut longest = 0.0;
    let mut tiles = vec![(f64::INFINITY, region)];
    while let Some((bound, tile)) = tiles.pop() {
        if bound <= longest || tile.pixels() == 0 {
            continue;
        }
        if tile.pixels() <= FEW {
            let pixels = tile.rows().flat_map(|row| tile.columns().map(move |column| (column, row)));
            longest = pixels.map(|(column, row)| solid.length(column, row)).fold(longest, f64::max);
            continue;
        }
        let mut quarters = quarters(tile).map(|quarter| (solid.bound_of(quarter), quarter));
        // The most promising one on top.
        quarters.sort_by(|a, b| a.0.total_cmp(&b.0));
        tiles.extend(quarters);
    }
    longest
}

fn quarters(tile: Region) -> [Region; 4] {
    let (left, top) = (tile.width / 2, tile.height / 2);
    let [right, bottom] = [tile.width - left, tile.height - top];
    let part = |x, y, width, height| Region { x: tile.x + x, y: tile.y + y, width, height };
    [part(0, 0, left, top), part(left, 0, right, top), part(0, top, left, bottom), part(left, top, right, bottom)]
}

impl Solid<'_> {
    fn length(&self, column: u32, row: u32) -> f64 {
        let direction = self.rays.direction(column, row);
        cut_interval(self.rays.eye, direction, self.half, self.rays.near, self.planes)
            .map_or(0.0, |(enter, leave)| (leave - enter) * direction.length())
    }

    /// No ray through a pixel of the tile is longer than this.
    fn bound_of(&self, tile: Region) -> f64 {
        if tile.pixels() == 0 {
            return 0.0;
        }
        let (right, bottom) = (tile.x + tile.width - 1, tile.y + tile.height - 1);
        let corners = [(tile.x, tile.y), (right, tile.y), (tile.x, bottom), (right, bottom)];
        let directions = corners.map(|(column, row)| self.rays.direction(column, row));
        // The length of a vector is convex, so it is greatest at a corner.
        let steepest = directions.iter().map(|d| d.length()).fold(0.0, f64::max);
        let slack = ROUNDING * steepest;
        let (mut enter, mut leave) = (self.rays.near, f64::INFINITY);
        for axis in 0..3 {
            let [low, high] = spread(directions.map(|d| d[axis]), slack);
            if low <= 0.0 && high >= 0.0 {
                // Some ray may run along the slab: it bounds nothing.
                continue;
            }
            let faces = [-self.half[axis] - self.rays.eye[axis], self.half[axis] - self.rays.eye[axis]];
            let depths = faces.map(|face| [face / low, face / high]);
            let [first, last] = spread(depths.as_flattened().iter().copied(), 0.0);
            (enter, leave) = (enter.max(first), leave.min(last));
        }
        for plane in self.planes {
            let [low, high] = spread(directions.map(|d| plane.normal.dot(d)), slack * plane.normal.length());
            let height = plane.height(self.rays.eye);
            let [first, last] = spread([-height / low, -height / high], 0.0);
            if low > 0.0 {
                enter = enter.max(first);
            } else if high < 0.0 {
                leave = leave.min(last);
            }
        }
        let slack = ROUNDING * (enter.abs() + leave.abs());
        ((leave - enter) + slack).max(0.0) * steepest * (1.0 + ROUNDING)
    }
}

/// The least and the greatest of some numbers, apart by as much more on each side.
fn spread(numbers: impl IntoIterator<Item = f64>, slack: f64) -> [f64; 2] {
    let ends = [f64::INFINITY, f64::NEG_INFINITY];
    let [low, high] = numbers.into_iter().fold(ends, |[low, high], number| [low.min(number), high.max(number)]);
    [low - slack, high + slack]
}
