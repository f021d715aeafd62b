//! The exact integrator against closed forms, independent quadrature and its own invariants.

mod random;

use depthleap::math::interpolate::trilinear;
use depthleap::math::opacity::{composite, corrected_opacity, extinction};
use depthleap::math::ray::{ViewRays, box_interval};
use depthleap::scene::field::NanPolicy;
use depthleap::scene::transfer::Knot;
use depthleap::scene::volume::Voxels;
use depthleap::scene::{Camera, Field, TransferFunction, Volume};
use depthleap::truth::exact::ExactIntegrator;
use glam::{DVec3, dvec3};
use random::Random;

/// The integrator's own tolerance, with as much again for the rounding of the closed form.
const TIGHT: f64 = 2e-10;

fn field(dims: [usize; 3], spacing: [f64; 3], value: impl Fn(usize, usize, usize) -> f32) -> Field {
    let mut voxels = Vec::new();
    for z in 0..dims[2] {
        for y in 0..dims[1] {
            voxels.extend((0..dims[0]).map(|x| value(x, y, z)));
        }
    }
    let volume = Volume::new("test", dims, spacing, Voxels::F32(voxels)).unwrap();
    Field::new(volume, Some([0.0, 1.0]), NanPolicy::Hole).unwrap()
}

/// Points [x, r, g, b, opacity].
fn transfer(points: &[[f64; 5]], reference: f64) -> TransferFunction {
    let knots = points.iter().map(|p| Knot { x: p[0], color: [p[1], p[2], p[3]], opacity: p[4] }).collect();
    TransferFunction::new("test", knots, reference).unwrap()
}

/// Volume space of a place in voxel space (centres at + 0.5).
fn volume_space(field: &Field, voxel: DVec3) -> DVec3 {
    voxel * field.voxel() - 0.5 * field.extent()
}

/// The ray between two places in voxel space.
fn between(field: &Field, transfer: &TransferFunction, from: DVec3, to: DVec3) -> [f64; 4] {
    let (a, b) = (volume_space(field, from), volume_space(field, to));
    ExactIntegrator::new(field, transfer).ray(a, (b - a).normalize(), (b - a).length())
}

#[track_caller]
fn assert_near(found: [f64; 4], expected: [f64; 4], tolerance: f64) {
    let error = (0..4).map(|c| (found[c] - expected[c]).abs()).fold(0.0, f64::max);
    assert!(error <= tolerance, "found {found:?}, expected {expected:?}, error {error:e} above {tolerance:e}");
}

impl Random {
    fn place(&mut self, dims: [usize; 3]) -> DVec3 {
        DVec3::from_array(dims.map(|n| n as f64 * self.next()))
    }
}

/// A field with structure in every cell, in [0, 1].
fn noisy(dims: [usize; 3], spacing: [f64; 3], seed: u64) -> Field {
    let mut random = Random(seed);
    let values: Vec<f32> = (0..dims.iter().product()).map(|_| random.next() as f32).collect();
    field(dims, spacing, |x, y, z| values[(z * dims[1] + y) * dims[0] + x])
}

/// Midpoint sum over `steps` equal steps of the whole ray, by the shared trilinear interpolation.
fn midpoint(field: &Field, transfer: &TransferFunction, from: DVec3, to: DVec3, steps: usize) -> [f64; 4] {
    let length = ((to - from) * field.voxel()).length() / (transfer.reference * field.finest());
    let mut light = [0.0; 4];
    for i in 0..steps {
        let place = from.lerp(to, (i as f64 + 0.5) / steps as f64);
        let [r, g, b, a] = transfer.evaluate(trilinear(&field.values, field.dims(), place));
        let opacity = corrected_opacity(a, length / steps as f64);
        light = composite(light, [r * opacity, g * opacity, b * opacity, opacity]);
    }
    light
}

fn largest_error(a: [f64; 4], b: [f64; 4]) -> f64 {
    (0..4).map(|c| (a[c] - b[c]).abs()).fold(0.0, f64::max)
}

