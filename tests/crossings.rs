//! Surfaces that let something through, and surfaces in the volume: every crossing of every ray, in its order, held against closed
//! forms. Needs no device.

#[path = "drawn/mod.rs"]
mod drawn;

use depthleap::method::{METHODS, RC_ERT, SINGLE_PASS};
use depthleap::plan::plan;
use depthleap::read;
use depthleap::scene::settings::{
    Classification, ClipSettings, Filter, Find, LightSettings, MeshSettings, Refine, Settings, Shows, SurfaceLevel,
};
use depthleap::scene::volume::Voxels;
use depthleap::scene::{Scene, Volume};
use depthleap::truth::exact::ExactIntegrator;
use drawn::drawn;
use glam::DVec3;

const SIZE: [u32; 2] = [60, 48];

/// What products of some dozen numbers differ by in f64.
const ROUNDING: f64 = 1e-9;

/// How far the slack by which values are on a surface moves a place, and with it a colour.
const SLACK: f64 = 2e-5;

fn sheet(iso: f64, color: [f64; 3], opacity: f64) -> SurfaceLevel {
    SurfaceLevel { iso, color: Some(color), opacity }
}

/// A light that shows colours as they are, from whichever side.
fn even_light() -> LightSettings {
    LightSettings {
        direction: Some([0.0, 0.0, 1.0]),
        ambient: 1.0,
        diffuse: 0.0,
        specular: 0.0,
        ..LightSettings::default()
    }
}

fn settings(levels: Vec<SurfaceLevel>, change: impl FnOnce(&mut Settings)) -> Settings {
    let mut settings = Settings::default();
    settings.surface.levels = levels;
    settings.image.size = SIZE;
    settings.camera.eye = [0.3, 0.2, 1.9];
    settings.sampling.filter = Filter::Exact;
    settings.sampling.termination = 1.0;
    settings.lights = vec![even_light()];
    settings.method.name = SINGLE_PASS.name();
    change(&mut settings);
    settings
}

/// A scene of a volume of f32 voxels with that value at each, by its indices.
fn scene_of(settings: &Settings, side: usize, value: impl Fn(DVec3) -> f64) -> Scene {
    let at = |i: usize| DVec3::new((i % side) as f64, (i / side % side) as f64, (i / side / side) as f64);
    let voxels = Voxels::F32((0..side.pow(3)).map(|i| value(at(i)) as f32).collect());
    read::scene_of(settings, |_| Ok(Volume::new("test", [side; 3], [1.0; 3], voxels).unwrap())).unwrap()
}

fn built_in(settings: &Settings, volume: &str) -> Scene {
    let mut settings = settings.clone();
    settings.volume.builtin = Some(volume.to_owned());
    read::scene(&settings).unwrap()
}

/// What is seen of surfaces of these colours and opacities one behind the other, premultiplied.
fn behind_each_other(surfaces: &[([f64; 3], f64)]) -> [f64; 4] {
    surfaces.iter().fold([0.0; 4], |front, (color, opacity)| {
        let through = 1.0 - front[3];
        let [r, g, b] = color.map(|c| c * opacity * through);
        [front[0] + r, front[1] + g, front[2] + b, front[3] + opacity * through]
    })
}

fn apart(a: [f64; 4], b: [f64; 4]) -> f64 {
    (0..4).map(|c| (a[c] - b[c]).abs()).fold(0.0, f64::max)
}

/// The largest difference of two pictures.
fn largest(a: &[[f64; 4]], b: &[[f64; 4]]) -> f64 {
    a.iter().zip(b).map(|(a, b)| apart(*a, *b)).fold(0.0, f64::max)
}

/// The rays of a view: from where they enter the volume along a direction of length 1, and how far they go in it.
fn rays(scene: &Scene) -> Vec<Option<(DVec3, DVec3, f64)>> {
    let plan = plan(scene, None).unwrap();
    let [width, height] = plan.view.size;
    (0..width * height)
        .map(|i| {
            let ray = plan.view.rays.of(i % width, i / width);
            let direction = ray.direction;
            let (enter, leave) = scene.interval(&ray, plan.view.rays.near)?;
            let length = direction.length();
            Some((plan.view.rays.origin + enter * direction, direction / length, (leave - enter) * length))
        })
        .collect()
}

