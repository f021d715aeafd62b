//! Pre-integrated classification: the table against closed forms and the exact integral, and what it refuses.

use depthleap::math::opacity::corrected_opacity;
use depthleap::plan;
use depthleap::read;
use depthleap::scene::Scene;
use depthleap::scene::settings::{Alpha, Classification, Offset, Settings};
use depthleap::truth::exact::Absorber;
use depthleap::truth::preintegrated::{PreintegratedTable, part_of};

fn scene(tf: &str, change: impl FnOnce(&mut Settings)) -> Scene {
    let mut settings = Settings::default();
    settings.volume.builtin = Some("gaussian:16".to_owned());
    settings.transfer.preset = Some(tf.to_owned());
    settings.sampling.classification = Classification::PreIntegrated;
    change(&mut settings);
    read::scene(&settings).unwrap()
}

/// Colour and opacity by the values at both ends.
fn look_up(table: &PreintegratedTable, front: f64, back: f64) -> [f64; 4] {
    table.between(table.node(front), table.node(back))
}

fn near(found: [f64; 4], expected: [f64; 4], tolerance: f64) {
    assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() <= tolerance), "{found:?} for {expected:?}");
}

#[test]
fn a_constant_medium_is_beers_law() {
    for step in [0.1, 1.0, 7.0] {
        let table = PreintegratedTable::new(&scene("haze", |s| s.sampling.step = step));
        let alpha = corrected_opacity(0.01, step);
        for [front, back] in [[0.0, 1.0], [0.3, 0.3], [1.0, 0.2]] {
            let [r, g, b, a] = look_up(&table, front, back);
            assert!((a - alpha).abs() < 1e-7, "{a} for {alpha}");
            // Its colour goes from black to white with the value, and hardly anything is absorbed on the way.
            let colour = 0.5 * (front + back) * alpha;
            near([r, g, b, a], [colour, colour, colour, alpha], 1e-7 + alpha * alpha);
        }
    }
}

#[test]
fn a_ramps_optical_depth_is_the_mean_along_it() {
    // The integral of -ln(1 - x) from 0 on.
    let sum = |x: f64| x + (1.0 - x) * (-x).ln_1p();
    let table = PreintegratedTable::new(&scene("linear", |_| {}));
    for (front, back) in [(0.1, 0.7), (0.7, 0.1), (0.0, 0.9), (0.45, 0.4501)] {
        let mean = (sum(back) - sum(front)) / (back - front);
        let [_, _, _, a] = look_up(&table, front, back);
        assert!((a + (-mean).exp_m1()).abs() < 2e-5, "{front} to {back}: {a}, not {}", -(-mean).exp_m1());
    }
}

#[test]
fn entries_are_the_exact_integral_and_the_order_of_values_counts() {
    let scene = scene("surface", |s| s.sampling.step = 2.0);
    let table = PreintegratedTable::new(&scene);
    let medium = Absorber::new(&scene.transfer);
    for (front, back) in [(0.1, 0.9), (0.9, 0.1), (0.31, 0.3), (0.0, 0.300001)] {
        near(look_up(&table, front, back), medium.ramp(front, back, 2.0), 2e-3);
    }
    let (in_front, behind) = (look_up(&table, 1.0, 0.3), look_up(&table, 0.3, 1.0));
    assert!(in_front[0] > behind[0] + 0.05, "the brighter end is nearer: {in_front:?} and {behind:?}");
    assert!((in_front[3] - behind[3]).abs() < 1e-6, "the way is as opaque in both directions");
}

#[test]
fn what_shows_nothing_shows_nothing_in_the_table() {
    for tf in ["ramp", "surface"] {
        let table = PreintegratedTable::new(&scene(tf, |_| {}));
        let knee = if tf == "ramp" { 0.25 } else { 0.3f64.next_down() };
        for front in [0.0, 0.1, 0.2499999, knee] {
            for back in [0.0, 0.2, 0.2499999, knee] {
                assert_eq!(look_up(&table, front, back), [0.0; 4], "{tf}: {front} to {back}");
            }
        }
        assert!(look_up(&table, 0.0, 0.31)[3] > 0.0);
    }
}

#[test]
fn values_beyond_the_transfer_function_are_on_the_axes() {
    let scene = scene("linear", |s| s.volume.range = Some([0.2, 0.6].map(Into::into)));
    let table = PreintegratedTable::new(&scene);
    let low = scene.field.values.iter().copied().fold(f32::INFINITY, f32::min);
    let high = scene.field.values.iter().copied().fold(f32::NEG_INFINITY, f32::max);
    assert!(low < 0.0 && high > 1.0, "{low} {high}");
    assert_eq!(table.node(f64::from(low)), 0.0);
    assert_eq!(table.node(f64::from(high)), (table.nodes - 1) as f64);
    assert_eq!(look_up(&table, f64::from(low), 0.0), [0.0; 4]);
    assert_eq!(look_up(&table, 1.0, f64::from(high))[3], 1.0);
    // Half of the way lies before the first point, where nothing shows.
    let exact = Absorber::new(&scene.transfer).ramp(-0.25, 0.25, 1.0);
    near(look_up(&table, -0.25, 0.25), exact, 1e-4);
}

#[test]
fn a_part_of_a_step_has_its_part_of_the_optical_depth() {
    let whole = [0.3, 0.2, 0.1, 0.75];
    near(part_of(whole, 0.5, Alpha::Exponential), [0.2, 0.4 / 3.0, 0.2 / 3.0, 0.5], 1e-15);
    near(part_of(whole, 0.5, Alpha::Paper), whole.map(|c| 0.5 * c), 1e-15);
    assert_eq!(part_of(whole, 1.0, Alpha::Exponential), whole);
    assert_eq!(part_of([0.0; 4], 0.5, Alpha::Exponential), [0.0; 4]);
}

#[test]
fn scenes_without_values_along_the_ray_are_refused() {
    let refused = |scene: &Scene, part: &str| {
        let error = plan::plan(scene, None).unwrap_err().to_string();
        assert!(error.contains("--classification") && error.contains(part), "{error}");
    };
    refused(&scene("ramp", |s| s.sampling.offset = Offset::Midpoint), "--offset left");
    let mut holes = scene("ramp", |_| {});
    let field = std::sync::Arc::make_mut(&mut holes.field);
    field.holes = Some(vec![false; field.cells().iter().product()]);
    refused(&holes, "--nan replace");
    let points: Vec<[f64; 5]> = (0..600).map(|i| [f64::from(i) / 600.0, 1.0, 1.0, 1.0, 0.1]).collect();
    let many = |s: &mut Settings| (s.transfer.preset, s.transfer.points) = (None, Some(points.clone()));
    refused(&scene("ramp", many), "600");
}
