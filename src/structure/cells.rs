//! Which cells are interesting: those whose values reach into what shows.
//!
//! A cell interpolates its 2x2x2 voxels, so its values fill [min, max] of them and what shows is asked over that whole
//! range, never at sample points.

use std::borrow::Cow;

use rayon::prelude::*;

use super::grid::Grid;
use super::ranges::{ROUNDING, ranges_of};
use crate::projection::{Shown, Visible};
use crate::scene::settings::Filter;
use crate::scene::{Field, Scene, TransferFunction};

/// How far a texture unit's value of a code may be from ours, relative: a unit in the last place or two.
pub const CODE_ROUNDING: f32 = 1.0 / (1 << 22) as f32;

/// The range `[low, high]` of a neighbourhood, widened by what interpolation may add. A constant neighbourhood
/// interpolates to itself but for the rounding of its code, and a background of 0 stays 0, invisible where opacity
/// starts there.
#[inline]
pub fn widened(low: f32, high: f32) -> [f32; 2] {
    let relative = if low < high { ROUNDING } else { CODE_ROUNDING };
    let by = (low.abs().max(high.abs()) * relative).max(f32::MIN_POSITIVE);
    let by = if low == 0.0 && high == 0.0 { 0.0 } else { by };
    [low - by, high + by]
}

/// Where anything shows: closed intervals of f32, rising and apart, such that something shows in `[low, high]` exactly when
/// that meets one of them. An end at which opacity starts from 0 is not visible itself; the interval then begins at the next
/// f32.
#[derive(Clone, Debug, PartialEq)]
pub struct Support(Vec<[f32; 2]>);

impl Support {
    pub fn of(shown: &Shown) -> Self {
        let of_transfer = shown.visible.iter().flat_map(|Visible { transfer, slack }| visible(transfer, *slack));
        let mut all: Vec<[f64; 2]> = of_transfer.chain(shown.within.iter().copied()).collect();
        all.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let mut intervals: Vec<[f64; 2]> = Vec::new();
        for [low, high] in all {
            match intervals.last_mut() {
                Some(before) if low <= before[1].next_up() => before[1] = before[1].max(high),
                _ => intervals.push([low, high]),
            }
        }
        // A range of f32 meets an interval exactly when it meets the f32 within; where there is none, `low` ends up
        // above `high` and only ranges across both meet it.
        Self(intervals.into_iter().map(|[low, high]| [at_least(low), at_most(high)]).collect())
    }

    /// The intervals as a device may have them: one that begins just above 0 begins at the first normal number, since
    /// devices may take smaller ones for 0, and [`widened`] reaches it from all that are not. Where nothing shows, one that
    /// nothing meets.
    pub fn closed(&self) -> Vec<[f32; 2]> {
        if self.0.is_empty() {
            return vec![[f32::INFINITY, f32::NEG_INFINITY]];
        }
        let above = |x: f32| if x > 0.0 { x.max(f32::MIN_POSITIVE) } else { x };
        self.0.iter().map(|[low, high]| [above(*low), -above(-high)]).collect()
    }

    /// Whether anything in `[low, high]` is visible.
    pub fn meets(&self, low: f32, high: f32) -> bool {
        let not_below = self.0.partition_point(|interval| interval[1] < low);
        self.0.get(not_below).is_some_and(|interval| interval[0] <= high)
    }
}

/// Where a transfer function has any opacity, or has within `slack`: closed intervals, rising and apart.
fn visible(transfer: &TransferFunction, slack: f64) -> Vec<[f64; 2]> {
    let knots = transfer.knots();
    let (first, last) = (knots[0], knots[knots.len() - 1]);
    // In f64 first, every number a point: an open interval is a closed one between its inner neighbours.
    let mut closed: Vec<[f64; 2]> = Vec::new();
    let mut put = |low: f64, high: f64| match (closed.last_mut(), [low - slack, high + slack]) {
        (Some(before), [low, high]) if low <= before[1].next_up() => before[1] = before[1].max(high),
        (_, wider) => closed.push(wider),
    };
    if first.opacity > 0.0 {
        put(f64::NEG_INFINITY, first.x);
    }
    for pair in knots.windows(2) {
        if pair[0].opacity > 0.0 {
            put(pair[0].x, pair[0].x);
        }
        let (low, high) = (pair[0].x.next_up(), pair[1].x.next_down());
        if (pair[0].opacity > 0.0 || pair[1].opacity > 0.0) && low <= high {
            put(low, high);
        }
    }
    if last.opacity > 0.0 {
        put(last.x, f64::INFINITY);
    }
    closed
}

