//! Sets of tiles of pixels, and the rectangles that draw them.

use std::ops::Range;

use super::region::Region;

/// Pixels along a side of a tile.
pub const SIDE: u32 = 8;

/// Some of the tiles of a rectangle of pixels.
#[derive(Clone, Debug, PartialEq)]
pub struct TileSet {
    /// Pixels of the rectangle.
    size: [u32; 2],
    /// Tiles in a row.
    columns: usize,
    /// A flag a tile, row after row.
    flags: Vec<bool>,
}

impl TileSet {
    /// None of the tiles of a rectangle of so many pixels.
    pub fn none(size: [u32; 2]) -> Self {
        let [columns, rows] = size.map(|pixels| pixels.div_ceil(SIDE) as usize);
        // No row is empty; without pixels there are none.
        Self { size, columns: columns.max(1), flags: vec![false; columns * rows] }
    }

    /// Adds the tiles of some columns and rows of tiles, beyond which there may be none.
    pub fn add(&mut self, [columns, rows]: &[Range<usize>; 2]) {
        let columns = columns.start.min(self.columns)..columns.end.min(self.columns);
        for row in self.flags.chunks_exact_mut(self.columns).take(rows.end).skip(rows.start) {
            row[columns.clone()].fill(true);
        }
    }

    /// Adds the tiles of another set of the same.
    pub fn join(&mut self, other: &Self) {
        self.flags.iter_mut().zip(&other.flags).for_each(|(flag, other)| *flag |= other);
    }

    /// Whether it has the tile of a pixel.
    pub fn contains(&self, [column, row]: [u32; 2]) -> bool {
        let at = (row / SIDE) as usize * self.columns + (column / SIDE) as usize;
        column < self.size[0] && row < self.size[1] && self.flags[at]
    }

    /// Fills bands of rows from their first tile to their last, so that the pixels and the draws of all bands take the least time, a draw
    /// that of so many pixels.
    pub fn fill_bands(&mut self, draw: u64) {
        let rows: Vec<Option<[usize; 2]>> = self.flags.chunks_exact(self.columns).map(live_columns).collect();
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
                for row in self.flags.chunks_exact_mut(self.columns).take(end).skip(first) {
                    row[from..to].fill(true);
                }
            }
            end = first;
        }
    }

    /// Rectangles that cover its tiles, each pixel once: those of a row that touch as one, and with those below that have the same columns.
    pub fn rectangles(&self) -> Vec<Region> {
        let [width, height] = self.size;
        let mut found: Vec<Region> = Vec::new();
        for (row, flags) in self.flags.chunks_exact(self.columns).enumerate() {
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
