//! Single-pass ray casting: its samples are those of the multi-pass ray casters, leaps change nothing, and rays end as their settings
//! say. Needs no device.

#[path = "drawn/mod.rs"]
mod drawn;

use depthleap::method::{METHODS, RC, RC_ERT, SINGLE_PASS, SINGLE_PASS_COMPUTE};
use depthleap::part::rows::Method;
use depthleap::plan::plan;
use depthleap::projection::PROJECTIONS;
use depthleap::read;
use depthleap::scene::Scene;
use depthleap::scene::settings::{Classification, Filter, Last, MeshSettings, Offset, Settings};
use drawn::drawn;

/// Sums of some dozen samples in another order differ by so much in f64.
const ROUNDING: f64 = 1e-12;

type Change = fn(&mut Settings);

fn scene(change: impl FnOnce(&mut Settings)) -> Scene {
    let mut settings = Settings::default();
    settings.volume.builtin = Some("shells:24".to_owned());
    settings.image.size = [32, 26];
    settings.camera.eye = [0.9, 0.65, 1.3];
    settings.sampling.filter = Filter::Exact;
    change(&mut settings);
    read::scene(&settings).unwrap()
}

fn by(scene: &Scene, method: &Method) -> Scene {
    let mut scene = scene.clone();
    scene.settings.method.name = method.name();
    scene
}

/// The largest difference of two pictures.
fn apart(a: &[[f64; 4]], b: &[[f64; 4]]) -> f64 {
    a.iter().flatten().zip(b.iter().flatten()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

#[test]
fn samples_are_those_of_passes_of_one_sample() {
    let changes: [(&str, Change); 6] = [
        ("as it is", |_| {}),
        ("a surface of opacity", |s| s.transfer.preset = Some("surface".to_owned())),
        ("parts of steps", |s| (s.sampling.offset, s.sampling.last) = (Offset::Midpoint, Last::Partial)),
        ("no last step", |s| s.sampling.last = Last::None),
        ("pre-integrated", |s| s.sampling.classification = Classification::PreIntegrated),
        ("with a mesh", |s| {
            s.meshes = vec![MeshSettings { builtin: Some("box".to_owned()), opacity: 0.3, ..MeshSettings::default() }];
        }),
    ];
    for (name, change) in changes {
        let scene = scene(|s| {
            change(s);
            s.sampling.samples_per_pass = 1;
        });
        let (_, passes) = drawn(&by(&scene, &RC_ERT));
        assert!(passes.pixels.iter().any(|pixel| pixel[3] > 0.1), "{name} shows something");
        for method in [&SINGLE_PASS, &SINGLE_PASS_COMPUTE] {
            let (_, whole) = drawn(&by(&scene, method));
            let off = apart(&whole.pixels, &passes.pixels);
            assert!(off < ROUNDING, "{name}: {} is {off} from rc-ert", method.name);
        }
    }
}

/// T is tested after every sample, not between passes only: a ray stops earlier, and never later.
#[test]
fn rays_end_with_the_sample_that_makes_them_opaque() {
    let scene = scene(|s| s.transfer.preset = Some("surface".to_owned()));
    let [(_, passes), (_, whole)] = [&RC_ERT, &SINGLE_PASS].map(|method| drawn(&by(&scene, method)));
    let mut earlier = 0;
    for (whole, passes) in whole.pixels.iter().zip(&passes.pixels) {
        assert!(whole[3] <= passes[3] + ROUNDING, "{whole:?} goes on behind {passes:?}");
        earlier += usize::from(whole[3] < passes[3] - ROUNDING);
    }
    assert!(earlier > 0, "no ray ends earlier");
}

/// Where no ray ends early every method sums up the same samples.
#[test]
fn projections_are_those_of_passes() {
    for row in PROJECTIONS {
        let scene = scene(|s| {
            s.projection.kind = row.name();
            s.sampling.termination = 1.0;
        });
        let [(_, passes), (_, whole)] = [&RC, &SINGLE_PASS].map(|method| drawn(&by(&scene, method)));
        let off = apart(&whole.pixels, &passes.pixels);
        assert!(off < ROUNDING, "{}: {off}", row.name);
    }
}

#[test]
fn leaps_change_nothing() {
    for classification in [Classification::Post, Classification::PreIntegrated] {
        let scene = scene(|s| {
            s.sampling.classification = classification;
            s.volume.builtin = Some("jets:40".to_owned());
        });
        for method in METHODS.into_iter().filter(|method| method.loops() && method.looks_ahead()) {
            let [(_, rule), (_, found)] = [method.unskipped(), method].map(|method| drawn(&by(&scene, method)));
            assert!(rule.pixels.iter().any(|pixel| pixel[3] > 0.1));
            assert_eq!(rule.pixels, found.pixels, "{}", method.name);
        }
    }
}

/// A medium of one opacity, whose ray has as many samples as whole steps.
#[test]
fn no_last_step_leaves_out_what_is_no_whole_step() {
    const OPACITY: f64 = 0.1;
    for (step, method) in [(1.0, &SINGLE_PASS), (0.7, &SINGLE_PASS), (1.3, &RC)] {
        let scene = by(
            &scene(|s| {
                s.volume.builtin = Some("constant:24".to_owned());
                s.transfer.points = Some(vec![[0.5, 1.0, 1.0, 1.0, OPACITY]]);
                (s.sampling.last, s.sampling.step, s.sampling.termination) = (Last::None, step, 1.0);
            }),
            method,
        );
        let (plan, frame) = drawn(&scene);
        let [width, _] = scene.settings.image.size;
        assert!(frame.pixels.iter().any(|pixel| pixel[3] > 0.5));
        for (i, pixel) in frame.pixels.iter().enumerate().filter(|(i, _)| !frame.undecided[*i]) {
            let ray = plan.view.rays.of(i as u32 % width, i as u32 / width);
            let direction = ray.direction;
            let length = scene
                .interval(&ray, plan.view.rays.near)
                .map_or(0.0, |(enter, leave)| (leave - enter) * direction.length());
            let steps = (length / (step * scene.field.finest())).floor();
            let expected = 1.0 - (1.0 - OPACITY).powf(steps * step);
            assert!((pixel[3] - expected).abs() < 1e-9, "{step}: {pixel:?}, {expected} expected");
        }
    }
}

#[test]
fn plans_have_one_pass_and_nothing_that_passes_need() {
    for method in METHODS.into_iter().filter(|method| method.loops() && !method.goes_through_cells()) {
        let plan = plan(&by(&scene(|s| s.sampling.passes = 3), method), None).unwrap();
        assert_eq!(plan.passes, 1, "{}", method.name);
        let names: Vec<&str> = plan.frame().iter().map(|step| step.pass_name()).collect();
        assert!(names.len() == 1 && names[0].starts_with("single_pass"), "{names:?}");
        assert!(plan.left_out.iter().any(|left| left.what == "forced main passes"), "{}", method.name);
    }
}
