//! What takes the place of what a scene leaves open: numbers of a method that is named, and steps that meet an error.

use depthleap::auto::{DeviceCosts, DeviceFacts, Look, Tuning, Work, frame_ms, settle};
use depthleap::frame::{Structures, cpu};
use depthleap::method;
use depthleap::plan::plan;
use depthleap::scene::settings::{Cull, ErrorNorm, Last, LeftOpen};
use depthleap::scene::{Scene, Settings};
use depthleap::truth::exact::ExactIntegrator;

use super::scene;

/// The whole picture of what an error has chosen, in f64, and how far it is from the exact integral by a norm.
fn error_of(scene: &Scene, norm: ErrorNorm) -> f64 {
    let mut scene = scene.clone();
    scene.settings.method.name = method::CPU.name();
    let plan = plan(&scene, None).expect("a plan");
    let drawn = cpu::run(&scene, &plan, &Structures::default(), cpu::SUB_PIXEL_BITS);
    let rays = scene.camera.rays(scene.settings.image.size).unwrap();
    let exact = ExactIntegrator::of(&scene).picture(&rays, scene.settings.image.size);
    norm.of(drawn.pixels.iter().zip(&exact).map(|(a, b)| std::array::from_fn(|c| a[c] - b[c])))
}

#[test]
fn an_error_that_is_asked_for_is_met_by_longer_steps_the_larger_it_is() {
    for (volume, tf) in [("jets:24", "ramp"), ("shells:24", "haze"), ("gaussian:20", "linear")] {
        let mut steps = Vec::new();
        for bound in [0.05, 1.0 / 255.0, 1e-3] {
            let mut scene = scene(volume, tf, |s| s.sampling.error = Some(bound));
            let record = settle(&mut scene, &DeviceFacts::default()).unwrap().expect("a record");
            let error = record.error.expect("how it was chosen");
            assert_eq!(error.step, scene.settings.sampling.step);
            assert!(!scene.settings.method.name.is_auto());
            let found = error_of(&scene, ErrorNorm::Largest);
            assert!(found <= bound, "{volume}, {tf}: {found:e} where {bound} was asked for, {error:?}");
            steps.push(error.step);
        }
        assert!(steps[0] > steps[2] && steps[0] >= steps[1] && steps[1] >= steps[2], "{volume}, {tf}: {steps:?}");
    }
}

#[test]
fn a_mean_error_is_met_by_longer_steps_and_rays_that_end_sooner_than_a_largest_one() {
    for (volume, tf) in [("jets:24", "ramp"), ("shells:24", "haze")] {
        let chosen = |norm: ErrorNorm| {
            let mut scene = scene(volume, tf, |s| (s.sampling.error, s.sampling.error_norm) = (Some(0.004), norm));
            let record = settle(&mut scene, &DeviceFacts::default()).unwrap().expect("a record");
            (record.error.expect("how it was chosen"), error_of(&scene, norm))
        };
        let ((largest, _), (mean, found)) = (chosen(ErrorNorm::Largest), chosen(ErrorNorm::Rmse));
        // A small picture's mean is that of the whole one but for chance.
        assert!(found <= 1.1 * 0.004, "{volume}, {tf}: {found:e}, {mean:?}");
        assert!(mean.step >= largest.step && mean.termination <= largest.termination, "{mean:?} {largest:?}");
        assert!((mean.step, mean.termination) != (largest.step, largest.termination), "{mean:?}");
        assert!(mean.words().contains("the rmse of"), "{}", mean.words());
    }
}

#[test]
fn norms_of_differences_are_the_largest_and_the_root_of_the_mean_square() {
    let differences = || [[0.0, -3.0, 1.0, 0.0], [1.0, 1.0, 2.0, 0.0]].into_iter();
    assert_eq!(ErrorNorm::Largest.of(differences()), 3.0);
    assert_eq!(ErrorNorm::Rmse.of(differences()), (16.0f64 / 8.0).sqrt());
    assert_eq!([ErrorNorm::Largest, ErrorNorm::Rmse].map(|norm| norm.of(std::iter::empty())), [0.0; 2]);
}

#[test]
fn a_method_that_is_named_is_kept_and_given_settings_that_meet_the_error() {
    let mut scene = scene("jets:24", "ramp", |s| {
        (s.sampling.error, s.method.name) = (Some(0.01), method::RC_ERT.name());
    });
    let record = settle(&mut scene, &DeviceFacts::default()).unwrap().expect("a record");
    assert_eq!((record.chosen.method.as_str(), scene.settings.method.name), ("rc-ert", method::RC_ERT.name()));
    assert!(scene.settings.sampling.termination > 0.99 && record.error.is_some());
    // It is written down as if it had been asked for.
    assert_eq!(scene.settings.sampling.error, None);
    // What was asked for otherwise than by default stays.
    (scene.settings.sampling.step, scene.settings.sampling.error) = (0.03, Some(0.01));
    let again = settle(&mut scene, &DeviceFacts::default()).unwrap().and_then(|record| record.error);
    assert_eq!(again.map(|error| error.step), Some(0.03));
}

