//! Which cells become interesting, or are so no more, when something else shows.
//!
//! Of codes of 8 bits it is known beforehand for which ranges the answer becomes another one, so that only cells with such a
//! range are looked for, and none where there is none.

use std::ops::RangeInclusive;

use rayon::prelude::*;

use super::cells::{Support, Values, extremes, interesting_where, least, most, unorm8, widened};
use super::grid::Grid;
use crate::scene::Field;

/// Codes of 8 bits.
const CODES: usize = 1 << u8::BITS;

/// The cells of each slab of the same z whose flags are others by `now` than they were by `before`, in their order and numbered x
/// fastest from the slab's first. `flags` are those of before, and `nearest` is as for [`super::cells::interesting`].
pub(super) fn changed(
    field: &Field,
    values: &Values,
    [before, now]: [&Support; 2],
    grid: &Grid,
    nearest: bool,
    flags: &[bool],
) -> Vec<Vec<usize>> {
    let none = || vec![Vec::new(); grid.cells[2]];
    if before == now {
        return none();
    }
    if let Values::Unorm8(codes) = values {
        let Some(pairs) = Pairs::new(before, now) else { return none() };
        if !nearest && grid.cell == 1 {
            return of_codes(field, codes, &pairs);
        }
    }
    let now = interesting_where(field, values, now, grid, nearest);
    let slab = grid.cells[0] * grid.cells[1];
    let slabs = flags.par_chunks_exact(slab).zip(now.par_chunks_exact(slab));
    slabs.map(|(before, now)| (0..slab).filter(|cell| before[*cell] != now[*cell]).collect()).collect()
}

/// Ranges of codes for which something else is said now.
struct Pairs {
    /// By the low end and the high end.
    differ: Vec<bool>,
    /// Within which all low ends are.
    low: RangeInclusive<u8>,
    high: RangeInclusive<u8>,
}

impl Pairs {
    /// None where the same is said of all.
    fn new(before: &Support, now: &Support) -> Option<Self> {
        let mut differ = vec![false; CODES * CODES];
        let mut ends: Option<[[u8; 2]; 2]> = None;
        for low in 0..=u8::MAX {
            for high in low..=u8::MAX {
                let [from, to] = widened(unorm8(low), unorm8(high));
                if before.meets(from, to) != now.meets(from, to) {
                    differ[usize::from(low) * CODES + usize::from(high)] = true;
                    let [lows, highs] = ends.unwrap_or([[low; 2], [high; 2]]);
                    ends = Some([[lows[0].min(low), lows[1].max(low)], [highs[0].min(high), highs[1].max(high)]]);
                }
            }
        }
        ends.map(|[lows, highs]| Self { differ, low: lows[0]..=lows[1], high: highs[0]..=highs[1] })
    }

    /// Whether any of these ranges may be among them, without a branch.
    fn may_have(&self, ranges: impl Iterator<Item = [u8; 2]>) -> bool {
        let [low, high] = [&self.low, &self.high].map(|ends| [*ends.start(), *ends.end()]);
        ranges.fold(false, |any, [from, to]| {
            any | ((low[0] <= from) & (from <= low[1]) & (high[0] <= to) & (to <= high[1]))
        })
    }

    fn has(&self, [low, high]: [u8; 2]) -> bool {
        self.differ[usize::from(low) * CODES + usize::from(high)]
    }
}

/// Cells of one voxel whose ranges of codes are among `pairs`.
fn of_codes(field: &Field, codes: &[u8], pairs: &Pairs) -> Vec<Vec<usize>> {
    let [nx, ny, nz] = field.dims();
    let [cx, cy, cz] = field.cells();
    let hole = |cell: usize| field.holes.as_ref().is_some_and(|holes| holes[cell]);
    let slab = |z: usize| {
        let (mut low, mut high) = (vec![0; nx], vec![0; nx]);
        let row = |y: usize, z: usize| &codes[(z * ny + y) * nx..][..nx];
        let mut found = Vec::new();
        for y in 0..cy {
            let (up, behind) = ((y + 1).min(ny - 1), (z + 1).min(nz - 1));
            extremes([row(y, z), row(up, z), row(y, behind), row(up, behind)], &mut low, &mut high);
            let next = (nx - 1).min(1);
            let columns = low.iter().zip(&low[next..]).zip(high.iter().zip(&high[next..])).take(cx);
            let ranges = columns.map(|((l0, l1), (h0, h1))| [least(*l0, *l1), most(*h0, *h1)]);
            if pairs.may_have(ranges.clone()) {
                let cells = ranges.enumerate().filter(|(_, range)| pairs.has(*range)).map(|(x, _)| y * cx + x);
                found.extend(cells.filter(|cell| !hole(z * cx * cy + cell)));
            }
        }
        found
    };
    (0..cz).into_par_iter().map(slab).collect()
}
