//! A camera that goes around each volume: no structure changes the picture, tighter ones run fewer fragments, and none
//! goes below the lower bound.

use std::sync::Arc;

use depthleap::experiment::orbit as around;
use depthleap::measure::runner::Runner;
use depthleap::measure::{Checked, CostSource};
use depthleap::method::{self, METHODS};
use depthleap::part::rows::{Method, Traversal};
use depthleap::scene::settings::{Distance, MethodSettings};
use depthleap::scene::{Camera, Scene, Settings};
use depthleap::vulkan::Device;
use glam::DVec3;

use super::scenes::{Stage, by, checked, differing, forms, large, scene};
use crate::harness::{Need, Test, share, test};

/// Views of an orbit.
const VIEWS: usize = 12;

/// A real volume is seen from one in so many of them, from others than the next one is.
const REAL: usize = 4;

/// The same of a large one.
const LARGE: usize = 6;

/// Volume, transfer function, side of the cells: larger ones for large volumes, whose structures take seconds for each
/// view otherwise (the law of skipping is held for small cells besides).
const VOLUMES: [(&str, &str, u32); 20] = [
    ("shells:40", "ramp", 1),
    ("blocks:48", "surface", 1),
    ("jets:40x48x56", "ramp", 1),
    ("shells:64x64x1", "ramp", 1),
    ("fuel.nrrd", "ramp", 1),
    ("nucleon.nrrd", "ramp", 1),
    ("neghip.nrrd", "ramp", 1),
    ("buckyball.nrrd", "surface", 1),
    ("silicium.nrrd", "ramp", 1),
    ("ironprot.nrrd", "ramp", 1),
    ("marschner_lobb.nrrd", "surface", 1),
    ("foot_cadaver.nrrd", "ramp", 2),
    ("mra_tof.nrrd", "ramp", 2),
    ("mri_colin27.nrrd", "surface", 4),
    ("ct_head.nrrd", "ramp", 4),
    ("ct_vismale.nrrd", "ramp", 4),
    ("engine.nrrd", "ramp", 4),
    ("engine_256cube.nrrd", "ramp", 4),
    ("aneurism.nrrd", "ramp", 4),
    ("mri_head.nrrd", "ramp", 4),
];

/// Fused forms, which read the same structures, are run in every so many views.
const FUSED: usize = 4;

/// Methods of several passes that read distances, with the kind.
fn methods() -> impl Iterator<Item = (&'static Method, Distance)> {
    METHODS
        .into_iter()
        .filter(|method| method.traversal == Traversal::Passes)
        .filter_map(|method| method.distance().map(|distance| (method, distance)))
}

pub fn tests() -> Vec<Test> {
    let mut tests = Vec::new();
    for (number, (volume, tf, cell)) in VOLUMES.into_iter().enumerate() {
        let mut one = test(&format!("orbit::{volume}::{tf}"), move |device| {
            let scene = scene(volume, tf, |s| {
                s.method.cell = cell;
                s.image.size = [48, 40];
            });
            orbit(device, &scene, number);
        });
        if volume.ends_with(".nrrd") {
            one = one.needs(Need::Data(volume));
        }
        tests.push(one);
    }
    let beside = test("orbit::structures_are_built_beside_the_frames", structures_are_built_beside_the_frames);
    tests.push(beside.needs(Need::Thoroughness));
    tests
}

/// The views of a volume by their numbers.
fn views_around(scene: &Scene, turn: usize) -> Vec<usize> {
    let every = match scene.settings.volume.builtin {
        Some(_) => return share(0..VIEWS, turn),
        None if large(scene) => LARGE,
        None => REAL,
    };
    (turn % every..VIEWS).step_by(every).collect()
}

