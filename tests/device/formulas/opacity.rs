//! `glsl/shared/opacity.glsl` and `src/math/opacity.rs`.

use std::sync::Arc;

use depthleap::math::opacity::{composite, corrected_opacity};
use depthleap::vulkan::Device;

use super::kit::{Evaluator, ROUNDING, Random, Setup, Worst};
use crate::harness::{Test, tests};

pub fn all() -> Vec<Test> {
    tests![
        corrected_opacity_is_its_twin,
        corrected_opacity_keeps_its_ends,
        series_are_the_functions_they_stand_for,
        composite_is_its_twin,
    ]
}

/// alpha, exponent, argument of log_1_plus, argument of exp_minus_1; front; behind.
type Arguments = [[f32; 4]; 3];
type Results = [[f32; 4]; 2];

fn results(device: &Arc<Device>, arguments: &[Arguments]) -> Vec<Results> {
    Evaluator::new(device, "opacity.comp", &[]).run(&Setup::default(), arguments)
}

fn single(alpha: f64, exponent: f64) -> Arguments {
    [[alpha as f32, exponent as f32, 0.0, 0.0], [0.0; 4], [0.0; 4]]
}

fn corrected_opacity_is_its_twin(device: &Arc<Device>) {
    let mut random = Random(21);
    // Opacities of all magnitudes, where the plain form cancels, and near 1; exponents from fine steps to coarse.
    let mut arguments: Vec<Arguments> = Vec::new();
    for _ in 0..20_000 {
        let alpha = match random.next() {
            kind if kind < 0.4 => random.next(),
            kind if kind < 0.8 => 10_f64.powf(random.between(-7.0, 0.0)),
            _ => 1.0 - 10_f64.powf(random.between(-6.0, 0.0)),
        };
        arguments.push(single(alpha, 2_f64.powf(random.between(-10.0, 4.0))));
    }
    let mut worst = Worst::default();
    for (a, r) in arguments.iter().zip(results(device, &arguments)) {
        let (alpha, exponent) = (f64::from(a[0][0]), f64::from(a[0][1]));
        let truth = corrected_opacity(alpha, exponent);
        // Up to 8 roundings and a series cut at 1.5e-7 in the logarithm; a driver's own log and exp may be off by 3
        // units in the last place and by 2^-21 near 1 [Vulkan, precision of GLSL.std.450], and exp by twice its
        // argument more, which matters only where the result is close to 1.
        let depth = -exponent * f64::ln_1p(-alpha);
        let allowed = truth * (24.0 + 2.0 * depth.min(16.0)) * ROUNDING;
        worst.see(r[0][0].into(), truth, allowed, || format!("{alpha} ^ {exponent}"));
    }
    worst.assert(20_000);
}

fn corrected_opacity_keeps_its_ends(device: &Arc<Device>) {
    let arguments = [
        single(0.0, 0.125),
        single(1.0, 0.125),
        single(1.0, 0.0),
        single(0.3, 0.0),
        single(0.7, 0.0),
        single(1.5, 2.0),
    ];
    let found: Vec<f32> = results(device, &arguments).iter().map(|r| r[0][0]).collect();
    assert_eq!(found, [0.0, 1.0, 0.0, 0.0, 0.0, 1.0]);
}

fn series_are_the_functions_they_stand_for(device: &Arc<Device>) {
    let mut random = Random(22);
    let mut arguments: Vec<Arguments> = Vec::new();
    for _ in 0..20_000 {
        let mut argument =
            || if random.next() < 0.5 { -0.5 * random.next() } else { -10_f64.powf(random.between(-9.0, -0.302)) };
        arguments.push([[0.0, 1.0, argument() as f32, argument() as f32], [0.0; 4], [0.0; 4]]);
    }
    let (mut log, mut exp) = (Worst::default(), Worst::default());
    for (a, r) in arguments.iter().zip(results(device, &arguments)) {
        let [x, y] = [f64::from(a[0][2]), f64::from(a[0][3])];
        // The first term left out of the logarithm is s^12 / 13 with s = 1/3 at most, 1.5e-7; of the exponential
        // 0.5^8 / 9!, 1e-8. The rest is rounding: a quotient of 2.5 units, and five operations; eight and a product.
        log.see(r[0][1].into(), x.ln_1p(), (1.5e-7 + 8.0 * ROUNDING) * x.ln_1p().abs(), || format!("log 1 + {x}"));
        exp.see(r[0][2].into(), y.exp_m1(), (1e-8 + 8.0 * ROUNDING) * y.exp_m1().abs(), || format!("exp {y} - 1"));
    }
    log.assert(20_000);
    exp.assert(20_000);
}

fn composite_is_its_twin(device: &Arc<Device>) {
    let mut random = Random(23);
    let mut color = || [0; 4].map(|_| random.next() as f32);
    let arguments: Vec<Arguments> = (0..5000).map(|_| [[0.0, 1.0, 0.0, 0.0], color(), color()]).collect();
    let mut worst = Worst::default();
    for (a, r) in arguments.iter().zip(results(device, &arguments)) {
        let truth = composite(a[1].map(f64::from), a[2].map(f64::from));
        for c in 0..4 {
            // One rounding of 1 - alpha and one of the fused sum, which is at most 2.
            worst.see(r[1][c].into(), truth[c], 3.0 * ROUNDING, || format!("{a:?}"));
        }
    }
    worst.assert(20_000);
}
