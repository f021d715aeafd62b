//! Clip planes [Thesis §3.1.2]: where rays are cut, what a frame has of it, and what is refused.

use depthleap::frame::{Structures, cpu};
use depthleap::math::polyhedron::HalfSpace;
use depthleap::math::ray::{ViewRay, box_interval, cut_interval};
use depthleap::method;
use depthleap::plan::{plan, warnings};
use depthleap::read;
use depthleap::scene::mesh::Keep;
use depthleap::scene::settings::{ClipSettings, Last, MeshSettings, Offset};
use depthleap::scene::{Camera, Scene, Settings, Volume, builtin};
use depthleap::truth::exact::ExactIntegrator;
use glam::{DQuat, DVec3};

#[path = "random/mod.rs"]
mod random;

const SIZE: [u32; 2] = [40, 30];

fn settings(planes: &[[f64; 4]]) -> Settings {
    let clip = |plane: &[f64; 4]| ClipSettings { plane: Some(*plane), ..ClipSettings::default() };
    let mut settings = Settings { clips: planes.iter().map(clip).collect(), ..Settings::default() };
    settings.volume.builtin = Some("constant:16".to_owned());
    settings.transfer.points = Some(vec![[0.0, 1.0, 1.0, 1.0, 0.2]]);
    settings.image.size = SIZE;
    settings.camera.eye = [0.9, 0.7, 1.5];
    settings
}

fn scene(planes: &[[f64; 4]]) -> Scene {
    read::scene(&settings(planes)).unwrap()
}

/// The optical depth of every pixel, by the exact integral.
fn depths(scene: &Scene) -> Vec<f64> {
    let picture = ExactIntegrator::of(scene).picture(&scene.camera.rays(SIZE).unwrap(), SIZE);
    picture.iter().map(|pixel| -(-pixel[3]).ln_1p()).collect()
}

/// Lengths in the box [-0.5, 0.5] by the planes of a polyhedron alone: box faces are half spaces too.
fn lengths(scene: &Scene, planes: &[[f64; 4]]) -> Vec<f64> {
    let faces = (0..6).map(|face| {
        let mut plane = [0.0, 0.0, 0.0, 0.5];
        plane[face / 2] = if face % 2 == 0 { 1.0 } else { -1.0 };
        plane
    });
    let spaces: Vec<[f64; 4]> = faces.chain(planes.iter().copied()).collect();
    let rays = scene.camera.rays(SIZE).unwrap();
    let length = |i: u32| {
        let direction = rays.of(i % SIZE[0], i / SIZE[0]).direction.normalize();
        // Where the ray meets each plane; what is kept lies between two of these places, since it is convex.
        let at = |[x, y, z, d]: [f64; 4], t: f64| DVec3::new(x, y, z).dot(rays.origin + t * direction) + d;
        let mut meets: Vec<f64> =
            spaces.iter().map(|plane| at(*plane, 0.0) / (at(*plane, 0.0) - at(*plane, 1.0))).collect();
        meets.retain(|t| t.is_finite() && *t > 0.0);
        meets.sort_by(f64::total_cmp);
        let inside = |t: f64| spaces.iter().all(|plane| at(*plane, t) >= 0.0);
        meets.windows(2).filter(|pair| inside(0.5 * (pair[0] + pair[1]))).map(|pair| pair[1] - pair[0]).sum()
    };
    (0..SIZE[0] * SIZE[1]).map(length).collect()
}

/// Planes across the volume, along its faces, through the eye and beside the volume.
const PLANES: [&[[f64; 4]]; 6] = [
    &[[1.0, 0.3, -0.2, 0.1]],
    &[[0.0, 0.0, -3.0, 0.6]],
    &[
        [1.0, 0.0, 0.0, 0.2],
        [-1.0, 0.0, 0.0, 0.2],
        [0.0, 1.0, 0.0, 0.2],
        [0.0, -1.0, 0.0, 0.2],
        [0.0, 0.0, 1.0, 0.2],
        [0.0, 0.0, -1.0, 0.2],
    ],
    // n . eye + d = 0.
    &[[1.0, 0.0, -0.6, 0.0]],
    &[[0.2, 0.9, -0.1, 0.9]],
    &[[1.0, 0.0, 0.0, -0.3], [-1.0, 0.1, 0.0, 0.1]],
];

