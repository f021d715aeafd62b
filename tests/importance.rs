//! The importance volume: how long adaptive steps may be, and what error they leave.

use std::sync::Arc;

use depthleap::frame::cpu;
use depthleap::frame::structures::Structures;
use depthleap::method::{self, METHODS};
use depthleap::plan;
use depthleap::projection::MIP;
use depthleap::read;
use depthleap::scene::field::NanPolicy;
use depthleap::scene::settings::{Alpha, Classification, Filter, LightSettings, Offset, Settings};
use depthleap::scene::volume::Voxels;
use depthleap::scene::{Field, Scene, Volume};
use depthleap::truth::exact::ExactIntegrator;
use depthleap::truth::importance::{Importance, NOTHING_SHOWS};

type Change = fn(&mut Settings);

/// Rays begin and end at numbers of single precision.
const ROUNDING: f64 = 1e-6;

fn scene(builtin: &str, change: Change) -> Scene {
    let mut settings = Settings::default();
    settings.volume.builtin = Some(builtin.to_owned());
    settings.image.size = [40, 40];
    settings.sampling.filter = Filter::Exact;
    settings.sampling.termination = 1.0;
    settings.method.name = method::SINGLE_PASS.name();
    settings.adaptive.importance = true;
    change(&mut settings);
    read::scene(&settings).expect("a sound scene")
}

fn points(settings: &mut Settings, points: &[[f64; 5]]) {
    settings.transfer.points = Some(points.to_vec());
}

/// The largest error of a channel of the twin's picture against the exact integral.
fn error(scene: &Scene) -> f64 {
    let plan = plan::plan(scene, None).unwrap();
    let mut structures = Structures::default();
    structures.prepare(scene, &plan);
    let frame = cpu::run(scene, &plan, &structures, cpu::SUB_PIXEL_BITS);
    let exact = ExactIntegrator::of(scene).picture(&plan.view.rays, plan.view.size);
    let off = frame.pixels.iter().zip(&exact).flat_map(|(a, b)| (0..4).map(|c| (a[c] - b[c]).abs()));
    off.fold(0.0, f64::max)
}

#[test]
fn a_medium_that_is_the_same_everywhere_is_crossed_in_the_longest_steps() {
    for opacity in [0.0, 1e-3, 0.5, 1.0] {
        let mut of = scene("constant:24", |_| {});
        of.settings.transfer.points = Some(vec![[0.0, 0.7, 0.2, 0.4, opacity]]);
        let of = read::scene(&of.settings).unwrap();
        let made = Importance::of(&of).unwrap();
        let most = of.settings.adaptive.doublings();
        assert_eq!(most, 8, "from 1/16 to 16 voxels");
        assert!(made.steps.iter().all(|known| known & !NOTHING_SHOWS == most), "opacity {opacity}");
        assert!(made.error <= 1e-9 && error(&of) <= ROUNDING, "opacity {opacity}");
    }
}

#[test]
fn what_a_step_takes_for_linear_and_is_so_costs_nothing() {
    // Along a ray through a linear field x goes evenly, but for the faces beyond the outermost voxel centres.
    let of = scene("linear:24", |settings| {
        points(settings, &[[0.0, 0.1, 0.9, 0.2, 0.0], [1.0, 1.0, 0.0, 0.5, 0.4]]);
        settings.adaptive.longest = 8.0;
    });
    let made = Importance::of(&of).unwrap();
    let longest = made.steps.iter().map(|known| known & !NOTHING_SHOWS).max();
    assert_eq!(longest, Some(of.settings.adaptive.doublings()));
    assert!(error(&of) <= of.settings.adaptive.tolerance);
}

#[test]
fn the_picture_keeps_to_the_tolerance() {
    // A jump, or a shell thinner than a voxel: rays of the look say how often steps meet one.
    let fine: &[f64] = &[1.0 / 16.0, 1.0 / 255.0, 1.0 / 2000.0];
    let coarse = &fine[..2];
    let changes: [(&str, &[f64], Change); 4] = [
        ("gaussian:28", fine, |settings| points(settings, &[[0.0, 1.0, 0.5, 0.1, 0.0], [1.0, 0.2, 0.6, 1.0, 0.4]])),
        ("marschner-lobb:30", fine, |s| points(s, &[[0.0, 0.2, 0.4, 1.0, 0.0], [1.0, 1.0, 0.5, 0.1, 0.1]])),
        ("shells:28", coarse, |_| {}),
        ("gaussian:28", coarse, |settings| settings.transfer.preset = Some("surface".to_owned())),
    ];
    for (name, tolerances, change) in changes {
        let mut before = f64::INFINITY;
        for &tolerance in tolerances {
            let mut of = scene(name, change);
            of.settings.adaptive.tolerance = tolerance;
            let found = error(&of);
            assert!(found <= tolerance, "{name} is off by {found:e}, and {tolerance:e} is asked for");
            assert!(found <= before, "{name}: a smaller tolerance of {tolerance:e} leaves more, {found:e}");
            before = found;
        }
        // Without it the same steps leave more: the tolerance is what keeps them short.
        let mut loose = scene(name, change);
        (loose.settings.adaptive.shortest, loose.settings.adaptive.longest) = (4.0, 4.0);
        assert!(error(&loose) > 1.0 / 2000.0, "{name}");
    }
}

