//! Tiles of pixels whose rays may come to something that shows: all others need no fragment.

use glam::DVec3;

use super::region::Region;
use crate::math::ray::ViewRays;

/// Pixels along a side of a tile.
const SIDE: u32 = 8;

/// Pixels that a box counts as larger on each side: rays are rounded where single precision has them.
const MARGIN: f64 = 1.0;

/// The live tiles of a view, counted from the first pixel of its region.
#[derive(Clone, Debug, PartialEq)]
pub struct Tiles {
    region: Region,
    /// Tiles in a row.
    columns: u32,
    /// A flag a tile, row after row.
    live: Vec<bool>,
    /// Clip coordinates x, y, w of the corners of triangles that cover live tiles, each pixel once.
    pub corners: Vec<[f32; 3]>,
}

impl Tiles {
    /// The tiles that any of the boxes may be seen in, which are given by two corners in volume space; none where that is no tile at all.
    pub fn around(
        rays: &ViewRays,
        size: [u32; 2],
        region: Region,
        boxes: impl Iterator<Item = [DVec3; 2]>,
    ) -> Option<Self> {
        let [columns, rows] = region.size().map(|pixels| pixels.div_ceil(SIDE));
        let live = vec![false; columns as usize * rows as usize];
        let mut tiles = Self { region, columns, live, corners: Vec::new() };
        let pixels = rays.to_picture();
        for [least, greatest] in boxes {
            let corner = |i: usize| {
                let pick = |axis: usize| if i >> axis & 1 == 0 { least[axis] } else { greatest[axis] };
                pixels * (DVec3::new(pick(0), pick(1), pick(2)) - rays.origin)
            };
            let placed: [DVec3; 8] = std::array::from_fn(corner);
            if !rays.parallel() && placed.iter().any(|place| place.z < rays.near) {
                // Some of it is beside the eye or behind it, and may show anywhere.
                tiles.live.fill(true);
                break;
            }
            let place = |of: DVec3| if rays.parallel() { [of.x, of.y] } else { [of.x / of.z, of.y / of.z] };
            tiles.add(placed.map(place));
        }
        tiles.live.contains(&true).then(|| {
            let corners = tiles.rectangles().into_iter().flat_map(|rectangle| corners(rectangle, size)).collect();
            Self { corners, ..tiles }
        })
    }

    /// Tiles that the rectangle around places of the picture reaches are live.
    fn add(&mut self, places: [[f64; 2]; 8]) {
        let origin = [self.region.x, self.region.y];
        let rows = self.live.len() as u32 / self.columns;
        let [across, down] = [(0, self.columns), (1, rows)].map(|(axis, tiles)| {
            let tile = |pixel: f64| (pixel - f64::from(origin[axis])) / f64::from(SIDE);
            let low = places.iter().map(|place| place[axis]).fold(f64::INFINITY, f64::min);
            let high = places.iter().map(|place| place[axis]).fold(f64::NEG_INFINITY, f64::max);
            // The casts saturate.
            tile(low - MARGIN).floor() as u32..(tile(high + MARGIN).ceil() as u32).min(tiles)
        });
        for row in down {
            let first = (row * self.columns) as usize;
            let [begin, end] = [across.start, across.end].map(|column| first + column as usize);
            self.live[begin.min(end)..end].fill(true);
        }
    }

    /// Whether the tile of a pixel, column and row of the picture, is live.
    pub fn contains(&self, [column, row]: [u32; 2]) -> bool {
        let tile = |pixel: u32, first: u32| (pixel - first) / SIDE;
        let at = || tile(row, self.region.y) * self.columns + tile(column, self.region.x);
        self.region.contains([column, row]) && self.live[at() as usize]
    }

    /// Live tiles, those of a row that touch as one, up to the end of the region.
    fn rectangles(&self) -> Vec<Region> {
        let mut found: Vec<Region> = Vec::new();
        for (i, _) in self.live.iter().enumerate().filter(|(_, live)| **live) {
            let [column, row] = [i as u32 % self.columns, i as u32 / self.columns];
            let (x, y) = (self.region.x + column * SIDE, self.region.y + row * SIDE);
            let width = SIDE.min(self.region.columns().end - x);
            match found.last_mut() {
                Some(before) if before.y == y && before.columns().end == x => before.width += width,
                _ => found.push(Region { x, y, width, height: SIDE.min(self.region.rows().end - y) }),
            }
        }
        found
    }
}

/// Two triangles that cover a rectangle of a picture of that size.
fn corners(of: Region, size: [u32; 2]) -> [[f32; 3]; 6] {
    let clip = |pixel: u32, axis: usize| (2.0 * f64::from(pixel) / f64::from(size[axis]) - 1.0) as f32;
    let [left, right] = [of.columns().start, of.columns().end].map(|column| clip(column, 0));
    let [top, bottom] = [of.rows().start, of.rows().end].map(|row| clip(row, 1));
    [[left, top], [right, top], [left, bottom], [right, top], [right, bottom], [left, bottom]].map(|[x, y]| [x, y, 1.0])
}
