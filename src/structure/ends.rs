//! Where a code of 8 bits is the least or the greatest of a cell, so that cells are found again whose ranges of codes are among some
//! without a look at all others: for each slab of cells of the same z, stretches of its rows by each code.

use rayon::prelude::*;

use super::cells::{extremes, least, most};
use crate::scene::Field;

/// Codes of 8 bits.
pub(super) const CODES: usize = 1 << u8::BITS;

/// Cells of a row that are found together.
const STRETCH: usize = 64;

/// Ranges of codes, whether each is among them, by the low end and then the high end.
pub(super) type Ranges = [[bool; CODES]; CODES];

/// The ends of the ranges of all cells of one voxel.
pub(super) struct Ends {
    slabs: Vec<Slab>,
    /// Stretches of a row.
    stretches: usize,
}

/// The stretches of a slab, 64 to a word, for each code as a least one, and after these as a greatest.
struct Slab {
    words: Vec<u64>,
    /// Words of a code.
    length: usize,
}

impl Ends {
    /// `codes` are those of the field's voxels.
    pub fn new(field: &Field, codes: &[u8]) -> Self {
        let [cx, cy, cz] = field.cells();
        let stretches = cx.div_ceil(STRETCH);
        let length = (stretches * cy).div_ceil(u64::BITS as usize);
        let slab = |z: usize| {
            let mut words = vec![0; 2 * CODES * length];
            let mut rows = Rows::new(field, codes);
            for y in 0..cy {
                for stretch in 0..stretches {
                    let number = y * stretches + stretch;
                    let (word, bit) = (number / u64::BITS as usize, 1 << (number % u64::BITS as usize));
                    for [low, high] in rows.ranges([y, z], stretch) {
                        words[usize::from(low) * length + word] |= bit;
                        words[(CODES + usize::from(high)) * length + word] |= bit;
                    }
                }
            }
            Slab { words, length }
        };
        Self { slabs: (0..cz).into_par_iter().map(slab).collect(), stretches }
    }

    /// The cells of each slab whose ranges are among some, in their order and numbered x fastest from the slab's first. `field` and
    /// `codes` are those of before.
    pub fn cells_of(&self, ranges: &Ranges, field: &Field, codes: &[u8]) -> Vec<Vec<usize>> {
        let [cx, _, _] = field.cells();
        let ends = covering(ranges);
        let slab = |(z, slab): (usize, &Slab)| {
            let mut rows = Rows::new(field, codes);
            let mut found = Vec::new();
            for number in slab.stretches_of(&ends) {
                let (y, stretch) = (number / self.stretches, number % self.stretches);
                let begin = y * cx + stretch * STRETCH;
                let cells = (begin..).zip(rows.ranges([y, z], stretch));
                let among = cells.filter(|(_, [low, high])| ranges[usize::from(*low)][usize::from(*high)]);
                found.extend(among.map(|(cell, _)| cell));
            }
            found
        };
        self.slabs.par_iter().enumerate().map(slab).collect()
    }
}

impl Slab {
    /// The numbers of the stretches with any of some ends, which are numbered as here.
    fn stretches_of(&self, ends: &[usize]) -> impl Iterator<Item = usize> {
        let mut any = vec![0u64; self.length];
        for end in ends {
            any.iter_mut().zip(&self.words[end * self.length..]).for_each(|(any, word)| *any |= word);
        }
        let bits = u64::BITS as usize;
        any.into_iter().enumerate().flat_map(move |(word, any)| {
            (0..bits).filter(move |bit| any >> bit & 1 > 0).map(move |bit| word * bits + bit)
        })
    }
}

/// Ends of which every range among some has one: codes as least ones, and as greatest ones after these. Of the two of a range, it is
/// the one that more of them share.
fn covering(ranges: &Ranges) -> Vec<usize> {
    let mut shared = [0u32; 2 * CODES];
    let all = || (0..CODES).flat_map(|low| (low..CODES).map(move |high| [low, high]));
    let among = || all().filter(|[low, high]| ranges[*low][*high]);
    for [low, high] in among() {
        shared[low] += 1;
        shared[CODES + high] += 1;
    }
    let mut taken = [false; 2 * CODES];
    for [low, high] in among() {
        let end = if shared[low] > shared[CODES + high] { low } else { CODES + high };
        taken[end] = true;
    }
    (0..2 * CODES).filter(|end| taken[*end]).collect()
}

/// The ranges of the cells of a row, as they are asked for.
struct Rows<'a> {
    codes: &'a [u8],
    dims: [usize; 3],
    cells: usize,
    low: [u8; STRETCH + 1],
    high: [u8; STRETCH + 1],
}

impl<'a> Rows<'a> {
    fn new(field: &Field, codes: &'a [u8]) -> Self {
        let zeros = [0; STRETCH + 1];
        Self { codes, dims: field.dims(), cells: field.cells()[0], low: zeros, high: zeros }
    }

    /// The least and the greatest code of each cell of a stretch of the row.
    fn ranges(&mut self, [y, z]: [usize; 2], stretch: usize) -> impl Iterator<Item = [u8; 2]> {
        let [nx, ny, nz] = self.dims;
        let begin = stretch * STRETCH;
        let cells = STRETCH.min(self.cells - begin);
        let voxels = (cells + 1).min(nx - begin);
        let row = |y: usize, z: usize| &self.codes[(z * ny + y) * nx + begin..][..voxels];
        let (up, behind) = ((y + 1).min(ny - 1), (z + 1).min(nz - 1));
        let (low, high) = (&mut self.low[..voxels], &mut self.high[..voxels]);
        extremes([row(y, z), row(up, z), row(y, behind), row(up, behind)], low, high);
        // A volume of one voxel along x has cells without a second one.
        let next = (voxels - 1).min(1);
        let columns = low.iter().zip(&low[next..]).zip(high.iter().zip(&high[next..])).take(cells);
        columns.map(|((l0, l1), (h0, h1))| [least(*l0, *l1), most(*h0, *h1)])
    }
}
