//! Light on its way to iso-surfaces: shadows and translucency, held against closed forms. Needs no device.

#[path = "drawn/mod.rs"]
mod drawn;

use depthleap::method::{METHODS, RC_ERT, SINGLE_PASS};
use depthleap::plan::plan;
use depthleap::read;
use depthleap::scene::settings::{Filter, Find, LightSettings, Refine, Settings, Shows, Translucency};
use depthleap::scene::volume::Voxels;
use depthleap::scene::{Scene, Volume};
use drawn::drawn;
use glam::DVec3;

const SIDE: usize = 40;
const COLOR: [f64; 3] = [1.0, 0.5, 0.25];
const AMBIENT: f64 = 0.2;
const DIFFUSE: f64 = 0.6;

/// How far the slack by which values are on a surface moves a place, and with it a colour.
const SLACK: f64 = 2e-5;

/// A scene of a solid, the iso-surface 0 of a function of voxel indices, in one light.
fn scene(light: DVec3, solid: impl Fn(DVec3) -> f64, change: impl FnOnce(&mut Settings)) -> Scene {
    let mut settings = Settings::default();
    settings.surface.levels =
        vec![depthleap::scene::settings::SurfaceLevel { color: Some(COLOR), ..Default::default() }];
    settings.image.size = [72, 60];
    settings.camera.eye = [0.2, 0.9, 1.3];
    settings.sampling.filter = Filter::Exact;
    settings.method.name = SINGLE_PASS.name();
    settings.lights = vec![LightSettings {
        direction: Some(light.to_array()),
        ambient: AMBIENT,
        diffuse: DIFFUSE,
        specular: 0.0,
        ..LightSettings::default()
    }];
    change(&mut settings);
    let at = |i: usize| DVec3::new((i % SIDE) as f64, (i / SIDE % SIDE) as f64, (i / SIDE / SIDE) as f64);
    let voxels = Voxels::F32((0..SIDE.pow(3)).map(|i| solid(at(i)) as f32).collect());
    read::scene_of(&settings, |_| Ok(Volume::new("test", [SIDE; 3], [1.0; 3], voxels).unwrap())).unwrap()
}

/// Where the rays of a frame meet the surface, in voxel indices, and what shows there.
fn met(scene: &Scene) -> Vec<(DVec3, [f64; 4])> {
    let (plan, frame) = drawn(scene);
    let [width, _] = plan.view.size;
    let step = scene.settings.sampling.step * scene.field.finest();
    let place = |i: usize| {
        let ray = plan.view.rays.of(i as u32 % width, i as u32 / width);
        let direction = ray.direction;
        let (enter, _) = scene.interval(&ray, plan.view.rays.near)?;
        let steps = frame.surfaces[i]?.steps;
        let point = plan.view.rays.origin + enter * direction + steps * step * direction.normalize();
        Some(((point + 0.5) * SIDE as f64 - 0.5, frame.pixels[i]))
    };
    (0..frame.pixels.len()).filter_map(place).collect()
}

fn off(pixel: [f64; 4], brightness: f64) -> f64 {
    (0..3).map(|c| (pixel[c] - COLOR[c] * brightness).abs()).fold(0.0, f64::max)
}

const FLOOR: f64 = 6.5;
const RADIUS: f64 = 7.0;
const BALL: DVec3 = DVec3::new(19.5, 20.0, 19.5);

/// A ball above a floor.
fn ball_and_floor(at: DVec3) -> f64 {
    (FLOOR - at.y).max(RADIUS - at.distance(BALL))
}

/// How many of the places on the floor have a wrong light, of all; those near the shadow's edge left out, of whose place the interpolant
/// has its own idea.
fn wrong_on_the_floor(bias: f64) -> (usize, usize) {
    let light = DVec3::new(0.5, 1.0, -0.3).normalize();
    let scene = scene(light, ball_and_floor, |s| (s.effects.shadows, s.effects.shadow_bias) = (true, bias));
    let (mut wrong, mut all, mut shaded) = (0, 0, 0);
    for (place, pixel) in met(&scene) {
        // Beneath the ball gradients and values are those of both.
        let from_axis = (place - BALL).cross(light).length();
        if (place.y - FLOOR).abs() > 0.01 || place.distance(BALL) < RADIUS + 3.0 || (from_axis - RADIUS).abs() < 1.0 {
            continue;
        }
        let shadow = from_axis < RADIUS;
        let expected = AMBIENT + if shadow { 0.0 } else { DIFFUSE * light.y };
        all += 1;
        shaded += usize::from(shadow);
        wrong += usize::from(off(pixel, expected) > SLACK);
    }
    assert!(all > 500 && shaded > 50, "{all} places on the floor, {shaded} of them in the shadow");
    (wrong, all)
}

/// The shadow of a ball on a floor is where a line to the light comes nearer to the ball's centre than its radius.
#[test]
fn ball_on_a_floor_has_the_shadow_of_its_cylinder() {
    for bias in [0.25, 0.5, 1.0, 2.0] {
        let (wrong, all) = wrong_on_the_floor(bias);
        println!("bias {bias}: {wrong} of {all} places on the floor are wrong");
        assert_eq!(wrong, 0, "bias {bias}");
    }
}

