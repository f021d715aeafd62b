//! Interesting cells, seen through a window: a bit for each cell, whether any of the cells from it on, so and so many
//! along each axis, is interesting. Twin of `glsl/structure/widen.comp`.

use super::grid::Grid;

/// Bits, 32 cells of a row in a word.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Wide {
    cells: [usize; 3],
    words: Vec<u32>,
}

impl Wide {
    /// A window of one cell: the flags themselves, one a cell, x fastest.
    pub fn of(grid: &Grid, interesting: &[bool]) -> Self {
        let word = |bits: &[bool]| bits.iter().enumerate().map(|(i, bit)| u32::from(*bit) << i).sum();
        let words = interesting.chunks_exact(grid.cells[0]).flat_map(|row| row.chunks(32).map(word)).collect();
        Self { cells: grid.cells, words }
    }

    /// The window `by` cells wider on each axis; it may be at most 32 wide.
    pub fn widened(&self, by: usize) -> Self {
        let [nx, ny, nz] = self.cells;
        let in_row = nx.div_ceil(32);
        let row = |y: usize, z: usize| &self.words[(z * ny + y) * in_row..][..in_row];
        let mut words = vec![0; self.words.len()];
        for (at, out) in words.chunks_exact_mut(in_row).enumerate() {
            let (y, z) = (at % ny, at / ny);
            let (up, behind) = ((y + by).min(ny - 1), (z + by).min(nz - 1));
            let rows = [row(y, z), row(up, z), row(y, behind), row(up, behind)];
            let any = |word: usize| rows.iter().map(|row| row.get(word).copied().unwrap_or(0)).fold(0, |a, b| a | b);
            for (word, out) in out.iter_mut().enumerate() {
                let here = any(word);
                *out = here | here >> by | any(word + 1) << (32 - by);
            }
        }
        Self { cells: self.cells, words }
    }

    /// Bits of the `count` (up to 8) cells along x from that one on, which are all in the row.
    pub fn from(&self, [x, y, z]: [usize; 3], count: usize) -> u32 {
        let (word, bit) = ((z * self.cells[1] + y) * self.cells[0].div_ceil(32) + x / 32, x % 32);
        let mut bits = self.words[word] >> bit;
        if bit + count > 32 {
            bits |= self.words[word + 1] << (32 - bit);
        }
        bits & ((1 << count) - 1)
    }

    /// Whether anything in the window from that cell on is interesting.
    pub fn at(&self, [x, y, z]: [usize; 3]) -> bool {
        let word = (z * self.cells[1] + y) * self.cells[0].div_ceil(32) + x / 32;
        self.words[word] >> (x % 32) & 1 != 0
    }
}