#[test]
fn a_constant_medium_is_as_deep_as_the_ray_is_long() {
    // A voxel is 1/16 of the volume's side.
    let density = -16.0 * (-0.2f64).ln_1p();
    for planes in PLANES {
        let scene = scene(planes);
        let lengths = lengths(&scene, planes);
        for (i, depth) in depths(&scene).into_iter().enumerate() {
            assert!((depth - density * lengths[i]).abs() < 1e-9, "{planes:?}, pixel {i}: {depth} and {}", lengths[i]);
        }
        let mut by_samples = scene.clone();
        let sampling = &mut by_samples.settings.sampling;
        (sampling.offset, sampling.last, sampling.termination) = (Offset::Midpoint, Last::Partial, 1.0);
        let (twin, undecided) = twin(&by_samples);
        for (i, alpha) in twin.iter().enumerate().filter(|(i, _)| !undecided[*i]) {
            // A ray shorter than half a voxel has no sample in the middle of its first step.
            let length = if 16.0 * lengths[i] > 0.5 { lengths[i] } else { 0.0 };
            let expected = -(-density * length).exp_m1();
            assert!((alpha - expected).abs() < 2e-6, "{planes:?}, pixel {i}: {alpha} and {expected}");
        }
    }
}

/// Opacities by the twins, and which of them f32 cannot decide.
fn twin(scene: &Scene) -> (Vec<f64>, Vec<bool>) {
    let mut scene = scene.clone();
    scene.settings.method.name = method::RC.name();
    let plan = plan(&scene, None).unwrap();
    let mut structures = Structures::default();
    structures.prepare(&scene, &plan);
    let frame = cpu::run(&scene, &plan, &structures, cpu::SUB_PIXEL_BITS);
    (frame.pixels.iter().map(|pixel| pixel[3]).collect(), frame.undecided)
}

#[test]
fn an_interval_is_where_a_ray_is_inside_of_all() {
    let mut random = random::Random(7);
    let mut number = |low: f64, high: f64| low + (high - low) * random.next();
    let (mut met, mut missed) = (0, 0);
    for _ in 0..4000 {
        let mut point = |by: f64| DVec3::new(number(-by, by), number(-by, by), number(-by, by));
        let (eye, half) = (point(2.0), DVec3::new(0.5, 0.3, 0.45));
        let direction = point(0.5) - eye;
        let normals = [point(1.0), point(1.0)];
        let spaces = normals.map(|normal| HalfSpace { normal, distance: number(-0.3, 0.3) });
        let inside = |depth: f64| {
            let place = eye + depth * direction;
            depth >= 0.01 && place.abs().cmple(half).all() && spaces.iter().all(|space| space.height(place) >= 0.0)
        };
        let ray = ViewRay { origin: eye, direction };
        match cut_interval(&ray, half, 0.01, &spaces) {
            Some((enter, leave)) => {
                met += 1;
                let little = 1e-9 * (1.0 + leave);
                assert!(inside(0.5 * (enter + leave)), "{enter} to {leave}");
                assert!(!inside(enter - little) && !inside(leave + little), "{enter} to {leave}");
            }
            None => {
                missed += 1;
                let Some((enter, leave)) = box_interval(&ray, half, 0.01) else { continue };
                let place = |i: u32| enter + (leave - enter) * f64::from(i) / 200.0;
                assert!((1..200).all(|i| !inside(place(i))), "{eye} {direction} {spaces:?}");
            }
        }
    }
    assert!(met > 200 && missed > 200, "{met} {missed}");
}

#[test]
fn frames_are_as_short_as_their_longest_cut_ray() {
    let passes = |planes: &[[f64; 4]]| plan(&scene(planes), method::papers_form(method::NN_OMNI.name())).unwrap();
    let (whole, half, slice) =
        (passes(&[]), passes(&[[0.0, 0.0, -1.0, 0.0]]), passes(&[[0.0, 0.0, -1.0, 0.05], [0.0, 0.0, 1.0, 0.05]]));
    assert!(
        slice.passes < half.passes && half.passes < whole.passes,
        "{} {} {}",
        slice.passes,
        half.passes,
        whole.passes
    );
    assert!(slice.view.region.pixels() < whole.view.region.pixels());
}

