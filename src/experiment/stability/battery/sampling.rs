//! Steps, passes and thresholds at their ends.

use super::super::case::{COLOR, Expect, ROUNDING, StabilityCase, Tolerance};
use super::named;
use crate::math::opacity::corrected_opacity;
use crate::part::rows::Method;
use crate::scene::settings::{Classification, Last, Settings};

const GROUP: &str = "sampling";

/// Thousands of samples.
const MANY: Tolerance = Tolerance { absolute: 1e-6, relative: 3e-4, reason: "thousands of roundings to f32" };

pub fn cases() -> Vec<StabilityCase> {
    let medium = |name: &str, change: &dyn Fn(&mut Settings)| {
        StabilityCase::medium(GROUP, name, "constant:24", 0.03).with(change)
    };
    let beer = |opacity: f64, steps: f64| Expect::Beer { color: COLOR, opacity, steps: Some(steps) };
    let shown = |alpha: f64| Expect::Constant([COLOR[0] * alpha, COLOR[1] * alpha, COLOR[2] * alpha, alpha]);
    // Head-on every ray has far more samples than it takes.
    let ended = |name: &str, opacity: f64, threshold: f64, samples: f64| {
        StabilityCase::medium(GROUP, name, "constant:24", opacity)
            .with(|s| {
                (s.camera.eye, s.sampling.termination, s.sampling.samples_per_pass) = ([0.0, 0.0, 1.91], threshold, 1)
            })
            .with(|s| s.camera.fov_y = 10.0)
            .expect(beer(opacity, samples), ROUNDING)
            .by(&named(Method::under_the_law))
    };
    vec![
        medium("steps of 1/64 voxel", &|s| (s.sampling.step, s.sampling.samples_per_pass) = (1.0 / 64.0, 256))
            .expect(Expect::Beer { color: COLOR, opacity: 0.03, steps: None }, MANY),
        medium("steps of 1/64 voxel, pre-integrated", &|s| {
            (s.sampling.step, s.sampling.samples_per_pass) = (1.0 / 64.0, 256);
            s.sampling.classification = Classification::PreIntegrated;
        })
        .expect(Expect::Beer { color: COLOR, opacity: 0.03, steps: None }, MANY),
        medium("steps of ten volumes", &|s| s.sampling.step = 240.0),
        medium("steps of ten volumes, full", &|s| (s.sampling.step, s.sampling.last) = (240.0, Last::Full))
            .expect(shown(corrected_opacity(0.03, 240.0)), ROUNDING),
        medium("steps of ten volumes, pre-integrated", &|s| {
            (s.sampling.step, s.sampling.classification) = (240.0, Classification::PreIntegrated);
        }),
        // A loop holds the whole ray, whose passes nobody can force.
        medium("fewer passes than needed", &|s| s.sampling.passes = 3)
            .expect(beer(0.03, 12.0), ROUNDING)
            .by(&named(|method| !method.loops())),
        medium("more passes than needed", &|s| s.sampling.passes = 40),
        medium("one sample a pass", &|s| s.sampling.samples_per_pass = 1),
        medium("10000 samples a pass", &|s| s.sampling.samples_per_pass = 10_000),
        // After a sample of any opacity a ray is done.
        ended("a threshold of 0", 0.3, 0.0, 1.0),
        // 1 - 0.5^2 is 0.75 to the bit, which is not above 0.75.
        ended("a threshold that is met to the bit", 0.5, 0.75, 3.0),
        ended("a threshold a little below", 0.5, 0.749_999_9, 2.0),
        medium("a threshold of 1", &|s| s.sampling.termination = 1.0),
        medium("a threshold that no ray comes to", &|s| s.sampling.termination = 0.999_999),
    ]
}
