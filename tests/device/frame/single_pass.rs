//! Single-pass ray casting beside the multi-pass ray casters, on a device.

use std::sync::Arc;

use depthleap::method::{RC_ERT, SINGLE_PASS, SINGLE_PASS_COMPUTE};
use depthleap::scene::settings::Accumulate;
use depthleap::vulkan::Device;

use super::scenes::{Stage, VIEWS, by, exactly, forms, scene, seen};
use crate::harness::{Test, test};

pub fn tests() -> Vec<Test> {
    vec![
        test("single_pass::is_rc_ert_where_samples_are_the_same", same_samples),
        test("single_pass::picture_is_rounded_once", rounded_once),
    ]
}

/// With passes of one sample both take the same samples in the same order. The blend unit multiplies and adds where the loop does both
/// at once: each sample may differ by a rounding or two of a number below 1, and what it adds is weakened by those in front.
fn same_samples(device: &Arc<Device>) {
    let mut stage = Stage::new(device);
    let mut largest = 0.0f32;
    for view in &VIEWS[1..3] {
        let scene = seen(
            &scene("shells:24", "ramp", |s| {
                exactly(s);
                s.sampling.samples_per_pass = 1;
            }),
            *view,
        );
        let rule = stage.shoot(&by(&scene, RC_ERT.name()), forms(device, RC_ERT.name()).pop().flatten());
        let bound = 2.0 * f32::EPSILON * rule.plan.passes as f32;
        for method in [&SINGLE_PASS, &SINGLE_PASS_COMPUTE] {
            let shot = stage.shoot(&by(&scene, method.name()), None);
            for (i, (found, expected)) in shot.picture.iter().zip(&rule.picture).enumerate() {
                for c in 0..4 {
                    let off = (found[c] - expected[c]).abs();
                    largest = largest.max(off);
                    assert!(off <= bound, "{}, {}: pixel {i} is {found:?}, rc-ert's {expected:?}", method.name, view.0);
                }
            }
        }
    }
    println!("largest difference {largest:.1e}");
}

/// A loop sums up in f32 whatever the format of the picture is, to which it is rounded in the end: half a unit in the last place of a
/// half or of a byte, and as much again where a device rounds down.
fn rounded_once(device: &Arc<Device>) {
    let scene = scene("shells:24", "ramp", exactly);
    let mut stage = Stage::new(device);
    for method in [&SINGLE_PASS, &SINGLE_PASS_COMPUTE] {
        let mut taken = |accumulate| {
            let mut scene = by(&scene, method.name());
            scene.settings.image.accumulate = accumulate;
            stage.shoot(&scene, None).picture
        };
        let full = taken(Accumulate::Rgba32f);
        for (accumulate, unit) in [(Accumulate::Rgba16f, 1.0 / 2048.0), (Accumulate::Rgba8, 1.0 / 255.0)] {
            let pairs = taken(accumulate).into_iter().zip(&full);
            let off = pairs.flat_map(|(a, b)| (0..4).map(move |c| (a[c] - b[c]).abs())).fold(0.0, f32::max);
            assert!(off > 0.0 && off <= unit, "{}, {accumulate:?}: {off} off", method.name);
        }
    }
}
