//! Depth buffers with as many sections as they tell apart, and one more.

use super::super::case::{COLOR, Expect, SAME_SUM, StabilityCase, Tolerance};
use crate::method;
use crate::scene::settings::{Cull, DepthFormat, Mark, MethodName};
use crate::twin::section::most_sections;

const GROUP: &str = "depth buffer";

/// One of those that copy marks and one that decides in its main passes.
const METHODS: [MethodName; 2] = [method::NN_OMNI.name(), method::NN_OMNI_FUSED.name()];

/// Thousands of passes, each of which rounds what is there.
const MANY: Tolerance =
    Tolerance { absolute: 1e-6, relative: 1e-3, reason: "thousands of passes, each rounded to f32" };

pub fn cases() -> Vec<StabilityCase> {
    let most = most_sections(DepthFormat::D16);
    let length = 16.0;
    // A ray along an axis has a sample for every section.
    let deep = |format: DepthFormat, passes: u32| {
        StabilityCase::medium(GROUP, format!("{passes} passes in {}", format.name()), "constant:16", 0.03)
            .with(|s| {
                (s.camera.eye, s.camera.fov_y) = ([0.0, 0.0, 3.0], 1.0);
                (s.image.size, s.sampling.samples_per_pass) = ([3, 3], 1);
                (s.sampling.passes, s.sampling.step) = (passes, length / f64::from(passes) * (1.0 - 1e-4));
                // Some drivers compile a shader for each bound of the depth bounds test, which takes them minutes here.
                (s.method.depth, s.method.cull, s.method.mark) = (format, Cull::Ztest, Mark::Copy);
            })
            .by(&METHODS)
    };
    let steps = |passes: u32| Expect::Beer { color: COLOR, opacity: 0.03, steps: Some(f64::from(passes)) };
    let mut cases: Vec<StabilityCase> = [DepthFormat::D16, DepthFormat::D24, DepthFormat::D32]
        .into_iter()
        .map(|format| deep(format, most).expect(steps(most), MANY))
        .collect();
    cases.push(deep(DepthFormat::D16, most + 1).expect(Expect::Refused("--depth-format"), SAME_SUM));
    for format in [DepthFormat::D32, DepthFormat::D24, DepthFormat::D16] {
        for (way, cull) in [("ztest", Cull::Ztest), ("discard", Cull::Discard), ("bounds", Cull::Bounds)] {
            cases.push(
                StabilityCase::new(GROUP, format!("{} by {way} and copied marks", format.name()), "shells:24")
                    .preset("ramp")
                    .with(|s| {
                        (s.method.depth, s.method.cull, s.method.mark) = (format, cull, Mark::Copy);
                        s.sampling.termination = 0.9;
                    })
                    .by(&METHODS),
            );
        }
    }
    cases
}