/// The least f32 that is not below `x`.
fn at_least(x: f64) -> f32 {
    let rounded = x as f32;
    if f64::from(rounded) < x { rounded.next_up() } else { rounded }
}

/// The largest f32 that is not above `x`.
fn at_most(x: f64) -> f32 {
    -at_least(-x)
}

/// A volume's voxels as a texture holds them: codes of normalised integers, c / (2^bits - 1), or numbers.
#[derive(Clone, Debug, PartialEq)]
pub enum Values<'a> {
    Unorm8(Cow<'a, [u8]>),
    Unorm16(Cow<'a, [u16]>),
    Float(Cow<'a, [f32]>),
}

/// One flag a cell of `grid`, x fastest: whether anything shows among its values, widened by [`ROUNDING`]; with `nearest`,
/// at the value of any of its voxels. Holes are not interesting; larger cells that have some count as what those were
/// filled with. `shown` is said of the texture's values.
pub fn interesting(field: &Field, values: &Values, shown: &Shown, grid: &Grid, nearest: bool) -> Vec<bool> {
    interesting_where(field, values, &Support::of(shown), grid, nearest)
}

/// The flags of [`interesting`], by where anything shows.
pub(super) fn interesting_where(
    field: &Field,
    values: &Values,
    support: &Support,
    grid: &Grid,
    nearest: bool,
) -> Vec<bool> {
    match (values, nearest) {
        (Values::Unorm8(codes), false) => of_values(field, codes, unorm8, support, grid),
        (Values::Unorm16(codes), false) => of_values(field, codes, unorm16, support, grid),
        (Values::Float(values), false) => of_values(field, values, |value| value, support, grid),
        (Values::Unorm8(codes), true) => of_voxels(field, codes, unorm8, support, grid),
        (Values::Unorm16(codes), true) => of_voxels(field, codes, unorm16, support, grid),
        (Values::Float(values), true) => of_voxels(field, values, |value| value, support, grid),
    }
}

pub(super) fn unorm8(code: u8) -> f32 {
    f32::from(code) / 255.0
}

fn unorm16(code: u16) -> f32 {
    f32::from(code) / 65535.0
}

/// Whether any voxel of a cell shows something by itself.
fn of_voxels<T: Copy + Send + Sync>(
    field: &Field,
    codes: &[T],
    value: impl Fn(T) -> f32 + Sync,
    support: &Support,
    grid: &Grid,
) -> Vec<bool> {
    let shows = |code: &T| {
        let [low, high] = widened(value(*code), value(*code));
        support.meets(low, high)
    };
    let shown: Vec<bool> = codes.par_iter().map(shows).collect();
    let (_, ranges) = ranges_of(field.dims(), &shown, grid.cell);
    let mut flags: Vec<bool> = ranges.into_par_iter().map(|[_, any]| any).collect();
    leave_out_holes(field, grid, &mut flags);
    flags
}

/// Cells that are holes are not interesting. Larger ones do not look at them.
fn leave_out_holes(field: &Field, grid: &Grid, flags: &mut [bool]) {
    if let Some(holes) = field.holes.as_ref().filter(|_| grid.cell == 1) {
        flags.par_iter_mut().zip(holes).for_each(|(flag, hole)| *flag &= !hole);
    }
}

/// Whether no cell of the volume is left that shows nothing, so that there is nothing to skip. Stops at the first one.
pub fn all_interesting(scene: &Scene) -> bool {
    let (field, support) = (&scene.field, Support::of(&Shown::in_x(scene)));
    field.holes.is_none() && (0..field.cells().iter().product()).into_par_iter().all(|i| shows(scene, &support, i))
}

/// Whether any cell of the volume shows something. Stops at the first one.
pub fn any_interesting(scene: &Scene) -> bool {
    let (field, support) = (&scene.field, Support::of(&Shown::in_x(scene)));
    let hole = |i: usize| field.holes.as_ref().is_some_and(|holes| holes[i]);
    (0..field.cells().iter().product()).into_par_iter().any(|i| !hole(i) && shows(scene, &support, i))
}

/// Whether anything shows among the values of cell `i`, x fastest.
fn shows(scene: &Scene, support: &Support, i: usize) -> bool {
    let field = &scene.field;
    let [nx, ny, _] = field.cells();
    let corners = field.corners([i % nx, i / nx % ny, i / (nx * ny)]).map(|c| field.values[c]);
    if scene.settings.sampling.filter == Filter::Nearest {
        return corners.into_iter().any(|value| support.meets(value, value));
    }
    let low = corners.into_iter().fold(f32::INFINITY, f32::min);
    let high = corners.into_iter().fold(f32::NEG_INFINITY, f32::max);
    support.meets(low, high)
}

/// `value` rises with the code.
fn of_values<T: Copy + PartialOrd + Send + Sync>(
    field: &Field,
    codes: &[T],
    value: impl Fn(T) -> f32 + Copy + Sync,
    support: &Support,
    grid: &Grid,
) -> Vec<bool> {
    if grid.cell > 1 {
        let (_, ranges) = ranges_of(field.dims(), codes, grid.cell);
        let meets = |[low, high]: [T; 2]| {
            let [low, high] = widened(value(low), value(high));
            support.meets(low, high)
        };
        return ranges.into_par_iter().map(meets).collect();
    }
    let [nx, ny, nz] = field.dims();
    let [cx, cy, cz] = field.cells();
    let mut flags = vec![false; cx * cy * cz];
    let Some(&any) = codes.first() else { return flags };
    flags.par_chunks_mut(cx * cy).enumerate().for_each(|(z, slab)| {
        let mut low = vec![any; nx];
        let mut high = vec![any; nx];
        let row = |y: usize, z: usize| &codes[(z * ny + y) * nx..][..nx];
        for (y, flags) in slab.chunks_exact_mut(cx).enumerate() {
            let (up, behind) = ((y + 1).min(ny - 1), (z + 1).min(nz - 1));
            extremes([row(y, z), row(up, z), row(y, behind), row(up, behind)], &mut low, &mut high);
            row_flags(support, &low, &high, value, flags);
        }
    });
    leave_out_holes(field, grid, &mut flags);
    flags
}

/// The lesser and the greater. Plain comparisons: values are finite, and what `f32::min` does about NaN would cost time.
pub(super) fn least<T: PartialOrd>(a: T, b: T) -> T {
    if a < b { a } else { b }
}

pub(super) fn most<T: PartialOrd>(a: T, b: T) -> T {
    if a > b { a } else { b }
}

/// Minimum and maximum of four rows, place by place.
pub(super) fn extremes<T: Copy + PartialOrd>(rows: [&[T]; 4], low: &mut [T], high: &mut [T]) {
    let n = low.len();
    let [a, b, c, d] = rows.map(|row| &row[..n]);
    let high = &mut high[..n];
    for x in 0..n {
        low[x] = least(least(a[x], b[x]), least(c[x], d[x]));
        high[x] = most(most(a[x], b[x]), most(c[x], d[x]));
    }
}

/// Flags of a row of cells from the extremes of its columns of four voxels.
fn row_flags<T: Copy + PartialOrd>(
    support: &Support,
    low: &[T],
    high: &[T],
    value: impl Fn(T) -> f32,
    flags: &mut [bool],
) {
    let next = (low.len() - 1).min(1);
    let (low_next, high_next) = (&low[next..], &high[next..]);
    let cells = flags.iter_mut().zip(low.iter().zip(low_next).zip(high.iter().zip(high_next)));
    let range = |((l0, l1), (h0, h1)): ((&T, &T), (&T, &T))| widened(value(least(*l0, *l1)), value(most(*h0, *h1)));
    if let [[from, to]] = support.0[..] {
        // The usual case, without branches.
        cells.for_each(|(flag, columns)| {
            let [low, high] = range(columns);
            *flag = (low <= to) & (high >= from);
        });
    } else {
        cells.for_each(|(flag, columns)| {
            let [low, high] = range(columns);
            *flag = support.meets(low, high);
        });
    }
}
