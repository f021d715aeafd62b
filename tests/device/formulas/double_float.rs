//! `glsl/shared/double_float.glsl` against f64, which holds every sum and product of two f32 here exactly.

use std::sync::Arc;

use depthleap::vulkan::Device;

use super::kit::{Evaluator, Random, Setup, Worst};
use crate::harness::{Test, tests};

pub fn all() -> Vec<Test> {
    tests![
        sum_and_product_of_two_floats_are_exact,
        arithmetic_is_good_to_44_bits,
        order_is_that_of_the_numbers,
        single_precision_would_be_seen,
    ]
}

/// a and b, high and low part each.
type Arguments = [f32; 4];
type Results = [[f32; 4]; 3];

fn results(device: &Arc<Device>, arguments: &[Arguments]) -> Vec<Results> {
    Evaluator::new(device, "double_float.comp", &[]).run(&Setup::default(), arguments)
}

fn split(value: f64) -> [f32; 2] {
    let high = value as f32;
    [high, (value - f64::from(high)) as f32]
}

fn joined([high, low]: [f32; 2]) -> f64 {
    f64::from(high) + f64::from(low)
}

/// Numbers of either sign from 1e-3 to 1e3, some of them close to one another.
fn arguments(seed: u64) -> Vec<Arguments> {
    let mut random = Random(seed);
    let number = |random: &mut Random| {
        let magnitude = 10_f64.powf(random.between(-3.0, 3.0));
        if random.next() < 0.5 { -magnitude } else { magnitude }
    };
    (0..20_000)
        .map(|i| {
            let a = number(&mut random);
            let b = match i % 4 {
                0 => a * (1.0 + random.between(-1e-6, 1e-6)),
                1 => -a * (1.0 + random.between(-1e-6, 1e-6)),
                _ => number(&mut random),
            };
            let ([a, a_low], [b, b_low]) = (split(a), split(b));
            [a, a_low, b, b_low]
        })
        .collect()
}

fn sum_and_product_of_two_floats_are_exact(device: &Arc<Device>) {
    let arguments = arguments(31);
    for (&[a, _, b, _], r) in arguments.iter().zip(results(device, &arguments)) {
        let [sum, sum_error, product, product_error] = r[0];
        let [exact_sum, exact_product] = [f64::from(a) + f64::from(b), f64::from(a) * f64::from(b)];
        assert_eq!(joined([sum, sum_error]), exact_sum, "{a} + {b}");
        assert_eq!(joined([product, product_error]), exact_product, "{a} * {b}");
        // And the high part is what f32 alone would give.
        assert_eq!([sum, product], [a + b, a * b]);
    }
}

fn arithmetic_is_good_to_44_bits(device: &Arc<Device>) {
    let bits = |n: i32| 2_f64.powi(-n);
    let arguments = arguments(32);
    let [mut sums, mut products, mut quotients] = [0; 3].map(|_| Worst::default());
    for (&[a, a_low, b, b_low], r) in arguments.iter().zip(results(device, &arguments)) {
        let (a, b) = (joined([a, a_low]), joined([b, b_low]));
        let found = |at: usize, part: usize| joined([r[at][part], r[at][part + 1]]);
        // The low parts are 2^-24 of the high ones, and what is rounded is the low parts' sum, three times.
        sums.see(found(1, 0), a + b, 3.0 * bits(48) * (a.abs() + b.abs()), || format!("{a} + {b}"));
        // The product of the low parts is left out, and three sums of cross products are rounded.
        products.see(found(1, 2), a * b, bits(44) * (a * b).abs(), || format!("{a} * {b}"));
        // A driver may miss a quotient by 2.5 units in the last place, twice in a row.
        quotients.see(found(2, 0), a / b, bits(43) * (a / b).abs(), || format!("{a} / {b}"));
    }
    [sums, products, quotients].iter().for_each(|worst| worst.assert(20_000));
}

fn order_is_that_of_the_numbers(device: &Arc<Device>) {
    let mut arguments = arguments(33);
    // The same high part, and the low part decides; twice the same.
    arguments.extend([[1.0, 1e-9, 1.0, 2e-9], [1.0, 2e-9, 1.0, 1e-9], [1.0, -1e-9, 1.0, 0.0], [1.0, 1e-9, 1.0, 1e-9]]);
    for (&[a, a_low, b, b_low], r) in arguments.iter().zip(results(device, &arguments)) {
        let less = joined([a, a_low]) < joined([b, b_low]);
        assert_eq!(r[2][2], f32::from(u8::from(less)), "{a} + {a_low} < {b} + {b_low}");
    }
}

/// The bound of the arithmetic test is far below what f32 can do.
fn single_precision_would_be_seen(_: &Arc<Device>) {
    let mut worst = Worst::default();
    let (a, b) = (1.0 / 3.0, 0.7);
    worst.see(f64::from((a * b) as f32), a * b, 2_f64.powi(-44) * a * b, String::new);
    assert!(worst.fails());
    let mut worst = Worst::default();
    worst.see(f64::NAN, 1.0, 1.0, String::new);
    assert!(worst.fails());
}