/// A sheet of one voxel between samples that lie three voxels apart.
#[test]
fn both_sides_of_a_thin_sheet_are_crossed_inside_a_step() {
    const OPACITY: f64 = 0.3;
    let crossed = |refine: Refine| {
        let settings = settings(vec![sheet(0.5, [1.0, 0.5, 0.25], OPACITY)], |s| {
            (s.surface.refine, s.sampling.step) = (refine, 3.0);
        });
        let (_, frame) = drawn(&scene_of(&settings, 16, |at| f64::from(at.z == 8.0)));
        let times = |n: i32| {
            let expected = 1.0 - (1.0 - OPACITY).powi(n);
            frame.pixels.iter().filter(|pixel| (pixel[3] - expected).abs() < ROUNDING).count()
        };
        let counts = [0, 1, 2].map(times);
        assert_eq!(counts.iter().sum::<usize>(), frame.pixels.len(), "{refine:?}");
        counts
    };
    let [_, once, twice] = crossed(Refine::Exact);
    assert!(twice > 200 && once < twice / 10, "{once} rays cross it once, {twice} twice");
    let [_, _, seen] = crossed(Refine::Linear);
    assert!(seen < twice / 2, "{seen} of {twice} are seen by samples");
}

/// Spheres one in the other: a ray that comes nearer to the centre than a radius crosses that sphere twice.
#[test]
fn spheres_are_crossed_from_outside_in_and_out_again() {
    const SIDE: usize = 32;
    const CENTRE: f64 = 0.5 * (SIDE as f64 - 1.0);
    // Radii in voxels; the value rises inwards.
    let radii = [12.0, 9.0, 5.0];
    let surfaces = [([0.9, 0.1, 0.2], 0.2), ([0.1, 0.8, 0.3], 0.35), ([0.2, 0.3, 1.0], 0.5)];
    let levels: Vec<_> = radii.iter().zip(surfaces).map(|(r, (color, opacity))| sheet(-r, color, opacity)).collect();
    for refine in [Refine::Linear, Refine::Exact] {
        let settings = settings(levels.clone(), |s| s.surface.refine = refine);
        let scene = scene_of(&settings, SIDE, |at| -(at - CENTRE).length());
        let (_, frame) = drawn(&scene);
        let mut seen = [0; 4];
        for (ray, pixel) in rays(&scene).into_iter().zip(&frame.pixels) {
            let Some((entry, direction, _)) = ray else { continue };
            let nearest = (entry - entry.dot(direction) * direction).length() * SIDE as f64;
            // On the outline of a sphere the interpolant has another one.
            if radii.iter().any(|radius| (nearest - radius).abs() < 0.6) {
                continue;
            }
            let count = radii.iter().filter(|radius| nearest < **radius).count();
            let inwards = surfaces[..count].iter();
            let all: Vec<_> = inwards.clone().chain(inwards.rev()).copied().collect();
            let expected = behind_each_other(&all);
            assert!(apart(*pixel, expected) < ROUNDING, "{refine:?}, {nearest}: {pixel:?}, {expected:?} expected");
            seen[count] += 1;
        }
        assert!(seen.iter().all(|count| *count > 30), "{seen:?}");
    }
}

/// Behind an opaque surface there is nothing, whatever it is that lies there.
#[test]
fn surfaces_behind_an_opaque_one_change_nothing() {
    for refine in [Refine::None, Refine::Linear, Refine::Exact] {
        let outer = sheet(0.3, [0.9, 0.6, 0.2], 1.0);
        let scene = |levels: Vec<SurfaceLevel>| {
            let change = |s: &mut Settings| (s.surface.refine, s.lights) = (refine, Vec::new());
            built_in(&settings(levels, change), "gaussian:24")
        };
        let [(_, opaque), (_, both)] =
            [vec![outer.clone()], vec![outer, sheet(0.7, [0.0, 1.0, 0.0], 0.5)]].map(|levels| drawn(&scene(levels)));
        assert!(opaque.pixels.iter().any(|pixel| pixel[3] > 0.0));
        let off = largest(&opaque.pixels, &both.pixels);
        assert!(off < ROUNDING, "{refine:?}: {off}");
    }
}