#[test]
fn what_the_shortest_step_cannot_keep_to_is_known() {
    let mut of = scene("shells:28", |settings| settings.adaptive.tolerance = 1e-4);
    let kept = |of: &Scene| Importance::of(of).unwrap().error <= of.settings.adaptive.tolerance;
    assert!(!kept(&of), "steps of 1/16 voxel leave more");
    of.settings.adaptive.shortest = 1.0 / 128.0;
    assert!(kept(&of), "steps of 1/128 voxel leave less");
}

#[test]
fn no_step_reaches_what_it_may_not_cross() {
    const SIDE: usize = 21;
    // One voxel unlike all others, which show as well.
    let spike = [10, 9, 11];
    let mut values = vec![0.5f32; SIDE * SIDE * SIDE];
    values[(spike[2] * SIDE + spike[1]) * SIDE + spike[0]] = 1.0;
    let volume = Volume::new("spike", [SIDE; 3], [1.0; 3], Voxels::F32(values)).unwrap();
    let mut of =
        scene("constant:21", |settings| points(settings, &[[0.0, 0.1, 0.9, 0.2, 0.0], [1.0, 1.0, 0.0, 0.5, 0.4]]));
    of.field = Arc::new(Field::new(volume, Some([0.0, 1.0]), NanPolicy::Replace).unwrap());
    let made = Importance::of(&of).unwrap();
    let mut longest = 0.0f64;
    for i in 0..made.steps.len() {
        let cell = [i % (SIDE - 1), i / (SIDE - 1) % (SIDE - 1), i / ((SIDE - 1) * (SIDE - 1))];
        let doublings = made.at(cell) & !NOTHING_SHOWS;
        let step = of.settings.adaptive.shortest * f64::from(1u32 << doublings);
        // Cells on both sides of the voxel have it at a corner.
        let apart =
            |axis: usize| (spike[axis] - 1).saturating_sub(cell[axis]).max(cell[axis].saturating_sub(spike[axis]));
        let free = (0..3).map(apart).max().unwrap_or(0) as f64;
        assert!(step <= free.max(1.0), "a step of {step} from {cell:?}, {free} voxels from the spike");
        longest = longest.max(step);
    }
    assert_eq!(longest, 8.0, "the corners are as far off as steps of 8 voxels go");
}

#[test]
fn four_methods_take_adaptive_steps_and_no_mesh_does() {
    let takes = |of: &Scene| -> Vec<&str> {
        METHODS.into_iter().filter(|row| method::takes(row.name(), of)).map(|row| row.name).collect()
    };
    assert_eq!(takes(&scene("shells:12", |_| {})), ["rc-ert", "single-pass", "single-pass+compute", "cpu"]);
    assert_eq!(takes(&scene("tets-ball:2", |_| {})), [""; 0]);
    let refused: [(&str, Change); 8] = [
        ("--longest", |settings| settings.adaptive.longest = 0.01),
        ("--projection", |settings| settings.projection.kind = MIP.name()),
        ("--classification", |settings| settings.sampling.classification = Classification::PreIntegrated),
        ("--alpha", |settings| settings.sampling.alpha = Alpha::Paper),
        ("--filter", |settings| settings.sampling.filter = Filter::Nearest),
        ("--offset", |settings| settings.sampling.offset = Offset::Midpoint),
        ("[surface]", |settings| settings.surface.iso = Some(90.0)),
        ("[[light]]", |settings| {
            settings.lights = vec![LightSettings { direction: Some([1.0, 2.0, 3.0]), ..LightSettings::default() }];
        }),
    ];
    for (what, change) in refused {
        let error = plan::check(&scene("shells:12", change)).unwrap_err().to_string();
        assert!(error.contains("--importance") && error.contains(what), "{what}: {error}");
    }
}
