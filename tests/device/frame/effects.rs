//! Effects on a device: what changes nothing changes no bit, what halves opacities is a transfer function of half of them, and what an
//! effect is told is true. By fragment and compute shaders, with leaps and without.

use std::sync::Arc;

use depthleap::method::METHODS;
use depthleap::part::rows::Method;
use depthleap::scene::settings::{Gradients, LightSettings, Refine, Settings, Shows, SurfaceLevel};
use depthleap::scene::{Effect, Scene};
use depthleap::vulkan::Device;

use super::compare::same_picture;
use super::scenes::{Stage, VIEWS, by, exactly, loops_in_turn, scene, seen};
use crate::harness::{Test, share, test};

pub fn tests() -> Vec<Test> {
    vec![
        test("effects::that_change_nothing_change_no_bit", same),
        test("effects::half_the_opacity_is_a_transfer_function_of_half_of_it", half),
        test("effects::a_tint_is_a_transfer_function_of_its_colours", tint),
        test("effects::of_surfaces_change_their_colours", surfaces),
        test("effects::are_told_where_surfaces_are", told),
        test("effects::show_nothing_where_nothing_shows", nothing_new),
        test("effects::take_out_samples_and_numbers_that_are_none", taken_out),
    ]
}

type Change = fn(&mut Settings);

const SAME: &str = "vec4 effect(Sample here) { return here.color; }";

/// The loops whose turn it is: they share all of what effects are called from but the leaps.
fn loops(turn: usize) -> impl Iterator<Item = &'static Method> {
    METHODS.into_iter().filter(move |method| loops_in_turn(method, turn))
}

/// A scene that is seen from a side, on the way to a step that its opacities are corrected for.
fn of(change: impl FnOnce(&mut Settings)) -> Scene {
    let scene = scene("shells:20", "ramp", |s| {
        exactly(s);
        (s.image.size, s.sampling.step) = ([40, 30], 0.7);
        change(s);
    });
    seen(&scene, VIEWS[2])
}

fn with(scene: &Scene, text: &str) -> Scene {
    let effect = Effect::new("test.glsl", text).expect("a sound effect");
    Scene { effect: Some(Arc::new(effect)), ..scene.clone() }
}

/// The picture of `found` is that of `rule` by every loop, and shows something.
fn equal(device: &Arc<Device>, found: &Scene, rule: &Scene, what: &str, turn: usize) {
    let mut stages = [Stage::new(device), Stage::new(device)];
    for method in share(loops(turn), turn) {
        let scenes = [found, rule].map(|scene| by(scene, method.name()));
        let [found, rule] = [0, 1].map(|i| stages[i].shoot(&scenes[i], None).picture);
        assert!(rule.iter().any(|pixel| pixel[3] > 0.1), "{what}, {}: nothing shows", method.name);
        same_picture(&found, &rule).unwrap_or_else(|e| panic!("{what}, {}: {e}", method.name));
    }
}

fn white_light(s: &mut Settings) {
    s.lights = vec![LightSettings { direction: Some([-3.0, 2.0, 1.0]), ..Default::default() }];
}

fn same(device: &Arc<Device>) {
    let changes: [(&str, Change); 5] = [
        ("samples", |_| {}),
        ("opaque samples", |s| s.transfer.preset = Some("surface".to_owned())),
        ("samples in light", white_light),
        ("samples in light, by gradients in a texture", |s| {
            white_light(s);
            s.shading.gradients = Gradients::Precomputed;
        }),
        ("a surface", |s| s.surface.iso = Some(90.0)),
    ];
    for (turn, (what, change)) in changes.into_iter().enumerate() {
        let scene = of(change);
        equal(device, &with(&scene, SAME), &scene, what, turn);
    }
}

/// A scene whose transfer function has these factors of `x`, exactly.
fn colored(color: [f64; 3], opacity: f64) -> Scene {
    of(|s| {
        s.transfer.preset = None;
        let point = |x: f64, a: f64| [x, 0.9 * color[0], 0.7 * color[1], 0.3 * color[2], a * opacity];
        s.transfer.points = Some(vec![point(0.0, 0.0), point(0.25, 0.0), point(1.0, 0.8)]);
    })
}

fn half(device: &Arc<Device>) {
    let effect = "vec4 effect(Sample here) { return vec4(here.color.rgb, 0.5 * here.color.a); }";
    equal(device, &with(&colored([1.0; 3], 1.0), effect), &colored([1.0; 3], 0.5), "half", 0);
}

