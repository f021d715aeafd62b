//! Which cells become interesting, or are so no more, when something else shows.
//!
//! Of codes of 8 bits it is known beforehand for which ranges the answer becomes another one, so that only cells with such a
//! range are looked for, and none where there is none.

use rayon::prelude::*;

use super::cells::{Support, Values, interesting_where, unorm8, widened};
use super::ends::{CODES, Ends, Ranges};
use super::grid::Grid;
use crate::scene::Field;

/// The cells of each slab of the same z whose flags are others by `now` than they were by `before`, in their order and numbered x
/// fastest from the slab's first. `flags` are those of before, `nearest` is as for
/// [`super::cells::interesting`], and `ends` are those of the values, where these are codes of 8 bits that are judged by ranges.
pub(super) fn changed(
    field: &Field,
    values: &Values,
    [before, now]: [&Support; 2],
    grid: &Grid,
    nearest: bool,
    flags: &[bool],
    ends: Option<&Ends>,
) -> Vec<Vec<usize>> {
    let none = || vec![Vec::new(); grid.cells[2]];
    if before == now {
        return none();
    }
    if let Values::Unorm8(codes) = values {
        let Some(ranges) = other_ranges(before, now) else { return none() };
        if let Some(ends) = ends {
            let mut slabs = ends.cells_of(&ranges, field, codes);
            leave_out_holes(field, grid, &mut slabs);
            return slabs;
        }
    }
    let now = interesting_where(field, values, now, grid, nearest);
    let slab = grid.cells[0] * grid.cells[1];
    let slabs = flags.par_chunks_exact(slab).zip(now.par_chunks_exact(slab));
    slabs.map(|(before, now)| (0..slab).filter(|cell| before[*cell] != now[*cell]).collect()).collect()
}

/// The ranges of codes of which something else is said now; none where the same is said of all.
fn other_ranges(before: &Support, now: &Support) -> Option<Box<Ranges>> {
    let mut ranges = Box::new([[false; CODES]; CODES]);
    let mut any = false;
    for low in 0..=u8::MAX {
        for high in low..=u8::MAX {
            let [from, to] = widened(unorm8(low), unorm8(high));
            let differs = before.meets(from, to) != now.meets(from, to);
            ranges[usize::from(low)][usize::from(high)] = differs;
            any |= differs;
        }
    }
    any.then_some(ranges)
}

/// Holes are not interesting before or now. Cells are by slabs.
fn leave_out_holes(field: &Field, grid: &Grid, slabs: &mut [Vec<usize>]) {
    let Some(holes) = &field.holes else { return };
    let slab = grid.cells[0] * grid.cells[1];
    for (cells, holes) in slabs.iter_mut().zip(holes.chunks(slab)) {
        cells.retain(|cell| !holes[*cell]);
    }
}