#[test]
fn planes_are_in_frames_that_need_them_and_in_no_others() {
    let has = |scene: &Scene| {
        let plan = plan(scene, method::papers_form(method::NN_OMNI.name())).unwrap();
        let shaders = plan.steps.iter().filter_map(|step| step.work.shader());
        let with: Vec<&str> = shaders.filter(|shader| shader.defines.contains(&"PLANES")).map(|one| one.file).collect();
        let why = plan.left_out.iter().find(|one| one.what == "clip planes").map(|one| one.why.clone());
        let kept =
            plan.resources().iter().find(|one| one.name() == "clip_planes").map(|one| one.bytes(&plan.facts(scene)));
        (with, kept, why)
    };
    assert_eq!(has(&scene(&[])), (vec![], None, None));
    let beside = [0.2, 0.9, -0.1, 0.9];
    assert_eq!(has(&scene(&[beside])), (vec![], None, Some("none of them cuts anything off the volume".to_owned())));
    // Of two planes the one that cuts is kept: twelve numbers.
    let across = [1.0, 0.0, 0.0, 0.0];
    assert_eq!(has(&scene(&[beside, across])), (vec!["entry.frag", "direction.frag"], Some(48), None));
    let mut all = settings(&[beside, across]);
    all.method.planner = false;
    assert_eq!(has(&read::scene(&all).unwrap()).1, Some(96));
    all.meshes = vec![MeshSettings { builtin: Some("box".to_owned()), ..MeshSettings::default() }];
    assert_eq!(has(&read::scene(&all).unwrap()).0, ["entry.frag", "direction.frag", "peel.frag"]);
}

#[test]
fn a_plane_stands_in_volume_space_however_the_volume_lies() {
    let turn = DQuat::from_axis_angle(DVec3::new(0.3, 1.0, -0.4).normalize(), 0.7);
    let plane = [0.6, -0.3, 0.5, 0.12];
    let upright = scene(&[plane]);
    // The same camera and plane, turned with the volume.
    let turned = |v: [f64; 3]| (turn * DVec3::from_array(v)).to_array();
    let mut settings = settings(&[]);
    let normal = turned([plane[0], plane[1], plane[2]]);
    settings.clips =
        vec![ClipSettings { plane: Some([normal[0], normal[1], normal[2], plane[3]]), ..ClipSettings::default() }];
    (settings.camera.eye, settings.camera.up) = (turned(settings.camera.eye), turned(settings.camera.up));
    let volume = Volume { turn, ..builtin::volume("constant:16").unwrap() };
    let lies = read::scene_of(&settings, |_| Ok(volume)).unwrap();
    for (i, (a, b)) in depths(&upright).into_iter().zip(depths(&lies)).enumerate() {
        assert!((a - b).abs() < 1e-9, "pixel {i}: {a} and {b}");
    }
}

#[test]
fn a_view_that_is_cut_off_is_told() {
    let warned = |planes: &[[f64; 4]]| {
        let scene = scene(planes);
        let plan = plan(&scene, method::papers_form(method::NN_OMNI.name())).unwrap();
        (plan.passes, warnings(&scene, &plan))
    };
    for nothing in [[0.0, 1.0, 0.0, -0.6], [0.0, 0.0, 1.0, -4.0]] {
        let (passes, told) = warned(&[nothing]);
        assert_eq!(passes, 0);
        assert!(
            told.len() == 1 && told[0].starts_with("the picture is empty: clip planes leave less than one sample"),
            "{told:?}"
        );
    }
    let (_, told) = warned(&[[1.0, 0.0, 0.0, -0.2], [-1.0, 0.0, 0.0, 0.1]]);
    assert!(told[0].contains("clip planes leave less"), "{told:?}");
    let (passes, told) = warned(&[[0.0, 1.0, 0.0, 0.0]]);
    assert!(passes > 0 && told.is_empty(), "{told:?}");
    // A camera that looks away is told as before.
    let mut away = scene(&[[0.0, 1.0, 0.0, 0.0]]);
    away.camera = Camera { target: 2.0 * away.camera.eye, ..away.camera };
    let plan = plan(&away, method::papers_form(method::NN_OMNI.name())).unwrap();
    assert!(warnings(&away, &plan)[0].contains("no ray meets the volume"));
}