fn orbit(device: &Arc<Device>, scene: &Scene, turn: usize) {
    let mut stage = Stage::new(device);
    for (i, view) in views_around(scene, turn).into_iter().enumerate() {
        let degrees = 360.0 * view as f64 / VIEWS as f64;
        // Not head-on to any face.
        let camera = Camera { eye: DVec3::new(0.21, 0.6, 1.8), ..(&scene.settings.camera).into() };
        let scene = scene.clone().seen_by(camera.turned(degrees));
        let ert = by(&scene, method::RC_ERT.name());
        let rule = stage.shoot(&ert, method::papers_form(method::RC_ERT.name()));
        let twin = stage.twin(&ert, method::papers_form(method::RC_ERT.name()));
        // Where f32 decides what f64 does not, a segment may contribute on one side only.
        let undecided = twin.undecided.iter().filter(|u| **u).count() as u64 * u64::from(rule.plan.passes);
        let sum = |counts: &[u64]| counts.iter().sum::<u64>();
        let ert_main = sum(&rule.run.fragments.as_ref().expect("counts").main);
        let mut main = Vec::new();
        for (method, distance) in methods().filter(|(method, _)| !method.fused || i % FUSED == 0) {
            // The last form is one that every driver has and gets right.
            let form = forms(device, method.name()).pop().flatten();
            let shot = stage.shoot(&by(&scene, method.name()), form);
            let differs = differing(&shot.picture, &rule.picture);
            assert_eq!(differs, 0, "{}, {degrees} degrees: {differs} pixels are not those of rc-ert", method.name);
            if !method.fused {
                main.push((distance, sum(&shot.run.fragments.expect("counts").main)));
            }
        }
        let [omni, cone, directional, optimal] =
            [Distance::Omni, Distance::Cone, Distance::Directional, Distance::Optimal]
                .map(|kind| main.iter().find(|(distance, _)| *distance == kind).expect("a method of each kind").1);
        let order = format!(
            "{degrees} degrees: ideal {} optimal {optimal} directional {directional} cone {cone} omni {omni} rc-ert {ert_main}",
            twin.ideal
        );
        assert!(twin.ideal <= optimal + undecided, "{order}");
        assert!(optimal <= directional && directional <= omni && omni <= ert_main, "{order}");
        assert!(optimal <= cone && cone <= omni, "{order}");
    }
}

/// The scheduler of `bench --orbit`: every method's pictures are alike, frame by frame, structures of views are used at
/// an age at which they serve, and builds go on between frames.
fn structures_are_built_beside_the_frames(device: &Arc<Device>) {
    const FRAMES: usize = 48;
    let scene = scene("jets:40", "ramp", |s| {
        s.image.size = [48, 40];
        s.method.build = depthleap::scene::settings::Builder::Device;
    });
    let check = checked(device).clone();
    let checked = Checked { device: device.clone(), check, early_end: None, costs: CostSource::Fitted };
    let mut runner = Runner::new(Some(&checked), scene.clone(), "jets".to_owned());
    let settings = |name| {
        let method = MethodSettings { name, cone: 20.0, ..scene.settings.method.clone() };
        Settings { method, ..scene.settings.clone() }
    };
    let rule = around::orbit(&mut runner, &settings(method::RC_ERT.name()), FRAMES, &|_| {}).expect("an orbit");
    assert!(rule.frames.iter().all(|frame| frame.structure.is_none() && frame.build_ms == 0.0));
    for (name, own) in
        [(method::NN_OPTIMAL.name(), "optimal"), (method::NN_CONE.name(), "cone"), (method::NN_OMNI.name(), "omni")]
    {
        let orbit = around::orbit(&mut runner, &settings(name), FRAMES, &|_| {}).expect("an orbit");
        assert_eq!(orbit.pictures, rule.pictures, "{own}");
        let used: Vec<_> = orbit.frames.iter().filter(|frame| frame.structure.as_deref() == Some(own)).collect();
        assert!(used.len() >= 3, "{own} was used {} times in {FRAMES} frames", used.len());
        assert!(orbit.frames[0].structure.as_deref() == Some("omni"), "nothing is made for the first view");
        match own {
            // Made for one view, and used for that view.
            "optimal" => assert!(used.iter().all(|frame| frame.age == Some(0))),
            // Good for cameras nearby.
            "cone" => assert!(used.iter().any(|frame| frame.age != Some(0)) && used.len() > FRAMES / 2),
            _ => assert!(used.iter().all(|frame| frame.age.is_none())),
        }
    }
}
