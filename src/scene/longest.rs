//! The longest ray of a view, by branch and bound: a picture of 65535 x 65535 pixels costs some ten thousand rays, not
//! four thousand million.
//!
//! For all pixels of a tile the direction's components lie between those of its corners, and so do the depths at which
//! rays enter and leave each slab of the box. A tile whose bound is no longer than a ray already found is left out;
//! the others are cut in four.

use glam::DVec3;

use super::region::Region;
use crate::math::ray::{ViewRays, box_interval};

/// Tiles of at most so many pixels are gone through one by one.
const FEW: u64 = 16;
/// Relative slack of bounds: some dozen roundings of f64, so that none hides a longer ray.
const ROUNDING: f64 = 1e-14;

/// Length of the longest ray through the pixels of `region` inside the box [-half, half], 0 where none meets it.
pub fn longest_ray(rays: &ViewRays, half: DVec3, region: Region) -> f64 {
    let mut longest = 0.0;
    let mut tiles = vec![(f64::INFINITY, region)];
    while let Some((bound, tile)) = tiles.pop() {
        if bound <= longest || tile.pixels() == 0 {
            continue;
        }
        if tile.pixels() <= FEW {
            let lengths = tile.rows().flat_map(|row| tile.columns().map(move |column| length(rays, half, column, row)));
            longest = lengths.fold(longest, f64::max);
            continue;
        }
        let mut quarters = quarters(tile).map(|quarter| (bound_of(rays, half, quarter), quarter));
        // The most promising one on top.
        quarters.sort_by(|a, b| a.0.total_cmp(&b.0));
        tiles.extend(quarters);
    }
    longest
}

fn length(rays: &ViewRays, half: DVec3, column: u32, row: u32) -> f64 {
    let direction = rays.direction(column, row);
    box_interval(rays.eye, direction, half, rays.near)
        .map_or(0.0, |(enter, leave)| (leave - enter) * direction.length())
}

fn quarters(tile: Region) -> [Region; 4] {
    let (left, top) = (tile.width / 2, tile.height / 2);
    let [right, bottom] = [tile.width - left, tile.height - top];
    let part = |x, y, width, height| Region { x: tile.x + x, y: tile.y + y, width, height };
    [part(0, 0, left, top), part(left, 0, right, top), part(0, top, left, bottom), part(left, top, right, bottom)]
}

/// No ray through a pixel of the tile is longer than this.
fn bound_of(rays: &ViewRays, half: DVec3, tile: Region) -> f64 {
    if tile.pixels() == 0 {
        return 0.0;
    }
    let (right, bottom) = (tile.x + tile.width - 1, tile.y + tile.height - 1);
    let corners = [(tile.x, tile.y), (right, tile.y), (tile.x, bottom), (right, bottom)];
    let directions = corners.map(|(column, row)| rays.direction(column, row));
    // The length of a vector is convex, so it is greatest at a corner.
    let steepest = directions.iter().map(|d| d.length()).fold(0.0, f64::max);
    let [low, high] = [DVec3::min, DVec3::max]
        .map(|f: fn(DVec3, DVec3) -> DVec3| directions.into_iter().reduce(f).unwrap_or_default());
    let (low, high) = (low - ROUNDING * steepest, high + ROUNDING * steepest);
    let (mut enter, mut leave) = (rays.near, f64::INFINITY);
    for axis in 0..3 {
        if low[axis] <= 0.0 && high[axis] >= 0.0 {
            // Some ray may run along the slab: it bounds nothing.
            continue;
        }
        let faces = [-half[axis] - rays.eye[axis], half[axis] - rays.eye[axis]];
        let depths = faces.map(|face| [face / low[axis], face / high[axis]]);
        let depths = depths.as_flattened().iter().copied();
        enter = enter.max(depths.clone().fold(f64::INFINITY, f64::min));
        leave = leave.min(depths.fold(f64::NEG_INFINITY, f64::max));
    }
    let slack = ROUNDING * (enter.abs() + leave.abs());
    ((leave - enter) + slack).max(0.0) * steepest * (1.0 + ROUNDING)
}
