//! What iso-surfaces reflect: where directions lie in a picture, what a surface makes of it, and what is refused, held against
//! closed forms. Needs no device.

#[path = "drawn/mod.rs"]
mod drawn;
#[path = "environment/files.rs"]
mod files;
#[path = "environment/places.rs"]
mod places;

use std::sync::Arc;

use depthleap::feature::ENVIRONMENT;
use depthleap::method::{METHODS, RC_ERT};
use depthleap::plan::{Plan, plan, warnings};
use depthleap::read;
use depthleap::scene::environment::Picture;
use depthleap::scene::settings::{Filter, Mapping, MeshSettings, Refine, Settings};
use depthleap::scene::{Environment, Scene, builtin};
use depthleap::shared::environment_rows;
use depthleap::truth::exact::ExactIntegrator;
use drawn::drawn;
use glam::{DQuat, DVec3};

const SIZE: [u32; 2] = [100, 80];

fn constant(color: [f32; 3], reflectivity: f64) -> Environment {
    let picture = Picture { size: [3, 2], texels: vec![color; 6] };
    Environment { picture, reflectivity, ..places::told([1, 1], Mapping::Latlong) }
}

/// A Gaussian's surface, or what `change` makes of it.
fn scene(change: impl FnOnce(&mut Settings)) -> Scene {
    read::scene(&settings(change)).unwrap()
}

fn settings(change: impl FnOnce(&mut Settings)) -> Settings {
    let mut settings = Settings::default();
    settings.volume.builtin = Some("gaussian:32".to_owned());
    (settings.surface.iso, settings.surface.refine) = (Some(ISO), Refine::Exact);
    settings.image.size = SIZE;
    settings.camera.eye = [0.9, 0.65, 1.5];
    settings.sampling.filter = Filter::Exact;
    settings.method.name = RC_ERT.name();
    change(&mut settings);
    settings
}

const ISO: f64 = 0.2;

fn reflects(name: &str, part: f64) -> impl FnOnce(&mut Settings) {
    let name = name.to_owned();
    move |s| (s.environment.builtin, s.environment.reflectivity) = (Some(name), part)
}

