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
    flags: Vec<bool>,
    /// Rectangles that cover live tiles, each pixel once, from the first pixel of the region.
    live: Vec<Region>,
}

impl Tiles {
    /// The tiles of a region that any of the boxes may be seen in, which are given by two corners in volume space. Where a draw takes as long as
    /// so many pixels, live tiles are those of few rectangles around them.
    pub fn around(rays: &ViewRays, region: Region, boxes: impl Iterator<Item = [DVec3; 2]>, draw: Option<u64>) -> Self {
        let [columns, rows] = region.size().map(|pixels| pixels.div_ceil(SIDE));
        let flags = vec![false; columns as usize * rows as usize];
        let mut tiles = Self { region, columns, flags, live: Vec::new() };
        if tiles.flags.is_empty() {
            return tiles;
        }
        let pixels = rays.to_picture();
        for [least, greatest] in boxes {
            let corner = |i: usize| {
                let pick = |axis: usize| if i >> axis & 1 == 0 { least[axis] } else { greatest[axis] };
                pixels * (DVec3::new(pick(0), pick(1), pick(2)) - rays.origin)
            };
            let placed: [DVec3; 8] = std::array::from_fn(corner);
            if !rays.parallel() && placed.iter().any(|place| place.z < rays.near) {
                // Some of it is beside the eye or behind it, and may show anywhere.
                tiles.flags.fill(true);
                break;
            }
            let place = |of: DVec3| if rays.parallel() { [of.x, of.y] } else { [of.x / of.z, of.y / of.z] };
            tiles.add(placed.map(place));
        }
        if let Some(draw) = draw {
            tiles.fill_bands(draw);
        }
        Self { live: tiles.rectangles(), ..tiles }
    }

    /// Rectangles that cover live tiles, each pixel once, from the first pixel of the region.
    pub fn live(&self) -> &[Region] {
        &self.live
    }

    /// Tiles that the rectangle around places of the picture reaches are live.
    fn add(&mut self, places: [[f64; 2]; 8]) {
        let origin = [self.region.x, self.region.y];
        let rows = self.flags.len() as u32 / self.columns;
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
            self.flags[begin.min(end)..end].fill(true);
        }
    }

    /// Fills bands of rows from their first live tile to their last, so that the pixels and the draws of all bands take the least time, a draw
    /// that of so many pixels.
    fn fill_bands(&mut self, draw: u64) {
        let rows: Vec<Option<[usize; 2]>> = self.flags.chunks_exact(self.columns as usize).map(live_columns).collect();
        // The least of what the rows before each one take, and where the last band of it begins; none where that row is empty.
        let mut least: Vec<(u64, Option<usize>)> = vec![(0, None)];
        for (last, row) in rows.iter().enumerate() {
            let mut best = (if row.is_some() { u64::MAX } else { least[last].0 }, None);
            let mut band: Option<[usize; 2]> = None;
            for first in (0..=last).rev().take_while(|_| row.is_some()) {
                band = joined(band, rows[first]);
                let wide = band.map_or(0, |[begin, end]| end - begin);
                let tiles = (wide * (last + 1 - first)) as u64;
                let all = least[first].0 + draw + tiles * u64::from(SIDE * SIDE);
                best = if all < best.0 { (all, Some(first)) } else { best };
            }
            least.push(best);
        }
        let mut end = rows.len();
        while end > 0 {
            let Some(first) = least[end].1 else {
                end -= 1;
                continue;
            };
            if let Some([from, to]) = rows[first..end].iter().fold(None, |band, row| joined(band, *row)) {
                for row in self.flags.chunks_exact_mut(self.columns as usize).take(end).skip(first) {
                    row[from..to].fill(true);
                }
            }
            end = first;
        }
    }

    /// Whether the tile of a pixel, column and row of the picture, is live.
    pub fn contains(&self, [column, row]: [u32; 2]) -> bool {
        let tile = |pixel: u32, first: u32| (pixel - first) / SIDE;
        let at = || tile(row, self.region.y) * self.columns + tile(column, self.region.x);
        self.region.contains([column, row]) && self.flags[at() as usize]
    }

    /// Live tiles, those of a row that touch as one, and with those below that have the same columns.
    fn rectangles(&self) -> Vec<Region> {
        let [width, height] = self.region.size();
        let mut found: Vec<Region> = Vec::new();
        for (row, flags) in self.flags.chunks_exact(self.columns as usize).enumerate() {
            let y = row as u32 * SIDE;
            let height = SIDE.min(height - y);
            let tile = |column: usize| column as u32 * SIDE;
            for run in flags.iter().enumerate().collect::<Vec<_>>().chunk_by(|a, b| a.1 == b.1).filter(|run| *run[0].1)
            {
                let (x, end) = (tile(run[0].0), tile(run[0].0 + run.len()).min(width));
                let above =
                    found.iter_mut().find(|above| (above.x, above.columns().end, above.rows().end) == (x, end, y));
                match above {
                    Some(above) => above.height += height,
                    None => found.push(Region { x, y, width: end - x, height }),
                }
            }
        }
        found
    }
}

/// From the first live tile of a row to one past the last.
fn live_columns(row: &[bool]) -> Option<[usize; 2]> {
    Some([row.iter().position(|live| *live)?, row.iter().rposition(|live| *live)? + 1])
}

fn joined(one: Option<[usize; 2]>, other: Option<[usize; 2]>) -> Option<[usize; 2]> {
    match (one, other) {
        (Some([a, b]), Some([c, d])) => Some([a.min(c), b.max(d)]),
        (one, other) => one.or(other),
    }
}