#[test]
fn what_is_no_plane_is_refused() {
    let said = |settings: &Settings| settings.check().map_or_else(|e| e.to_string(), |()| String::new());
    for (plane, problem) in [
        ([0.0, 0.0, 0.0, 1.0], "a normal of length 0"),
        ([f64::NAN, 0.0, 1.0, 1.0], "four finite numbers"),
        ([0.0, 0.0, 1.0, f64::INFINITY], "four finite numbers"),
        // A plane beyond all numbers.
        ([0.0, 0.0, 1e-300, 1e300], "beyond all numbers"),
    ] {
        assert!(said(&settings(&[plane])).contains(problem), "{plane:?}: {}", said(&settings(&[plane])));
    }
    assert_eq!(said(&settings(&[[0.0, 1e-300, 0.0, 1e-301]; 6])), "");
    assert_eq!(said(&settings(&[[0.0, 1e300, 1e300, -1e300]; 6])), "");
    assert!(said(&settings(&[[0.0, 1.0, 0.0, 0.0]; 7])).contains("has 7 planes"));
    let mut both = settings(&[[0.0, 1.0, 0.0, 0.0]]);
    both.clips[0].builtin = Some("box".to_owned());
    assert!(said(&both).contains("stands beside other keys"), "{}", said(&both));
    // Six planes, four meshes that count and none that does not.
    let mut many = settings(&[[0.0, 1.0, 0.0, 0.0]; 6]);
    let mesh = |keep| ClipSettings { builtin: Some("box".to_owned()), keep, ..ClipSettings::default() };
    many.clips.extend([mesh(Keep::Inside), mesh(Keep::Outside), mesh(Keep::Inside), mesh(Keep::Inside)]);
    assert_eq!(said(&many), "");
    let mut thesis = settings(&[[0.0, 1.0, 0.0, 0.0]]);
    thesis.clips.push(mesh(Keep::Thesis));
    assert_eq!(said(&thesis), "");
}

#[test]
fn a_plane_is_the_same_however_long_its_normal_is() {
    let of = |plane: [f64; 4]| ClipSettings { plane: Some(plane), ..ClipSettings::default() }.half_space().unwrap();
    let plane = [1.0, -2.0, 3.0, 0.5];
    let rule = of(plane);
    assert!((rule.normal.length() - 1.0).abs() < 1e-15 && (rule.distance + 0.5 / 14f64.sqrt()).abs() < 1e-15);
    for scale in [1e-200, 1e200, 5e307, 1e-300] {
        let found = of(plane.map(|number| number * scale));
        assert!(found.normal.distance(rule.normal) < 1e-14, "{scale:e}: {found:?}");
        assert!((found.distance - rule.distance).abs() < 1e-14, "{scale:e}: {found:?}");
    }
    // The least number there is.
    let least = of([5e-324, 5e-324, 0.0, 5e-324]);
    assert!((least.distance + 0.5f64.sqrt()).abs() < 1e-15, "{least:?}");
}

#[test]
fn planes_are_kept_in_settings() {
    let of_file: Settings = toml::from_str("[[clip]]\nplane = [1, 0, 0.5, -0.25]\n").unwrap();
    let clips = [ClipSettings { plane: Some([1.0, 0.0, 0.5, -0.25]), ..ClipSettings::default() }];
    assert_eq!(of_file.clips, clips);
    let again: Settings = serde_json::from_value(serde_json::to_value(&of_file).unwrap()).unwrap();
    assert_eq!(again, of_file);
    let wrong = toml::from_str::<Settings>("[[clip]]\nplane = [1, 0, 0.5]\n").unwrap_err().to_string();
    assert!(wrong.contains("3 entries where there have to be 4"), "{wrong}");
}
