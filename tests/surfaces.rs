//! Iso-surfaces: where rays meet them and which normals they have, held against closed forms and against roots of the interpolant;
//! lights; what is refused. Needs no device.

#[path = "drawn/mod.rs"]
mod drawn;
#[path = "surfaces/numbers.rs"]
mod numbers;

use depthleap::method::{METHODS, RC_ERT};
use depthleap::plan::{plan, warnings};
use depthleap::read;
use depthleap::scene::light::{Light, LightPlace, LitPoint, lit};
use depthleap::scene::settings::{
    Accumulate, Classification, ClipSettings, Filter, Find, LightSettings, MeshSettings, Offset, Refine, Settings,
    Shows, SurfaceLevel,
};
use depthleap::scene::{Scene, builtin};
use depthleap::truth::exact::ExactIntegrator;
use drawn::drawn;
use glam::DVec3;

const SIZE: [u32; 2] = [100, 80];

/// The pixel in the middle.
const MIDDLE: usize = 100 * 40 + 50;

fn scene(volume: &str, iso: f64, change: impl FnOnce(&mut Settings)) -> Scene {
    read::scene(&settings(volume, iso, change)).unwrap()
}

fn settings(volume: &str, iso: f64, change: impl FnOnce(&mut Settings)) -> Settings {
    let mut settings = Settings::default();
    settings.volume.builtin = Some(volume.to_owned());
    settings.surface.iso = Some(iso);
    settings.image.size = SIZE;
    settings.camera.eye = [0.9, 0.65, 1.5];
    settings.sampling.filter = Filter::Exact;
    settings.method.name = RC_ERT.name();
    change(&mut settings);
    settings
}

/// A place on a surface as a frame has it, and the root of the interpolant, both in volume space.
struct Found {
    place: DVec3,
    root: DVec3,
    /// Where the ray enters the volume.
    entry: DVec3,
    /// Along the gradient by central differences, of length 1.
    normal: DVec3,
}

/// Where the rays of a frame meet surfaces, of those whose exact ray meets one too.
fn found(scene: &Scene) -> Vec<Found> {
    let (plan, frame) = drawn(scene);
    let (rays, step) = (plan.view.rays, scene.settings.sampling.step * scene.field.finest());
    let ranges: Vec<[f64; 2]> = scene.surface.iter().flat_map(|s| &s.levels).map(|level| level.values).collect();
    let integrator = ExactIntegrator::of(scene);
    let mut all = Vec::new();
    for (i, met) in frame.surfaces.iter().enumerate() {
        let ray = rays.of(i as u32 % plan.view.size[0], i as u32 / plan.view.size[0]);
        let direction = ray.direction;
        let (Some(met), Some((enter, leave))) = (met, scene.interval(&ray, rays.near)) else { continue };
        let (entry, unit) = (rays.origin + enter * direction, direction.normalize());
        let length = (leave - enter) * direction.length();
        let root = integrator.first_within(entry, unit, length, &ranges);
        all.extend(root.map(|root| Found {
            place: entry + met.steps * step * unit,
            root: entry + root.t * unit,
            entry,
            normal: met.normal.normalize(),
        }));
    }
    assert!(all.len() > 300, "{} rays meet the surface", all.len());
    all
}

/// The median distance of places from the roots of the interpolant, along rays; rays that only touch a surface are off by more.
fn usual_error(scene: &Scene) -> f64 {
    let mut all: Vec<f64> = found(scene).iter().map(|one| one.place.distance(one.root)).collect();
    all.sort_by(f64::total_cmp);
    all[all.len() / 2]
}

/// The order in which an error falls while something is halved.
fn order(errors: &[f64]) -> f64 {
    (errors[0] / errors[errors.len() - 1]).log2() / (errors.len() - 1) as f64
}

#[test]
fn places_are_of_the_order_of_their_refinement() {
    let error = |refine: Refine, step: f64| {
        usual_error(&scene("gaussian:24", 0.4, |s| (s.surface.refine, s.sampling.step) = (refine, step)))
    };
    for (refine, expected) in [(Refine::None, 1.0), (Refine::Linear, 2.0)] {
        let errors = [2.0, 1.0, 0.5, 0.25].map(|step| error(refine, step));
        let found = order(&errors);
        println!("{refine:?}: {errors:?}, order {found:.2}");
        assert!((found - expected).abs() < 0.25, "{refine:?}: order {found} of {errors:?}");
    }
    // But for the slack by which values are on a surface.
    for step in [2.0, 1.0, 0.5] {
        let exact = error(Refine::Exact, step);
        println!("Exact: {exact:e}");
        assert!(exact < 1e-6, "{exact:e} with steps of {step}");
    }
}