fn apart<const N: usize>(a: [f64; N], b: [f64; N]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

#[test]
fn constant_environment_takes_its_part_of_every_lit_colour() {
    let color = [0.25f32, 1.5, 4.0];
    let plain = scene(|_| {});
    let (_, lit) = drawn(&plain);
    for part in [0.0, 0.3, 1.0] {
        let mixed = Scene { environment: Some(Arc::new(constant(color, part))), ..plain.clone() };
        let (_, frame) = drawn(&mixed);
        for (found, lit) in frame.pixels.iter().zip(&lit.pixels) {
            let [r, g, b] = std::array::from_fn(|c| (1.0 - part) * lit[c] + part * f64::from(color[c]) * lit[3]);
            assert!(apart(*found, [r, g, b, lit[3]]) < 1e-12, "{part}: {found:?} of {lit:?}");
        }
        // What is alike everywhere leaves nothing open.
        assert!(frame.undecided.iter().zip(&lit.undecided).all(|(open, before)| open <= before));
    }
}

#[test]
fn place_without_a_normal_reflects_nothing() {
    let flat = |part| {
        scene(|s| {
            (s.volume.builtin, s.surface.iso) = (Some("constant:8".to_owned()), Some(0.4));
            reflects("sky", part)(s);
        })
    };
    let [mirror, none] = [1.0, 0.0].map(|part| drawn(&flat(part)).1);
    assert!(mirror.counts.light > 300 && mirror.pixels == none.pixels);
    let environment = constant([1.0; 3], 1.0);
    assert_eq!(environment.on([0.1, 0.2, 0.3], DVec3::ZERO, DVec3::Z), [0.1, 0.2, 0.3]);
}

#[test]
fn mirror_shows_what_a_ball_reflects() {
    let mut scene = scene(|s| {
        s.volume.builtin = Some("gaussian:96".to_owned());
        reflects("sky", 1.0)(s);
    });
    // Texels that tell their places, so that no direction is taken for another one.
    scene.environment = Some(Environment { reflectivity: 1.0, ..places::told([32, 16], Mapping::Latlong) }.into());
    let (plan, frame) = drawn(&scene);
    let (rays, size) = (plan.view.rays, plan.view.size);
    let exact = ExactIntegrator::of(&scene).picture(&rays, size);
    let environment = scene.environment.as_ref().unwrap();
    // The Gaussian's surface is a ball about the centre.
    let radius = 0.5 * 0.3 * (-2.0 * ISO.ln()).sqrt();
    let (mut errors, mut of_frame): (Vec<f64>, Vec<f64>) = (Vec::new(), Vec::new());
    for (i, (exact, frame)) in exact.iter().zip(&frame.pixels).enumerate() {
        let direction = rays.of(i as u32 % size[0], i as u32 / size[0]).direction.normalize();
        let middle = rays.origin.dot(direction);
        let inside = middle * middle - rays.origin.length_squared() + radius * radius;
        if exact[3] == 0.0 || frame[3] == 0.0 || inside < 0.01 {
            continue;
        }
        let normal = (rays.origin + (-middle - inside.sqrt()) * direction) / radius;
        let seen = environment.color(direction - 2.0 * direction.dot(normal) * normal);
        errors.push(apart([exact[0], exact[1], exact[2]], seen));
        of_frame.push(apart([frame[0], frame[1], frame[2]], seen));
    }
    errors.sort_by(f64::total_cmp);
    of_frame.sort_by(f64::total_cmp);
    assert!(errors.len() > 100, "{} rays meet the ball", errors.len());
    let usual = [errors[errors.len() / 2], of_frame[of_frame.len() / 2]];
    println!("usual errors {usual:?}, largest {:?}", [errors.last(), of_frame.last()]);
    assert!(usual[0] < 0.15 && usual[1] < 0.05, "{usual:?}");
}

#[test]
fn few_pixels_are_undecided() {
    let shown = |s: &mut Settings| {
        s.meshes = vec![MeshSettings { translate: [0.8, 0.0, 0.2], ..ball(1.0) }];
        (s.volume.builtin, s.surface.iso) = (Some("torus:32".to_owned()), Some(0.3));
    };
    for name in ["sky", "polygons"] {
        let scene = scene(|s| {
            shown(s);
            reflects(name, 0.5)(s);
        });
        let (_, frame) = drawn(&scene);
        let undecided = frame.undecided.iter().filter(|open| **open).count() as u64;
        println!("{name}: {undecided} undecided, {} on outlines", frame.outline);
        // One in fifty that are lit: where rays touch the surface, and where an edge is reflected that hardly bends.
        let (lit, most) = (frame.counts.light, frame.counts.light / 50 + frame.outline);
        assert!(lit > 300 && undecided <= most, "{name}: {undecided} of {lit}, {}", frame.outline);
    }
}

fn ball(opacity: f64) -> MeshSettings {
    MeshSettings {
        builtin: Some("sphere".to_owned()),
        color: [0.9, 0.05, 0.1],
        opacity,
        scale: 0.4,
        ..MeshSettings::default()
    }
}

#[test]
fn polygons_are_seen_from_the_centre_in_front_of_the_sky() {
    let of = |opacity: f64| {
        let settings = settings(|s| {
            s.meshes = vec![MeshSettings { translate: [0.9, 0.0, 0.0], ..ball(opacity) }];
            reflects("polygons", 0.5)(s);
        });
        read::scene(&settings).unwrap()
    };
    let (opaque, clear) = (of(1.0), of(0.5));
    let sky = scene(reflects("sky", 0.5)).environment.unwrap();
    let [shown, bare] = [&opaque, &clear].map(|scene| scene.environment.clone().unwrap());
    // Its middle faces the camera there, and so the light.
    assert!(apart(shown.color(DVec3::X), [0.9, 0.05, 0.1]) < 0.02, "{:?}", shown.color(DVec3::X));
    for away in [DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z] {
        assert!(apart(shown.color(away), sky.color(away)) < 0.03, "{away}");
    }
    // Transparent meshes are not seen, of which there is a warning.
    assert_eq!(bare.picture, sky.picture);
    assert!(
        warnings(&clear, &plan(&clear, RC_ERT.papers).unwrap()).iter().any(|warning| warning.contains("sky alone"))
    );
    assert!(opaque.environment.as_ref().unwrap().warnings.is_empty());
    // A volume that lies askew has its polygons in its own axes.
    let turn = DQuat::from_rotation_y(0.7) * DQuat::from_rotation_x(-0.4);
    let turned = Environment { picture: Picture::of_polygons(&opaque.polygons, turn), turn, ..(*shown).clone() };
    assert!(apart(turned.color(turn * DVec3::X), [0.9, 0.05, 0.1]) < 0.02);
    let reflected = turned.reflected(DVec3::new(1.0, 0.0, 1.0), DVec3::Z).unwrap();
    assert!(reflected.distance(turn * DVec3::X) < 1e-12, "{reflected}");
    // Shaders turn by three rows, and find the part beside them.
    let rows = environment_rows(&turned);
    let by_rows = [0, 1, 2].map(|axis| f64::from(rows[axis][0]));
    assert!(apart(by_rows, (turn * DVec3::X).to_array()) < 1e-7 && rows[3] == [0.5, 0.0, 0.0, 0.0], "{rows:?}");
}

#[test]
fn torus_is_the_same_all_around_its_ring() {
    let torus = builtin::find("torus").unwrap();
    for angle in [0.0, 0.9, 2.0, 4.4f64] {
        let out = DVec3::new(angle.cos(), 0.0, angle.sin());
        assert!((torus.value(0.55 * out) - 1.0).abs() < 1e-12);
        let beside = [0.45 * out, 0.65 * out, 0.55 * out + 0.1 * DVec3::Y].map(|p| torus.value(p));
        assert!(beside.iter().all(|value| (value - (-0.5 * (0.1f64 / 0.14).powi(2)).exp()).abs() < 1e-12));
    }
    assert_eq!(torus.gradient(DVec3::new(0.0, 0.2, 0.0)).x, 0.0);
    assert!(torus.value(DVec3::X) < 0.01 && torus.value(DVec3::new(0.55, 1.0, 0.0)) < 0.01);
}

#[test]
fn what_has_no_meaning_with_an_environment_is_refused() {
    let planned = |change: fn(&mut Settings)| {
        let scene = read::scene(&settings(change)).map_err(|e| e.to_string())?;
        plan(&scene, RC_ERT.papers).map(drop).map_err(|e| e.to_string())
    };
    assert_eq!(planned(|s| s.environment.builtin = Some("sky".to_owned())), Ok(()));
    type Change = fn(&mut Settings);
    let cases: [(Change, &str); 6] = [
        (|s| s.environment.builtin = Some("skye".to_owned()), "did you mean `sky`?"),
        (
            |s| (s.environment.builtin, s.environment.image) = (Some("sky".to_owned()), Some("a.png".into())),
            "has both image and builtin",
        ),
        (
            |s| (s.environment.builtin, s.environment.mapping) = (Some("sky".to_owned()), Mapping::Sphere),
            "environment.mapping (--mapping sphere)",
        ),
        (|s| (s.environment.builtin, s.surface.iso) = (Some("sky".to_owned()), None), "add one (--iso VALUE"),
        (|s| s.environment.reflectivity = 1.5, "environment.reflectivity (--reflectivity)"),
        (|s| s.environment.reflectivity = f64::NAN, "environment.reflectivity (--reflectivity)"),
    ];
    for (change, says) in cases {
        let error = planned(change).expect_err(says);
        assert!(error.contains(says), "{error} does not say {says}");
    }
}

/// Whether a plan has anything of an environment: resources, or defines of its shaders.
fn has_environment(plan: &Plan) -> [bool; 2] {
    let named = plan.resources().iter().any(|resource| resource.name().starts_with("environment"));
    let mut shaders = plan.steps.iter().filter_map(|step| step.work.shader());
    let defined = shaders.any(|shader| shader.defines.contains("ENVIRONMENT"));
    [named, defined]
}

#[test]
fn scenes_without_an_environment_have_nothing_of_it() {
    let [without, with, none] =
        [scene(|_| {}), scene(reflects("sky", 0.5)), scene(reflects("sky", 0.0))].map(|scene| {
            move |method| {
                let mut scene = scene.clone();
                scene.settings.method.name = method;
                scene
            }
        });
    for method in METHODS.into_iter().filter(|method| (method.takes)(&with(method.name())).is_ok()) {
        let plan = |scene: &Scene| plan(scene, method.papers).unwrap();
        let plain = plan(&without(method.name()));
        assert_eq!(has_environment(&plain), [false; 2], "{}", method.name);
        assert!(plain.left_out.iter().all(|left| left.what != ENVIRONMENT.name));
        let there = plan(&with(method.name()));
        assert_eq!(has_environment(&there), [true; 2], "{}", method.name);
        // Where nothing is reflected it is left out, unless nothing may be.
        let mut scene = none(method.name());
        let left = plan(&scene);
        assert_eq!(has_environment(&left), [false; 2], "{}", method.name);
        assert!(left.left_out.iter().any(|left| left.what == ENVIRONMENT.name && left.why.contains("reflectivity")));
        scene.settings.method.planner = false;
        assert_eq!(has_environment(&plan(&scene)), [true; 2], "{}", method.name);
    }
}