/// A medium of one opacity with a plane in it: Beer's law in front of the plane and behind it.
#[test]
fn plane_in_a_medium_is_beers_law_twice() {
    const OPACITY: f64 = 0.06;
    const SIDE: usize = 24;
    // Voxels from the first centre to the plane, which is at a third of the volume and not on a voxel.
    const PLANE: f64 = 15.3;
    let (medium, plane) = ([0.3, 0.6, 0.9], ([1.0, 0.2, 0.1], 0.4));
    for classification in [Classification::Post, Classification::PreIntegrated] {
        for refine in [Refine::Linear, Refine::Exact] {
            let settings = settings(vec![sheet(-PLANE, plane.0, plane.1)], |s| {
                (s.surface.volume, s.surface.refine) = (true, refine);
                let [r, g, b] = medium;
                s.transfer.points = Some(vec![[0.5, r, g, b, OPACITY]]);
                (s.sampling.step, s.sampling.classification) = (0.7, classification);
            });
            let scene = scene_of(&settings, SIDE, |at| -at.z);
            let (_, frame) = drawn(&scene);
            let beer = |length: f64| (medium, 1.0 - (1.0 - OPACITY).powf(length * SIDE as f64));
            let mut seen = 0;
            for (ray, pixel) in rays(&scene).into_iter().zip(&frame.pixels) {
                let Some((entry, direction, length)) = ray else { continue };
                let to = ((PLANE + 0.5) / SIDE as f64 - 0.5 - entry.z) / direction.z;
                let expected = match to > 0.0 && to < length {
                    true => behind_each_other(&[beer(to), plane, beer(length - to)]),
                    false => behind_each_other(&[beer(length)]),
                };
                let off = apart(*pixel, expected);
                assert!(off < SLACK, "{refine:?}, {classification:?}: {pixel:?}, {expected:?} expected");
                seen += usize::from(to > 0.0 && to < length);
            }
            assert!(seen > 200, "{seen} rays cross the plane");
        }
    }
}

/// All roots of the interpolant, where rays leave the same cells: by the exact integral, which shares no sampling.
#[test]
fn roots_are_those_of_the_exact_picture() {
    for (volume, isos) in [("shells:24", [60.0, 120.0]), ("jets:24", [60.0, 120.0]), ("marschner-lobb:24", [0.3, 0.6])]
    {
        let levels = vec![sheet(isos[0], [0.9, 0.1, 0.2], 0.3), sheet(isos[1], [0.2, 0.9, 0.3], 0.4)];
        let settings = settings(levels, |s| (s.surface.refine, s.sampling.step) = (Refine::Exact, 2.5));
        let scene = built_in(&settings, volume);
        let (plan, frame) = drawn(&scene);
        let exact = ExactIntegrator::of(&scene).picture(&plan.view.rays, plan.view.size);
        let (mut compared, mut shown) = (0, 0);
        for (i, (pixel, exact)) in frame.pixels.iter().zip(&exact).enumerate().filter(|(i, _)| !frame.undecided[*i]) {
            assert!(apart(*pixel, *exact) < ROUNDING, "{volume}, pixel {i}: {pixel:?}, {exact:?} expected");
            compared += 1;
            shown += usize::from(pixel[3] > 0.5);
        }
        assert!(compared > 1000 && shown > 40, "{volume}: {compared} compared, {shown} of them with several surfaces");
    }
}

#[test]
fn leaps_change_nothing() {
    let levels = vec![sheet(60.0, [0.9, 0.1, 0.2], 0.3), sheet(120.0, [0.2, 0.9, 0.3], 0.4)];
    for volume in [false, true] {
        for refine in [Refine::Linear, Refine::Exact] {
            let settings = settings(levels.clone(), |s| (s.surface.volume, s.surface.refine) = (volume, refine));
            let scene = built_in(&settings, "jets:24");
            for method in METHODS.into_iter().filter(|method| method.loops() && method.looks_ahead()) {
                let [(_, rule), (_, found)] = [method.unskipped(), method].map(|method| {
                    let mut scene = scene.clone();
                    scene.settings.method.name = method.name();
                    drawn(&scene)
                });
                assert!(rule.pixels.iter().any(|pixel| pixel[3] > 0.1));
                assert_eq!(rule.pixels, found.pixels, "{}", method.name);
            }
        }
    }
}

#[test]
fn what_has_no_meaning_with_transparent_surfaces_is_refused() {
    type Change = fn(&mut Settings);
    let cases: [(&str, Change); 5] = [
        ("--method single-pass", |s| s.method.name = RC_ERT.name()),
        ("--method single-pass", |s| {
            (s.method.name, s.surface.volume) = (RC_ERT.name(), true);
            s.surface.levels[0].opacity = 1.0;
        }),
        ("surface.find", |s| s.surface.find = Find::Range),
        ("surface.shows", |s| s.surface.shows = Shows::Normal),
        ("clip.mesh", |s| {
            s.clips = vec![ClipSettings { builtin: Some("box".to_owned()), ..ClipSettings::default() }];
        }),
    ];
    for (named, change) in cases {
        let scene = built_in(&settings(vec![sheet(60.0, [1.0; 3], 0.5)], change), "shells:16");
        let error = plan(&scene, None).unwrap_err().to_string();
        assert!(error.contains(named), "{error}");
    }
    let scene = built_in(
        &settings(vec![sheet(60.0, [1.0; 3], 0.5)], |s| {
            s.meshes = vec![MeshSettings { builtin: Some("box".to_owned()), opacity: 0.5, ..MeshSettings::default() }];
        }),
        "shells:16",
    );
    assert!(plan(&scene, None).is_ok());
}