/// A bumpy medium: colours change along every piece, one jump, opacities away from 1.
fn colorful() -> TransferFunction {
    transfer(
        &[
            [0.1, 0.2, 0.9, 0.1, 0.0],
            [0.4, 1.0, 0.1, 0.3, 0.5],
            [0.6, 0.0, 0.4, 1.0, 0.05],
            [0.6, 0.9, 0.9, 0.0, 0.7],
            [0.9, 0.1, 0.2, 0.8, 0.2],
        ],
        1.0,
    )
}

#[test]
fn constant_medium_is_beers_law() {
    let f = field([16, 8, 4], [1.0, 1.0, 1.0], |_, _, _| 0.5);
    let tf = transfer(&[[0.0, 0.25, 0.5, 2.0, 0.01]], 2.0);
    let (from, to) = (dvec3(0.0, 1.0, 0.5), dvec3(16.0, 7.0, 3.0));
    let alpha = corrected_opacity(0.01, (to - from).length() / 2.0);
    assert_near(between(&f, &tf, from, to), [0.25 * alpha, 0.5 * alpha, 2.0 * alpha, alpha], 1e-14);
}

#[test]
fn linear_opacity_has_the_closed_form() {
    // x = q / 8 between the first and the last centre, alpha = x, unit colour. With dx = ds / 8:
    // tau(x) = 8 integral_0^x -ln(1 - t) dt = 8 ((1 - x) ln(1 - x) + x); at x = 1 the pole is integrated: tau = 8.
    let f = field([9, 1, 1], [1.0; 3], |x, _, _| x as f32 / 8.0);
    let tf = transfer(&[[0.0, 1.0, 1.0, 1.0, 0.0], [1.0, 1.0, 1.0, 1.0, 1.0]], 1.0);
    let tau = |x: f64| if x < 1.0 { 8.0 * ((1.0 - x) * (-x).ln_1p() + x) } else { 8.0 };
    for x in [0.01, 0.1, 0.5, 0.77, 0.999, 1.0] {
        let alpha = -f64::exp_m1(-tau(x));
        let found = between(&f, &tf, dvec3(0.5, 0.5, 0.5), dvec3(0.5 + 8.0 * x, 0.5, 0.5));
        assert_near(found, [alpha; 4], TIGHT);
    }
    // A thinner medium, so that the pole decides: tau(1) = 8 / 100.
    let thin = TransferFunction::new("thin", tf.knots().to_vec(), 100.0).unwrap();
    let alpha = -f64::exp_m1(-0.08);
    assert_near(between(&f, &thin, dvec3(0.5, 0.5, 0.5), dvec3(8.5, 0.5, 0.5)), [alpha; 4], TIGHT);
}

#[test]
fn linear_colour_in_constant_opacity_has_the_closed_form() {
    // c = x = s / 8, sigma constant: C = integral_0^L (s / 8) sigma exp(-sigma s) ds
    //   = (1 - exp(-sigma L) (1 + sigma L)) / (8 sigma).
    let f = field([9, 1, 1], [1.0; 3], |x, _, _| x as f32 / 8.0);
    for opacity in [1e-6, 0.1, 0.9, 1.0 - 1e-7] {
        let tf = transfer(&[[0.0, 0.0, 0.0, 0.0, opacity], [1.0, 1.0, 1.0, 1.0, opacity]], 1.0);
        let (sigma, length): (f64, f64) = (extinction(opacity), 8.0);
        let color = (-(-sigma * length).exp_m1() - (-sigma * length).exp() * sigma * length) / (8.0 * sigma);
        let alpha = -(-sigma * length).exp_m1();
        let found = between(&f, &tf, dvec3(0.5, 0.5, 0.5), dvec3(8.5, 0.5, 0.5));
        assert_near(found, [color, color, color, alpha], TIGHT);
    }
}