/// A bias so large that ways begin behind the ball loses its shadow: the check above can fail.
#[test]
fn bias_beyond_the_ball_loses_its_shadow() {
    let (wrong, all) = wrong_on_the_floor(100.0);
    assert!(wrong > 50, "{wrong} of {all}");
}

/// A slab whose faces are planes between voxels, lit from behind: Beer's law on the way through.
#[test]
fn slab_lets_through_what_beers_law_leaves() {
    const THICKNESS: f64 = 9.4;
    const ABSORPTION: f64 = 7.0;
    let light = DVec3::new(0.2, -0.1, -1.0).normalize();
    let slab = |at: DVec3| 0.5 * THICKNESS - (at.z - 19.5).abs();
    for (part, refine, step) in [(1.0, Refine::Exact, 1.0), (1.0, Refine::Linear, 0.6), (0.4, Refine::Exact, 1.0)] {
        let scene = scene(light, slab, |s| {
            s.effects.translucency = Some(Translucency { absorption: ABSORPTION, part });
            (s.surface.refine, s.sampling.step, s.camera.eye) = (refine, step, [0.1, 0.05, 1.6]);
        });
        let way = THICKNESS / SIDE as f64 / light.z.abs();
        // The side that is seen is turned from the light, and reflects nothing of it.
        let expected = AMBIENT + part * DIFFUSE * (-ABSORPTION * way).exp();
        let mut seen = 0;
        for (place, pixel) in met(&scene) {
            // Light that comes through one of the volume's faces has a shorter way.
            if (place - 19.5).abs().max_element() > 12.0 {
                continue;
            }
            assert!(off(pixel, expected) < 1e-4, "{part}: {pixel:?} at {place}, {expected} expected");
            seen += 1;
        }
        assert!(seen > 300, "{seen}");
    }
}

/// A side that the light shines on lets all of it through, since there is no way.
#[test]
fn side_in_the_light_shows_all_of_it() {
    let light = DVec3::new(0.2, -0.1, 1.0).normalize();
    let slab = |at: DVec3| 5.0 - (at.z - 19.5).abs();
    let scene = scene(light, slab, |s| {
        s.effects.translucency = Some(Translucency::default());
        s.camera.eye = [0.1, 0.05, 1.6];
    });
    let found = met(&scene);
    let front = found.iter().filter(|(place, _)| (*place - 19.5).abs().max_element() < 12.0);
    for (place, pixel) in front {
        assert!(off(*pixel, AMBIENT + DIFFUSE) < 1e-4, "{pixel:?} at {place}");
    }
}

#[test]
fn light_without_surfaces_that_it_crosses_is_refused() {
    type Change = fn(&mut Settings);
    let cases: [(&str, Change); 4] = [
        ("effects.shadows", |s| s.surface.levels.clear()),
        ("effects.shadows", |s| s.surface.find = Find::Range),
        ("--method single-pass", |s| s.method.name = RC_ERT.name()),
        ("effects.translucency", |s| {
            s.effects.shadows = false;
            s.effects.translucency = Some(Translucency::default());
            s.surface.levels.clear();
        }),
    ];
    for (named, change) in cases {
        let scene = scene(DVec3::Y, ball_and_floor, |s| {
            s.effects.shadows = true;
            change(s);
        });
        let error = plan(&scene, None).unwrap_err().to_string();
        assert!(error.contains(named), "{error}");
    }
    for (absorption, part) in [(-1.0, 0.5), (f64::NAN, 0.5), (1.0, 1.5)] {
        let mut settings = Settings::default();
        settings.effects.translucency = Some(Translucency { absorption, part });
        let error = settings.check().unwrap_err().to_string();
        assert!(error.contains("translucency"), "{error}");
    }
}

/// A frame has nothing of light that its scene does not ask for, or that does not show.
#[test]
fn light_is_left_out_where_it_does_not_show() {
    let defines = |change: fn(&mut Settings)| {
        let plan = plan(&scene(DVec3::Y, ball_and_floor, change), None).unwrap();
        let shaders: Vec<_> = plan.steps.iter().filter_map(|step| step.work.shader()).collect();
        ["SHADOWS", "TRANSLUCENT"].map(|define| shaders.iter().any(|shader| shader.defines.contains(define)))
    };
    assert_eq!(defines(|_| {}), [false, false]);
    assert_eq!(defines(|s| s.effects.shadows = true), [true, false]);
    assert_eq!(defines(|s| s.effects.translucency = Some(Translucency::default())), [false, true]);
    assert_eq!(
        defines(|s| s.effects.translucency = Some(Translucency { part: 0.0, ..Default::default() })),
        [false; 2]
    );
    assert_eq!(defines(|s| (s.effects.shadows, s.surface.shows) = (true, Shows::Normal)), [false; 2]);
}

#[test]
fn leaps_change_nothing() {
    let scene = scene(DVec3::new(0.5, 1.0, -0.3), ball_and_floor, |s| s.effects.shadows = true);
    for method in METHODS.into_iter().filter(|method| method.loops() && method.looks_ahead()) {
        let [rule, found] = [method.unskipped(), method].map(|method| {
            let mut scene = scene.clone();
            scene.settings.method.name = method.name();
            drawn(&scene).1.pixels
        });
        assert_eq!(rule, found, "{}", method.name);
    }
}