#[test]
fn normals_by_central_differences_are_of_the_second_order() {
    let gaussian = builtin::find("gaussian").unwrap();
    let error = |side: usize| {
        let all = found(&scene(&format!("gaussian:{side}"), 0.4, |s| s.surface.refine = Refine::Exact));
        let angle = |one: &Found| {
            let truth = gaussian.gradient(2.0 * one.place).normalize();
            one.normal.cross(truth).length().asin()
        };
        all.iter().map(angle).fold(0.0, f64::max)
    };
    let errors = [24, 48, 96].map(error);
    let found = order(&errors);
    println!("{errors:?}, order {found:.2}");
    assert!((1.8..2.3).contains(&found), "order {found} of {errors:?}");
}

#[test]
fn plane_is_where_it_is() {
    // x rises evenly: along a ray the linear place is the exact one.
    for refine in [Refine::Linear, Refine::Exact] {
        for one in found(&scene("linear:20", 0.5, |s| (s.surface.refine, s.camera.eye) = (refine, [-1.6, 0.4, 0.9]))) {
            // Others begin behind the plane.
            if one.root == one.entry {
                continue;
            }
            assert!(one.place.x.abs() < 2e-6, "{refine:?}: {}", one.place);
            assert!(one.normal.abs().distance(DVec3::X) < 1e-6, "{}", one.normal);
        }
    }
}

#[test]
fn ray_that_begins_inside_meets_the_surface_where_it_begins() {
    let gray = 0.6;
    let scene = scene("constant:8", 0.5, |s| {
        let level = SurfaceLevel { iso: 0.5, color: Some([gray; 3]), opacity: 1.0 };
        (s.surface.iso, s.surface.levels) = (None, vec![level]);
    });
    let (plan, frame) = drawn(&scene);
    let met: Vec<_> = frame.surfaces.iter().flatten().collect();
    assert!(met.len() > 300 && met.iter().all(|met| met.steps == 0.0), "on the faces of the volume");
    // Without a gradient there is ambient light alone.
    let lit = frame.pixels.iter().filter(|pixel| pixel[3] > 0.0);
    assert!(lit.clone().all(|pixel| (pixel[0] - 0.3 * gray).abs() < 1e-12), "{:?}", lit.clone().next());
    assert_eq!(frame.counts.light, met.len() as u64);
    assert!(plan.steps.iter().any(|step| step.name == "lighting"));
}

#[test]
fn nearest_of_several_surfaces_wins_and_has_its_colour() {
    let level = |iso: f64, color: [f64; 3]| SurfaceLevel { iso, color: Some(color), opacity: 1.0 };
    let (red, green) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
    let of = |x: f64| {
        scene("linear:16", 0.0, |s| {
            (s.surface.iso, s.surface.levels) = (None, vec![level(0.7, green), level(0.4, red)]);
            (s.camera.eye, s.camera.target) = ([x, 0.1, 0.05], [0.0; 3]);
        })
    };
    let middle = |scene: &Scene| drawn(scene).1.pixels[MIDDLE];
    // From low values the lower surface comes first; from high ones the ray begins within both, on the face.
    let [r, g, ..] = middle(&of(-1.9));
    assert!(r > 0.5 && g == 0.0, "{r} {g}");
    let [r, g, ..] = middle(&of(1.9));
    assert!(r == 0.0 && g > 0.5, "{r} {g}");
}