#[test]
fn colour_and_opacity_rising_together_solve_the_equation() {
    // C = integral x sigma exp(-tau) ds = integral_0^X exp(-tau(x)) dx - X exp(-tau(X)), with tau as in
    // `linear_opacity_has_the_closed_form`; the one integral left is smooth for X < 1: Simpson with 2000 intervals.
    let f = field([9, 1, 1], [1.0; 3], |x, _, _| x as f32 / 8.0);
    let tf = TransferFunction::preset("linear", 1.0).unwrap().unwrap();
    let tau = |x: f64| 8.0 * ((1.0 - x) * (-x).ln_1p() + x);
    let (end, n) = (0.9, 2000);
    let weight = |i: usize| if i == 0 || i == n { 1.0 } else { 2.0 + 2.0 * (i % 2) as f64 };
    let h = end / n as f64;
    let simpson: f64 = (0..=n).map(|i| weight(i) * (-tau(h * i as f64)).exp()).sum::<f64>() * h / 3.0;
    let color = simpson - end * (-tau(end)).exp();
    let found = between(&f, &tf, dvec3(0.5, 0.5, 0.5), dvec3(0.5 + 8.0 * end, 0.5, 0.5));
    assert_near(found, [color, color, color, -(-tau(end)).exp_m1()], TIGHT);
}

#[test]
fn jump_between_two_slabs_is_met_exactly() {
    // Red at 0.3 in front of x = 0.5, blue at 0.6 behind; the jump lies in the middle of the middle cell.
    let f = field([4, 1, 1], [1.0; 3], |x, _, _| if x < 2 { 0.0 } else { 1.0 });
    let tf = transfer(
        &[[0.0, 1.0, 0.0, 0.0, 0.3], [0.5, 1.0, 0.0, 0.0, 0.3], [0.5, 0.0, 0.0, 1.0, 0.6], [1.0, 0.0, 0.0, 1.0, 0.6]],
        1.0,
    );
    let (front, back) = (corrected_opacity(0.3, 2.0), corrected_opacity(0.6, 2.0));
    let expected = composite([front, 0.0, 0.0, front], [0.0, 0.0, back, back]);
    assert_near(between(&f, &tf, dvec3(0.0, 0.5, 0.5), dvec3(4.0, 0.5, 0.5)), expected, 1e-14);
}

#[test]
fn gaussian_field_agrees_with_fine_quadrature() {
    // Constant colour, so only tau matters. The interpolant is linear in each cell, where tau has an
    // antiderivative: with beta = 1 - alpha, integral -ln(beta) ds = -[beta ln(beta) - beta] / (d beta / ds).
    let n = 24;
    let value = |x: usize| (-((x as f64 - 11.5) / 5.0).powi(2)).exp() as f32;
    let f = field([n, 1, 1], [1.0; 3], |x, _, _| value(x));
    let tf = transfer(&[[0.0, 0.5, 0.5, 0.5, 0.0], [1.0, 0.5, 0.5, 0.5, 0.2]], 1.0);
    let antiderivative = |beta: f64| beta * beta.ln() - beta;
    let tau: f64 = (0..n - 1)
        .map(|i| {
            let (a, b) = (1.0 - 0.2 * f64::from(value(i)), 1.0 - 0.2 * f64::from(value(i + 1)));
            if a == b { -a.ln() } else { -(antiderivative(b) - antiderivative(a)) / (b - a) }
        })
        .sum();
    let alpha = -(-tau).exp_m1();
    let found = between(&f, &tf, dvec3(0.5, 0.5, 0.5), dvec3(n as f64 - 0.5, 0.5, 0.5));
    assert_near(found, [0.5 * alpha, 0.5 * alpha, 0.5 * alpha, alpha], TIGHT);
}

#[test]
fn midpoint_sums_converge_to_it() {
    // A continuous transfer function: the midpoint rule is of order 2 between cell planes; across them and across
    // knots, where only the slope jumps, its error is of order 2 as well, with a factor that depends on where the
    // samples fall about them. Hence the mean over several numbers of steps.
    let f = noisy([6, 5, 7], [1.0, 1.0, 1.5], 1);
    let tf = transfer(&[[0.1, 0.2, 0.9, 0.1, 0.0], [0.5, 1.0, 0.1, 0.3, 0.5], [0.8, 0.1, 0.4, 1.0, 0.1]], 1.0);
    let (from, to) = (dvec3(0.0, 0.3, 0.9), dvec3(6.0, 4.9, 6.2));
    let exact = between(&f, &tf, from, to);
    let error = |steps: usize| {
        (0..20).map(|i| largest_error(midpoint(&f, &tf, from, to, steps + i * steps / 50), exact)).sum::<f64>() / 20.0
    };
    let (coarse, fine) = (error(1000), error(16_000));
    let order = (coarse / fine).log2() / 4.0;
    assert!((1.8..2.2).contains(&order), "order {order}, errors {coarse:e} and {fine:e}");
    assert!(fine < 1e-8, "{fine:e}");
}

