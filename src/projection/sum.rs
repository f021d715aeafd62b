//! `average` and `xray`: the mean value of a ray, and its sum over the way [Thesis §3.1.5, Stegmaier05 §6].
//!
//! A value that rounding cannot tell from 0 counts as 0, so that cells which hold nothing else add nothing, to the bit, and are
//! skipped. Samples are parts of the whole from the first on, which the blend unit adds up.

use super::row::{Ends, Levels, OfValues, Projection};
use crate::math::blend::Blend;
use crate::scene::settings::{Last, Offset};

pub const AVERAGE: Projection = Projection {
    name: "average",
    about: "The mean value of each ray",
    source: "Stegmaier05 §6",
    code: 3,
    blend: Blend::Add,
    ends: Ends::Never("an average takes in every sample of its ray"),
    values: Some(OfValues {
        part: |x, levels, weight| counted(x, levels) * weight.steps / weight.all,
        exact: |met| met.integral / met.lengths,
        order: |offset, last, vanishes| match last {
            // A last sample of full weight has the mean of a ray that is longer than this one.
            Last::Full | Last::None => Some(1.0),
            Last::Partial => order(offset, last, vanishes),
        },
        magnification: |_| 1.0,
        ..SUM
    }),
};

pub const XRAY: Projection = Projection {
    name: "xray",
    about: "The values of each ray summed up, each times its part of a reference length",
    source: "Thesis §3.1.5",
    code: 4,
    blend: Blend::Add,
    ends: Ends::Never("a sum takes in every sample of its ray"),
    values: Some(SUM),
};

/// A row that takes over the rest of this looks at each of `part`, `exact`, `order`, `magnification` and `remark`.
const SUM: OfValues = OfValues {
    levels: |span| Levels::new(span.zero, span.zero + span.slack(span.zero)),
    counting: |levels| {
        let slack = levels.end - levels.start;
        vec![[f64::NEG_INFINITY, (levels.start - slack).next_down()], [levels.end.next_up(), f64::INFINITY]]
    },
    nothing: |_| 0.0,
    part: |x, levels, weight| counted(x, levels) * weight.steps * weight.lengths,
    exact: |met| met.integral,
    order,
    magnification: |lengths| lengths,
    remark: "what a sample is off by is off in the whole: sums converge as the rule of their samples does",
};

/// x, or 0 where rounding cannot tell it from 0.
fn counted(x: f64, levels: &Levels) -> f64 {
    if (x - levels.start).abs() <= levels.end - levels.start { 0.0 } else { x }
}

/// The order of a sum over the samples of a ray.
fn order(offset: Offset, last: Last, vanishes: bool) -> Option<f64> {
    Some(match (offset, last) {
        // Both ends weigh nothing, so that it is the trapezoid rule.
        _ if vanishes => 2.0,
        (Offset::Left, _) => 1.0,
        (Offset::Midpoint, Last::Partial) => 2.0,
        // What the last sample stands for beyond the face, or what is left out before it, is an error of the first order.
        (Offset::Midpoint, Last::Full | Last::None) => 1.0,
    })
}