#[test]
fn numbers_of_a_named_method_that_are_left_open_are_chosen_and_nothing_else() {
    let settled = |change: fn(&mut Settings)| {
        let mut scene = scene("jets:24", "ramp", change);
        let record = settle(&mut scene, &DeviceFacts::default()).unwrap();
        (scene.settings, record)
    };
    let auto =
        || toml::from_str::<Settings>("sampling.samples_per_pass = \"auto\"\nmethod.lookups = \"auto\"").unwrap();
    assert_eq!(LeftOpen::of(&auto()), LeftOpen { samples_per_pass: true, lookups: true });
    let (settings, record) = settled(|s| {
        (s.method.name, s.sampling.samples_per_pass, s.method.lookups) = (method::NN_OMNI.name(), 0, 0);
    });
    let record = record.expect("a record");
    assert!(record.named && record.weighed.len() == 1, "{record:?}");
    assert_eq!((settings.method.name, settings.method.cell), (method::NN_OMNI.name(), 1));
    let chosen = [settings.sampling.samples_per_pass, settings.method.lookups];
    assert_eq!(chosen, [record.chosen.samples_per_pass, record.chosen.lookups]);
    assert_ne!(chosen, [8, 1], "what the papers have is never the fastest in a volume as empty as this");
    let looked = scene("jets:24", "ramp", |_| {});
    let look = Look::of(&looked).unwrap();
    for (samples_per_pass, lookups) in [8, 16, 32].into_iter().flat_map(|m| [(m, 1), (m, 16)]) {
        let tuning = Tuning { samples_per_pass, lookups, cell: 1, first: false };
        let ms = frame_ms(
            &method::NN_OMNI,
            tuning,
            &Work::of(&method::NN_OMNI, tuning, &look),
            &looked,
            &DeviceCosts::default(),
        );
        assert!(record.chosen.frame_ms <= ms, "{tuning:?}: {ms} {record:?}");
    }
    // A loop takes no passes, and M is its own; what a number is refused or taken for, auto is.
    let (settings, _) = settled(|s| {
        (s.method.name, s.sampling.samples_per_pass) = (method::SINGLE_PASS_OMNI.name(), 0);
        (s.sampling.passes, s.method.cull) = (3, Cull::Ztest);
    });
    assert!(settings.sampling.samples_per_pass > 0 && settings.method.name == method::SINGLE_PASS_OMNI.name());
    // Where nothing varies nothing is looked at.
    let (settings, record) = settled(|s| (s.method.name, s.method.lookups) = (method::RC_ERT.name(), 0));
    assert_eq!((settings.method.lookups, record), (1, None));
    // One of both stays as it is written.
    let (settings, _) = settled(|s| {
        (s.method.name, s.sampling.samples_per_pass, s.method.lookups) = (method::NN_OMNI.name(), 0, 1);
    });
    assert_eq!(settings.method.lookups, 1);
    // A method that nobody weighs has the numbers by default.
    let (settings, record) = settled(|s| (s.method.name, s.sampling.samples_per_pass) = (method::CPU.name(), 0));
    assert_eq!((settings.sampling.samples_per_pass, record), (8, None));
}

#[test]
fn numbers_that_nobody_has_chosen_are_refused() {
    let open = scene("jets:24", "ramp", |s| (s.method.name, s.method.lookups) = (method::NN_OMNI.name(), 0));
    let refused = plan(&open, method::papers_form(method::NN_OMNI.name())).unwrap_err().to_string();
    assert!(refused.contains("method.lookups") && refused.contains("give a number"), "{refused}");
}

#[test]
fn slices_that_are_named_meet_an_error_by_whole_steps() {
    let mut scene = scene("jets:24", "ramp", |s| {
        (s.sampling.error, s.method.name) = (Some(0.05), method::SLICES_3D.name());
    });
    let record = settle(&mut scene, &DeviceFacts::default()).unwrap().expect("a record");
    assert!(record.named && record.chosen.method == "slices-3d", "{record:?}");
    assert_eq!(scene.settings.sampling.last, Last::Full);
}

#[test]
fn an_error_that_nothing_meets_is_refused() {
    let refused = |change: fn(&mut Settings)| {
        let mut scene = scene("jets:24", "ramp", change);
        settle(&mut scene, &DeviceFacts::default()).unwrap_err().to_string()
    };
    let surface = refused(|s| (s.sampling.error, s.surface.iso) = (Some(1e-6), Some(90.0)));
    assert!(surface.contains("is met by no step"), "{surface}");
    let coarse = refused(|s| (s.sampling.error, s.sampling.step) = (Some(1e-4), 2.0));
    assert!(coarse.contains("down to 2 voxels"), "{coarse}");
    let adaptive = refused(|s| (s.sampling.error, s.adaptive.importance) = (Some(0.01), true));
    assert!(adaptive.contains("a tolerance of their own"), "{adaptive}");
    let cells = refused(|s| (s.sampling.error, s.volume.builtin) = (Some(0.01), Some("tets-ball:2".to_owned())));
    assert!(cells.contains("lengths of their own"), "{cells}");
    let reference = refused(|s| (s.sampling.error, s.method.name) = (Some(0.01), method::CPU.name()));
    assert!(reference.contains("name another method"), "{reference}");
}