#[test]
fn random_rays_agree_with_fine_midpoint_sums() {
    // With a jump in the transfer function the sum is of order 1 only: 40000 steps over some 8 voxels leave an error
    // of about a step times the jump in sigma.
    let mut random = Random(2);
    for (seed, dims, spacing) in [
        (3, [5, 4, 6], [1.0; 3]),
        (4, [3, 9, 2], [2.0, 1.0, 3.7]),
        (5, [1, 6, 4], [0.4, 1.0, 1.0]),
        (6, [7, 1, 1], [1.0; 3]),
    ] {
        let f = noisy(dims, spacing, seed);
        for _ in 0..20 {
            let (from, to) = (random.place(dims), random.place(dims));
            let exact = between(&f, &colorful(), from, to);
            assert_near(midpoint(&f, &colorful(), from, to, 40_000), exact, 2e-4);
        }
    }
}

#[test]
fn cutting_a_ray_anywhere_changes_nothing() {
    let mut random = Random(7);
    let dims = [5, 6, 4];
    let f = noisy(dims, [1.0, 1.3, 0.8], 8);
    let presets =
        ["ramp", "surface", "haze", "linear"].map(|name| TransferFunction::preset(name, 1.0).unwrap().unwrap());
    for tf in presets.iter().chain([&colorful()]) {
        for _ in 0..20 {
            let (from, to) = (random.place(dims), random.place(dims));
            let middle = from.lerp(to, random.next());
            let whole = between(&f, tf, from, to);
            let parts = composite(between(&f, tf, from, middle), between(&f, tf, middle, to));
            assert_near(parts, whole, TIGHT);
        }
    }
}

#[test]
fn rays_in_faces_edges_and_corners_agree_with_their_neighbours() {
    // The field is continuous, and so is the integral for a continuous transfer function: a ray along a plane, an
    // edge or a diagonal through corners equals the limit of rays beside it.
    let f = noisy([4, 4, 4], [1.0; 3], 9);
    let tf = TransferFunction::preset("ramp", 1.0).unwrap().unwrap();
    let rays = [
        (dvec3(1.5, 0.0, 0.7), dvec3(1.5, 4.0, 2.9)),
        (dvec3(1.5, 2.5, 0.0), dvec3(1.5, 2.5, 4.0)),
        (dvec3(0.0, 0.0, 0.0), dvec3(4.0, 4.0, 4.0)),
        (dvec3(0.0, 4.0, 0.0), dvec3(4.0, 0.0, 4.0)),
        (dvec3(0.0, 1.0, 1.0), dvec3(0.0, 3.0, 3.0)),
    ];
    for (from, to) in rays {
        let shift = dvec3(1e-9, -2e-9, 1.5e-9);
        assert_near(between(&f, &tf, from + shift, to + shift), between(&f, &tf, from, to), 1e-7);
        assert_near(midpoint(&f, &tf, from, to, 20_000), between(&f, &tf, from, to), 1e-6);
    }
}

#[test]
fn ray_shorter_than_a_cell() {
    let f = noisy([4, 4, 4], [1.0; 3], 10);
    let tf = TransferFunction::preset("linear", 1.0).unwrap().unwrap();
    let from = dvec3(1.8, 1.9, 2.1);
    let to = from + dvec3(0.05, 0.02, -0.04);
    assert_near(between(&f, &tf, from, to), midpoint(&f, &tf, from, to, 2000), 1e-8);
    // Short enough for the integrand to be constant.
    let to = from + dvec3(1e-7, 0.0, 0.0);
    let x = trilinear(&f.values, f.dims(), from);
    let alpha = corrected_opacity(x, 1e-7);
    assert_near(between(&f, &tf, from, to), [x * alpha, x * alpha, x * alpha, alpha], 1e-13);
}