#[test]
fn range_of_values_is_met_from_both_sides() {
    let place = |x: f64, refine: Refine| {
        let scene = scene("linear:16", 0.5, |s| {
            (s.surface.find, s.surface.iso_width, s.surface.refine) = (Find::Range, Some(0.2), refine);
            (s.camera.eye, s.camera.target) = ([x, 0.1, 0.05], [0.0; 3]);
        });
        let (_, frame) = drawn(&scene);
        let met = frame.surfaces[MIDDLE].unwrap();
        met.steps * scene.field.finest()
    };
    for x in [-1.9, 1.9] {
        // The nearer end of the range, 0.1 in front of the middle.
        let (exact, sample) = (place(x, Refine::Exact), place(x, Refine::None));
        assert!((0.4 - exact).abs() < 2e-3 && sample >= exact && sample < exact + 1.0 / 16.0, "{exact} {sample}");
    }
}

#[test]
fn light_follows_the_model_of_phong() {
    let light = |place: LightPlace| Light {
        place,
        ambient: [0.1, 0.2, 0.3],
        diffuse: [0.5; 3],
        specular: [0.4; 3],
        shininess: 10.0,
    };
    let color = [0.5, 1.0, 0.25];
    let point = LitPoint { place: DVec3::ZERO, normal: DVec3::Z, view: DVec3::Z };
    let away = |x: f64, z: f64| light(LightPlace::Direction(DVec3::new(x, 0.0, z).normalize()));
    let ambient: [f64; 3] = std::array::from_fn(|c| color[c] * [0.1, 0.2, 0.3][c]);
    let near = |a: [f64; 3], b: [f64; 3]| (0..3).all(|c| (a[c] - b[c]).abs() < 1e-12);
    // From the eye: all of it.
    let all = std::array::from_fn(|c| ambient[c] + 0.5 * color[c] + 0.4);
    assert!(near(lit(color, &[away(0.0, 1.0)], &point), all));
    // Aslant: by the cosine, and by that of half the angle to the tenth.
    let aslant = std::array::from_fn(|c| ambient[c] + 0.5 * color[c] * 0.5 + 0.4 * 0.75f64.sqrt().powi(10));
    assert!(near(lit(color, &[away(3.0f64.sqrt(), 1.0)], &point), aslant));
    // Both sides are lit, and a normal may have any length.
    let turned = LitPoint { normal: -1e-9 * DVec3::Z, ..point };
    assert!(near(lit(color, &[away(0.0, 1.0)], &turned), all));
    // From behind, without a normal, and in the light itself: ambient alone.
    assert!(near(lit(color, &[away(0.3, -1.0)], &point), ambient));
    assert!(near(lit(color, &[away(0.0, 1.0)], &LitPoint { normal: DVec3::ZERO, ..point }), ambient));
    assert!(near(lit(color, &[light(LightPlace::Position(DVec3::ZERO))], &point), ambient));
    // The exponent 0 makes all that is lit shine.
    let flat = Light { shininess: 0.0, ..away(2.0, 1.0) };
    assert!(lit(color, &[flat], &point)[0] > ambient[0] + 0.4);
    // Lights add up.
    let two = lit(color, &[away(0.0, 1.0), away(0.3, -1.0)], &point);
    assert!(near(two, std::array::from_fn(|c| all[c] + ambient[c])));
}

