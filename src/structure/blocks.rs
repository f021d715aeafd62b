//! Blocks of 8^3 cells with the range of their values, and the table that says which ranges are visible [KW03 §2.3].
//!
//! Departure: a block's range is taken over the 9^3 voxels that its cells interpolate. Trilinear filtering reaches the
//! first voxels of the next block, and a range without them misses a thin wall on a seam.

use super::ranges::{ROUNDING, ranges};
use crate::projection::Shown;
use crate::scene::Field;

/// Cells along a side of a block.
pub const BLOCK: usize = 8;

/// Codes of the quantised scalar range [0, 1].
pub const CODES: usize = 256;

/// Relative slack of [`range_codes`]: c / 255, rounded to f32 and multiplied by 255 again, may miss c by a little less.
const CODE_ROUNDING: f32 = 1.0 / (1 << 22) as f32;

/// A range of x as 8-bit codes, `(low, high)`, rounded outwards; c / 255 itself becomes c. Values outside [0, 1] are
/// clamped. In f32 throughout, as on a device.
pub fn range_codes(min: f32, max: f32) -> (u8, u8) {
    // Casts from float to u8 saturate.
    let low = (min * 255.0 * (1.0 + CODE_ROUNDING)).floor() as u8;
    let high = (max * 255.0 * (1.0 - CODE_ROUNDING)).ceil() as u8;
    (low, high)
}

/// CT [KW03 §2.3]: `CODES` x `CODES` entries, `[high code][low code]`, 1 where anything shows in a range
/// with these codes, interpolation's rounding included. Entries with low above high are 0.
///
/// Code 0 stands for everything up to 0 and code 255 for everything from 1 on. Where what shows
/// changes within [0, 1] only, the clamped value says the same; else the whole outside is asked.
pub fn visibility_table(shown: &Shown) -> Vec<u8> {
    let [first, last] = shown.turns();
    let (open_below, open_above) = (first < 0.0, last > 1.0);
    let mut table = vec![0; CODES * CODES];
    for high in 0..CODES {
        for low in 0..=high {
            let (mut from, mut to) = (low as f64 / 255.0, high as f64 / 255.0);
            // `to` is the larger magnitude. A range of code 0 alone stays the one value 0.
            let slack = f64::from(ROUNDING) * to;
            from = if low == 0 && open_below { f64::NEG_INFINITY } else { from - slack };
            to = if high == CODES - 1 && open_above { f64::INFINITY } else { to + slack };
            table[high * CODES + low] = u8::from(shown.anywhere(from, to));
        }
    }
    table
}

/// What `rc-block` looks up: the range of every block and the table CT, as the GPU has them.
#[derive(Clone, Debug)]
pub struct Blocks {
    dims: [usize; 3],
    ranges: Vec<[f32; 2]>,
    table: Vec<u8>,
}

impl Blocks {
    pub fn build(field: &Field, shown: &Shown) -> Self {
        let (dims, ranges) = ranges(field, BLOCK);
        Self { dims, ranges, table: visibility_table(shown) }
    }

    /// Blocks along each side of a volume.
    pub fn dims(field: &Field) -> [usize; 3] {
        field.cells().map(|cells| cells.div_ceil(BLOCK))
    }

    /// Whether anything may show in the blocks from that of one cell to that of another, those in the corners between
    /// them included.
    pub fn visible_between(&self, from: [usize; 3], to: [usize; 3]) -> bool {
        let along = |axis: usize| {
            let (a, b) = (from[axis] / BLOCK, to[axis] / BLOCK);
            (a.min(b)..=a.max(b)).map(|block| block * BLOCK)
        };
        along(2).any(|z| along(1).any(|y| along(0).any(|x| self.visible([x, y, z]))))
    }

    /// Whether anything may show in the block of `cell`.
    pub fn visible(&self, cell: [usize; 3]) -> bool {
        let [x, y, z] = cell.map(|c| c / BLOCK);
        let [min, max] = self.ranges[(z * self.dims[1] + y) * self.dims[0] + x];
        let (low, high) = range_codes(min, max);
        self.table[usize::from(high) * CODES + usize::from(low)] != 0
    }

    pub fn bytes(&self) -> u64 {
        (size_of_val(self.ranges.as_slice()) + self.table.len()) as u64
    }
}
