//! Optical depths from next to nothing to far more than black.

use super::super::case::{COLOR, Expect, ROUNDING, StabilityCase, Tolerance};
use crate::scene::settings::{Alpha, Classification, Offset};

const GROUP: &str = "optical depth";

/// Opacity of a reference length of optical depth 1.
const ONE: f64 = 1.0 - 0.367_879_441_171_442_33;

pub fn cases() -> Vec<StabilityCase> {
    let mut cases = Vec::new();
    for exponent in [-9, -6, -3, 0, 3, 6] {
        // A thin medium has a small opacity over the longest reference length, a thick one a large one over the shortest.
        let (opacity, reference) = match exponent {
            -9 => (1e-3f64, 1e6),
            -6 => (1e-3, 1e3),
            -3 => (1e-3, 1.0),
            exponent => (ONE, 10f64.powi(-exponent)),
        };
        // Nothing that is small against what is there may be lost.
        let thin = Tolerance {
            absolute: 1e-5 * 10f64.powi(exponent.min(-2)),
            reason: "some hundred roundings to f32, and a ray's length to a hundred thousandth of a step",
            ..ROUNDING
        };
        let beer = || Expect::Beer { color: COLOR, opacity, steps: None };
        for (way, offset) in [("left", Offset::Left), ("midpoint", Offset::Midpoint)] {
            let name = format!("1e{exponent} a step, {way}");
            cases.push(
                StabilityCase::medium(GROUP, name, "constant:24", opacity)
                    .with(|s| (s.transfer.reference, s.sampling.offset) = (reference, offset))
                    .expect(beer(), thin),
            );
        }
        let name = format!("1e{exponent} a step, pre-integrated");
        cases.push(
            StabilityCase::medium(GROUP, name, "constant:24", opacity)
                .with(|s| {
                    (s.transfer.reference, s.sampling.classification) = (reference, Classification::PreIntegrated);
                })
                .expect(beer(), thin),
        );
    }
    let opaque = [COLOR[0], COLOR[1], COLOR[2], 1.0];
    cases
        .push(StabilityCase::medium(GROUP, "opacity 1", "constant:24", 1.0).expect(Expect::Constant(opaque), ROUNDING));
    cases.push(
        StabilityCase::medium(GROUP, "opacity 1 in steps of 1/16", "constant:24", 1.0)
            .expect(Expect::Constant(opaque), ROUNDING)
            .with(|s| s.sampling.step = 1.0 / 16.0),
    );
    cases.push(
        StabilityCase::medium(GROUP, "opacity 1, used as it stands", "constant:24", 1.0)
            .expect(Expect::Constant(opaque), ROUNDING)
            .with(|s| (s.sampling.alpha, s.sampling.last) = (Alpha::Paper, crate::scene::settings::Last::Full)),
    );
    // Over a long reference length, so that steps show what f32 made of 1 - opacity.
    for (name, step) in [("opacity 1 - 1e-7", 1.0), ("opacity 1 - 1e-7 in steps of 1/16", 1.0 / 16.0)] {
        cases.push(
            StabilityCase::medium(GROUP, name, "constant:4", 1.0 - 1e-7)
                .with(|s| {
                    s.sampling.step = step;
                    (s.transfer.reference, s.sampling.samples_per_pass) = (16.0, 16);
                })
                .expect(
                    Expect::Beer { color: COLOR, opacity: 1.0 - 1e-7, steps: None },
                    Tolerance { reason: "as many roundings as samples; 1 - opacity is kept by itself", ..ROUNDING },
                ),
        );
    }
    cases
}
