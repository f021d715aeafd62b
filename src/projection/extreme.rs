//! `mip` and `minip`: the greatest, or the least, value of a ray [Thesis §3.1.5, Stegmaier05 §6].
//!
//! Rays begin with the least value of the field, and a little more: as much as rounding may add to a cell that holds nothing
//! else. Such a cell raises no ray then, to the bit, and is skipped. Values that come as near to the greatest one count as
//! much as it, so that a ray may end there and leave the picture what it is. `minip` is the mirror of it.

use super::row::{Ends, Levels, OfValues, Projection};
use crate::math::blend::Blend;

pub const MIP: Projection = Projection {
    name: "mip",
    about: "The greatest value of each ray",
    source: "Thesis §3.1.5",
    code: 1,
    blend: Blend::Max,
    ends: Ends::Reached,
    values: Some(OfValues {
        levels: |span| Levels::new(span.least + span.slack(span.least), span.greatest - span.slack(span.greatest)),
        counting: |levels| vec![[levels.start.next_up(), f64::INFINITY]],
        nothing: |levels| levels.start,
        part: |x, levels, _| x.min(levels.end),
        exact: |met| met.greatest,
        order: |_, _, _| None,
        magnification: |_| 1.0,
        remark: MISSED,
    }),
};

pub const MINIP: Projection = Projection {
    name: "minip",
    about: "The least value of each ray",
    source: "Stegmaier05 §6",
    code: 2,
    blend: Blend::Min,
    ends: Ends::Reached,
    values: Some(OfValues {
        levels: |span| Levels::new(span.greatest - span.slack(span.greatest), span.least + span.slack(span.least)),
        counting: |levels| vec![[f64::NEG_INFINITY, levels.start.next_down()]],
        nothing: |levels| levels.start,
        part: |x, levels, _| x.max(levels.end),
        exact: |met| met.least,
        order: |_, _, _| None,
        magnification: |_| 1.0,
        remark: MISSED,
    }),
};

/// What is to be known of the error of both.
const MISSED: &str = "an extremum lies between samples and is missed by up to half a step: where it is smooth along the ray the \
                      error is of the second order, and where it is a corner of the interpolant, at a face between cells, of \
                      the first";
