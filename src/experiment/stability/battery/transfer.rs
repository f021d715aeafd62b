//! Transfer functions that are narrow, empty, single, jumping or wrong.

use super::super::case::{COLOR, Expect, SAME_SUM, StabilityCase, Tolerance};
use crate::scene::settings::Classification;

const GROUP: &str = "transfer function";

/// Of a table of some five hundred nodes along each axis.
const TABLE: Tolerance =
    Tolerance { absolute: 1e-2, relative: 0.0, reason: "between the table's entries values are interpolated" };

/// Opacities that rise by 5000 over the range.
const STEEP: Tolerance =
    Tolerance { absolute: 2e-3, relative: 0.0, reason: "a value rounded to 1e-7 moves the opacity by 5e-4" };

pub fn cases() -> Vec<StabilityCase> {
    let [r, g, b] = COLOR;
    // A hundredth of a step wide in a volume that rises by a 24th a voxel.
    let peak = [[0.5, r, g, b, 0.0], [0.5002, r, g, b, 0.999], [0.5004, r, g, b, 0.0]];
    // Seen along x, so that every step goes through the whole peak: the corner where both of a step's values lie beside it
    // is what a table knows least of.
    let narrow = |name: &str| {
        StabilityCase::new(GROUP, name, "linear:24").points(&peak).with(|s| s.camera.eye = [1.9, 0.13, 0.21])
    };
    let integrated = |case: StabilityCase| {
        case.with(|s| s.sampling.classification = Classification::PreIntegrated).expect(Expect::Exact, TABLE)
    };
    let jumping = |name: &str| StabilityCase::new(GROUP, name, "linear:24").preset("surface");
    let (low, high) = ([0.25, r, g, b, 0.0], [0.75, b, g, r, 0.4]);
    vec![
        narrow("a peak of a hundredth of a step").expect(Expect::Sum, STEEP),
        integrated(narrow("a peak of a hundredth of a step, pre-integrated")),
        StabilityCase::new(GROUP, "a peak that no two numbers of f32 lie in", "linear:24").points(&[
            [0.5, r, g, b, 0.0],
            [0.5 + 1e-9, r, g, b, 1.0],
            [0.5 + 2e-9, r, g, b, 0.0],
        ]),
        jumping("a jump"),
        integrated(jumping("a jump, pre-integrated")),
        StabilityCase::new(GROUP, "jumps up and down at one place", "linear:24").points(&[
            [0.5, r, g, b, 0.0],
            [0.5, r, g, b, 1.0],
            [0.5, r, g, b, 0.0],
        ]),
        StabilityCase::new(GROUP, "no opacity", "shells:24")
            .points(&[[0.0, 1.0, 1.0, 1.0, 0.0], [1.0, 1.0, 1.0, 1.0, 0.0]])
            .expect(Expect::Constant([0.0; 4]), SAME_SUM),
        StabilityCase::medium(GROUP, "one point", "gaussian:24", 0.02),
        StabilityCase::new(GROUP, "a point of opacity 1 between points of 0", "gaussian:24").points(&[
            [0.4, r, g, b, 0.0],
            [0.5, r, g, b, 1.0],
            [0.6, r, g, b, 0.0],
        ]),
        StabilityCase::new(GROUP, "points out of order", "linear:24")
            .points(&[high, low])
            .expect(Expect::Refused("sort"), SAME_SUM),
        StabilityCase::new(GROUP, "an opacity above 1", "linear:24")
            .points(&[[0.5, r, g, b, 1.5]])
            .expect(Expect::Refused("opacity from 0 to 1"), SAME_SUM),
        StabilityCase::new(GROUP, "a range of one value", "shells:24")
            .points(&[low, high])
            .with(|s| s.volume.range = Some([7.0, 7.0].map(Into::into))),
        StabilityCase::new(GROUP, "a range upside down", "shells:24")
            .points(&[low, high])
            .with(|s| s.volume.range = Some([9.0, 7.0].map(Into::into)))
            .expect(Expect::Refused("low one first"), SAME_SUM),
        StabilityCase::new(GROUP, "five hundred points", "linear:24")
            .points(&(0..500).map(|i| [f64::from(i) / 499.0, r, g, b, f64::from(i % 2) * 0.1]).collect::<Vec<_>>()),
    ]
}