#[test]
fn no_length_is_nothing() {
    let f = noisy([4, 4, 4], [1.0; 3], 10);
    let tf = TransferFunction::preset("haze", 1.0).unwrap().unwrap();
    for length in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(ExactIntegrator::new(&f, &tf).ray(DVec3::ZERO, DVec3::X, length), [0.0; 4]);
    }
}

#[test]
fn opacity_one_ends_a_ray_in_its_colour() {
    // Transparent below 0.5, then opaque from red (x = 0.5) to blue (x = 1).
    let f = field([4, 1, 1], [1.0; 3], |x, _, _| [0.0, 0.25, 0.75, 1.0][x]);
    let points = [[0.5, 0.0, 1.0, 0.0, 0.0], [0.5, 1.0, 0.0, 0.0, 1.0], [1.0, 0.0, 0.0, 1.0, 1.0]];
    let tf = transfer(&points, 1.0);
    let (left, right) = (dvec3(0.0, 0.5, 0.5), dvec3(4.0, 0.5, 0.5));
    assert_near(between(&f, &tf, left, right), [1.0, 0.0, 0.0, 1.0], 1e-14);
    assert_near(between(&f, &tf, right, left), [0.0, 0.0, 1.0, 1.0], 1e-14);
    // Behind haze of 0.1 a voxel from x = 0 to 0.5, two voxels long (half of a border, then 1.5 cells).
    let mut hazy = points.to_vec();
    hazy[0] = [0.5, 0.0, 1.0, 0.0, 0.1];
    let alpha = corrected_opacity(0.1, 2.0);
    let expected = composite([0.0, alpha, 0.0, alpha], [1.0, 0.0, 0.0, 1.0]);
    assert_near(between(&f, &transfer(&hazy, 1.0), left, right), expected, 1e-14);
    // A constant field that sits exactly on the one opaque knot.
    let f = field([2, 2, 2], [1.0; 3], |_, _, _| 0.5);
    let tf = transfer(&[[0.0, 0.0, 0.0, 0.0, 0.0], [0.5, 0.3, 0.6, 0.9, 1.0], [1.0, 0.0, 0.0, 0.0, 0.0]], 1.0);
    assert_near(between(&f, &tf, dvec3(0.9, 0.9, 0.9), dvec3(1.0, 1.0, 1.0)), [0.3, 0.6, 0.9, 1.0], 0.0);
}

#[test]
fn opacity_one_at_a_point_lets_light_through() {
    // A tent in the middle of a cell: alpha rises from 0 at x = 0 to 1 at 0.5 and falls again; dx = ds, so each side
    // is integral_0^0.5 -ln(1 - 2x) dx = 1/2, and tau = 1.
    let f = field([2, 1, 1], [1.0; 3], |x, _, _| x as f32);
    let tf = transfer(&[[0.0, 1.0, 1.0, 1.0, 0.0], [0.5, 1.0, 1.0, 1.0, 1.0], [1.0, 1.0, 1.0, 1.0, 0.0]], 1.0);
    let alpha = -f64::exp_m1(-1.0);
    assert_near(between(&f, &tf, dvec3(0.0, 0.5, 0.5), dvec3(2.0, 0.5, 0.5)), [alpha; 4], TIGHT);
}

#[test]
fn nearly_opaque_is_finite_and_right() {
    let alpha = 1.0 - 1e-7;
    let f = noisy([3, 3, 3], [1.0; 3], 11);
    let tf = transfer(&[[0.0, 0.5, 0.5, 0.5, alpha]], 1.0);
    let opacity = corrected_opacity(alpha, 0.01);
    let found = between(&f, &tf, dvec3(1.0, 1.0, 1.0), dvec3(1.01, 1.0, 1.0));
    assert_near(found, [0.5 * opacity, 0.5 * opacity, 0.5 * opacity, opacity], 1e-13);
}