/// Halves and quarters are exact in f32.
fn tint(device: &Arc<Device>) {
    let effect = "vec4 effect(Sample here) { return here.color * vec4(1.0, 0.5, 0.25, 1.0); }";
    let rule = colored([1.0, 0.5, 0.25], 1.0);
    equal(device, &with(&colored([1.0; 3], 1.0), effect), &rule, "a tint", 1);
}

fn surface(color: [f64; 3]) -> Scene {
    of(|s| s.surface.levels = vec![SurfaceLevel { iso: 90.0, color: Some(color), ..SurfaceLevel::default() }])
}

fn surfaces(device: &Arc<Device>) {
    let effect = "vec4 effect(Sample here) { return vec4(0.5 * here.color.rgb, 0.0); }";
    equal(device, &with(&surface([0.8, 0.6, 0.2]), effect), &surface([0.4, 0.3, 0.1]), "half a surface", 2);
}

/// What surfaces show themselves, effects are told.
fn told(device: &Arc<Device>) {
    let shown =
        |shows: Shows| of(|s| (s.surface.iso, s.surface.refine, s.surface.shows) = (Some(90.0), Refine::Exact, shows));
    let scene = shown(Shows::Color);
    let place = "vec4 effect(Sample here) { return vec4(here.position, 1.0); }";
    equal(device, &with(&scene, place), &shown(Shows::Position), "places", 0);
    let normal = "vec4 effect(Sample here) { return vec4(sample_normal(here), 1.0); }";
    equal(device, &with(&scene, normal), &shown(Shows::Normal), "normals", 1);
    let others = "vec4 effect(Sample here) { return vec4(here.value, vec2(here.pixel), 1.0); }";
    let [width, _] = scene.settings.image.size;
    for method in loops(2) {
        let shot = Stage::new(device).shoot(&by(&with(&scene, others), method.name()), None);
        let hits: Vec<_> = shot.picture.iter().enumerate().filter(|(_, pixel)| pixel[3] > 0.0).collect();
        assert!(hits.len() > 100, "{}: {} hits", method.name, hits.len());
        for (i, [value, column, row, _]) in hits {
            // Rays that begin within have another value than that of the surface, and none does here.
            assert!((value - 90.0).abs() < 0.01, "{}: pixel {i} has the value {value}", method.name);
            assert_eq!([*column, *row], [i as u32 % width, i as u32 / width].map(|n| n as f32), "{}", method.name);
        }
    }
}

/// Opaque wherever it is asked: nothing where the transfer function shows nothing, and loops that leap have the picture of those that
/// do not.
fn nothing_new(device: &Arc<Device>) {
    // From outside, where some rays meet nothing that shows.
    let scene = seen(&of(|_| {}), VIEWS[1]);
    let scene = with(&scene, "vec4 effect(Sample here) { return vec4(here.coordinate, 1.0); }");
    let mut rules = std::collections::BTreeMap::new();
    for method in METHODS.into_iter().filter(|method| method.loops() && !method.goes_through_cells()) {
        let mut stage = Stage::new(device);
        let mut shoot = |method: &Method| stage.shoot(&by(&scene, method.name()), None).picture;
        let rule: &Vec<[f32; 4]> = rules.entry(method.unskipped().name).or_insert_with(|| shoot(method.unskipped()));
        assert!(rule.iter().any(|pixel| pixel[3] == 1.0) && rule.iter().any(|pixel| pixel[3] == 0.0));
        same_picture(&shoot(method), rule).unwrap_or_else(|e| panic!("{}: {e}", method.name));
    }
}

/// Opacity 0 leaves out a sample, and so does one that is no number, whatever its colour is.
fn taken_out(device: &Arc<Device>) {
    let scene = of(|_| {});
    let colors = ["vec4(9.0, 9.0, 9.0, 0.0)", "vec4(9.0, 9.0, 9.0, -3.0)", "vec4(vec3(1.0 / zero), zero / zero)"];
    for (turn, color) in colors.into_iter().enumerate() {
        let text = format!("vec4 effect(Sample here) {{ float zero = here.color.a - here.color.a; return {color}; }}");
        for method in share(loops(turn), turn) {
            let shot = Stage::new(device).shoot(&by(&with(&scene, &text), method.name()), None);
            assert!(shot.picture.iter().all(|pixel| *pixel == [0.0; 4]), "{}: {color}", method.name);
        }
    }
}