#[test]
fn what_has_no_meaning_with_surfaces_or_lights_is_refused() {
    let planned = |change: fn(&mut Settings)| {
        let scene = read::scene(&settings("shells:12", 90.0, change)).map_err(|e| e.to_string())?;
        plan(&scene, RC_ERT.papers).map(drop).map_err(|e| e.to_string())
    };
    assert_eq!(planned(|_| {}), Ok(()));
    type Change = fn(&mut Settings);
    let cases: [(Change, &str); 15] = [
        (|s| s.projection.kind = depthleap::projection::MIP.name(), "--projection mip"),
        (|s| s.sampling.classification = Classification::PreIntegrated, "pre-integrated"),
        (|s| s.sampling.offset = Offset::Midpoint, "midpoint"),
        (|s| s.sampling.filter = Filter::Nearest, "--refine none"),
        (|s| s.surface.levels = vec![SurfaceLevel { iso: 90.0, color: None, opacity: 0.5 }], "opacity below 1"),
        (|s| s.surface.levels = vec![SurfaceLevel { iso: f64::NAN, color: None, opacity: 1.0 }], "the iso value NaN"),
        (|s| s.surface.iso = Some(f64::INFINITY), "surface.iso (--iso)"),
        (|s| s.surface.iso_width = Some(-1.0), "--iso-width"),
        (|s| (s.surface.shows, s.image.accumulate) = (Shows::Position, Accumulate::Rgba16f), "--accumulate rgba16f"),
        (|s| (s.surface.shows, s.image.accumulate) = (Shows::Normal, Accumulate::Rgba8), "use rgba32f"),
        (
            |s| {
                s.surface.shows = Shows::Normal;
                s.meshes = vec![MeshSettings { builtin: Some("box".to_owned()), ..MeshSettings::default() }];
            },
            "would be blended with the places or normals",
        ),
        (|s| s.lights = vec![LightSettings::default()], "light.direction: is missing"),
        (|s| s.lights = vec![LightSettings { direction: Some([0.0; 3]), ..Default::default() }], "has the length 0"),
        (
            |s| s.lights = vec![LightSettings { direction: Some([1.0; 3]), ..Default::default() }; 9],
            "light: has 9 tables; keep them to 8",
        ),
        (
            |s| {
                s.surface.iso = None;
                s.lights = vec![LightSettings { direction: Some([1.0; 3]), ..Default::default() }];
                s.projection.kind = depthleap::projection::XRAY.name();
            },
            "lights shine on colours",
        ),
    ];
    for (change, says) in cases {
        let error = planned(change).expect_err(says);
        assert!(error.contains(says), "{error} does not say {says}");
    }
}

#[test]
fn value_that_nothing_reaches_gives_an_empty_picture_and_a_hint() {
    for (find, hint) in [(Find::Crossing, "no value reaches 300"), (Find::Range, "in the range about 300")] {
        let scene = scene("shells:12", 300.0, |s| s.surface.find = find);
        let (plan, frame) = drawn(&scene);
        assert!(frame.pixels.iter().all(|pixel| *pixel == [0.0; 4]));
        let warnings = warnings(&scene, &plan);
        assert!(warnings.iter().any(|warning| warning.contains(hint) && warning.contains("0 to")), "{warnings:?}");
    }
}

#[test]
fn voxels_of_the_very_value_are_on_the_surface() {
    // A plateau of the value itself: every ray that meets it is on it, whatever f32 makes of the value.
    let scene = scene("constant:8", 0.5, |s| s.surface.refine = Refine::Exact);
    let (_, frame) = drawn(&scene);
    let there = frame.counts.light;
    assert!(there > 300 && frame.undecided.iter().filter(|open| **open).count() as u64 <= frame.outline);
    // A range beside the value has nothing of it, though the scalar range is that one value.
    for iso in [0.3, 0.7] {
        let beside =
            self::scene("constant:8", iso, |s| (s.surface.find, s.surface.iso_width) = (Find::Range, Some(0.1)));
        assert_eq!(drawn(&beside).1.counts.light, 0, "{iso}");
    }
    // As soon as the value is above, nothing is.
    let above = self::scene("constant:8", 0.5001, |_| {});
    assert_eq!(drawn(&above).1.counts.light, 0);
}

#[test]
fn planes_cut_surfaces_and_make_caps() {
    let cut = scene("gaussian:24", 0.4, |s| {
        s.clips = vec![ClipSettings { plane: Some([0.0, 0.0, -1.0, 0.0]), ..ClipSettings::default() }];
        (s.camera.eye, s.camera.target) = ([0.0, 0.0, 1.9], [0.0; 3]);
    });
    let (_, frame) = drawn(&cut);
    let middle = frame.surfaces[MIDDLE].unwrap();
    assert_eq!(middle.steps, 0.0, "in the middle the ray begins on the plane, within the surface");
}

#[test]
fn scene_without_surfaces_and_lights_has_nothing_of_them() {
    let scene = read::scene(&settings("shells:12", 0.0, |s| s.surface.iso = None)).unwrap();
    for method in METHODS.into_iter().filter(|method| method.takes_samples()) {
        let mut scene = scene.clone();
        scene.settings.method.name = method.name();
        let plan = plan(&scene, method.papers).unwrap();
        let names = ["surface_hit", "surface_levels", "lights"];
        assert!(plan.resources().iter().all(|resource| !names.contains(&resource.name())), "{}", method.name);
        assert!(plan.left_out.iter().all(|left| !left.what.contains("surface") || left.what == "opaque surface"));
    }
}