#[test]
fn peak_far_narrower_than_a_cell() {
    // A peak 1e-6 wide in x; x rises by 1 a voxel. A medium of tau = integral -ln(1 - alpha) over the two sides of
    // the tent up to 0.9: 1e-6 * (1 + 0.1 ln(0.1) / 0.9 ...) = 1e-6 ((1 - b) + b ln b) / (1 - b), b = 0.1.
    let f = field([2, 1, 1], [1.0; 3], |x, _, _| x as f32);
    let peak =
        |half: f64| [[0.3 - half, 1.0, 1.0, 1.0, 0.0], [0.3, 1.0, 1.0, 1.0, 0.9], [0.3 + half, 1.0, 1.0, 1.0, 0.0]];
    let tf = transfer(&peak(5e-7), 1e-6);
    let tau = (0.9 + 0.1 * 0.1f64.ln()) / 0.9;
    let found = between(&f, &tf, dvec3(0.0, 0.5, 0.5), dvec3(2.0, 0.5, 0.5));
    // The knots themselves are only known to 1e-16 / 1e-6 of the peak's width.
    assert_near(found, [-(-tau).exp_m1(); 4], 1e-9);
}

#[test]
fn one_voxel_is_a_constant_medium() {
    let f = field([1, 1, 1], [1.0, 2.0, 3.0], |_, _, _| 0.5);
    let tf = transfer(&[[0.0, 0.0, 0.0, 0.0, 0.0], [1.0, 1.0, 1.0, 1.0, 0.5]], 1.0);
    // Reference length is the finest side, so the three sides are 1, 2 and 3 of it.
    for (to, length) in [(dvec3(1.0, 0.0, 0.0), 1.0), (dvec3(0.0, 1.0, 0.0), 2.0), (dvec3(1.0, 1.0, 1.0), 14f64.sqrt())]
    {
        let alpha = corrected_opacity(0.25, length);
        let expected = [0.5 * alpha, 0.5 * alpha, 0.5 * alpha, alpha];
        assert_near(between(&f, &tf, DVec3::ZERO, to), expected, 1e-14);
    }
}

#[test]
fn holes_are_transparent() {
    // Voxel 2 of 5 is NaN: cells 1 and 2 (q from 1 to 3) are holes, 3 of the 5 voxel lengths are left.
    let f = field([5, 1, 1], [1.0; 3], |x, _, _| if x == 2 { f32::NAN } else { 0.5 });
    let tf = transfer(&[[0.0, 1.0, 1.0, 1.0, 0.3]], 1.0);
    let found = between(&f, &tf, dvec3(0.0, 0.5, 0.5), dvec3(5.0, 0.5, 0.5));
    assert_near(found, [corrected_opacity(0.3, 3.0); 4], 1e-14);
}

#[test]
fn huge_values_stay_finite() {
    let f = field([3, 3, 3], [1.0; 3], |x, y, z| if (x + y + z) % 2 == 0 { f32::MAX } else { f32::MIN });
    let found = between(&f, &colorful(), dvec3(0.1, 0.2, 0.0), dvec3(2.9, 2.0, 3.0));
    assert!(found.iter().all(|c| (0.0..=1.0).contains(c)), "{found:?}");
}

#[test]
fn picture_holds_the_rays_of_the_view() {
    let f = noisy([4, 5, 3], [1.0, 1.0, 2.0], 12);
    let tf = colorful();
    let camera = Camera { eye: dvec3(1.1, 0.7, 1.6), target: DVec3::ZERO, up: DVec3::Y, fov_y: 45.0, height: None };
    let rays: ViewRays = camera.rays([9, 7]).unwrap();
    let exact = ExactIntegrator::new(&f, &tf);
    let picture = exact.picture(&rays, [9, 7]);
    assert_eq!(picture.len(), 63);
    assert_eq!(picture[0], [0.0; 4], "a corner pixel looks past the volume");
    let mut hits = 0;
    for row in 0..7 {
        for column in 0..9 {
            let ray = rays.of(column, row);
            let Some((enter, leave)) = box_interval(&ray, 0.5 * f.extent(), rays.near) else { continue };
            let (from, to) = (ray.at(enter), ray.at(leave));
            let expected = exact.ray(from, (to - from).normalize(), (to - from).length());
            assert_near(picture[(row * 9 + column) as usize], expected, 1e-9);
            hits += 1;
        }
    }
    assert!(hits > 10, "{hits}");
}
