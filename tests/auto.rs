//! `auto`: what a look finds, what methods would do by it, held against what their f64 frames count, and what is chosen; needs no
//! device.

use depthleap::auto::{AutoRecord, DeviceFacts, Look, Tuning, Work, choose, settle};
use depthleap::frame::cpu::Counts;
use depthleap::frame::{Structures, cpu};
use depthleap::method::{self, METHODS};
use depthleap::part::rows::Method;
use depthleap::plan::plan;
use depthleap::read;
use depthleap::scene::settings::{Cull, MethodName};
use depthleap::scene::{Scene, Settings};

fn scene(volume: &str, tf: &str, change: impl FnOnce(&mut Settings)) -> Scene {
    let mut settings = Settings::default();
    settings.volume.builtin = Some(volume.to_owned());
    settings.transfer.preset = Some(tf.to_owned());
    settings.image.size = [96, 80];
    change(&mut settings);
    read::scene(&settings).expect("a sound scene")
}

/// What the f64 frame of a method counts.
fn counted(scene: &Scene, method: &Method) -> Counts {
    let mut scene = scene.clone();
    scene.settings.method.name = method.name();
    let plan = plan(&scene, method.papers).expect("a plan");
    let mut structures = Structures::default();
    structures.prepare(&scene, &plan);
    cpu::run(&scene, &plan, &structures, cpu::SUB_PIXEL_BITS).counts
}

fn sum(counts: &[u64]) -> f64 {
    counts.iter().sum::<u64>() as f64
}

const TUNING: Tuning = Tuning { samples_per_pass: 8, lookups: 1, cell: 1, first: false };

fn chosen(scene: &Scene) -> AutoRecord {
    choose(scene, &DeviceFacts::default()).expect("a choice")
}

fn row(name: &str) -> &'static Method {
    METHODS.into_iter().find(|method| method.name == name).unwrap()
}

#[test]
fn a_look_at_a_constant_medium_sees_all_of_it() {
    let scene = scene("constant:20", "haze", |s| s.sampling.termination = 1.0);
    let look = Look::of(&scene).unwrap();
    assert_eq!(look.coarse.open_share(), 1.0);
    assert!(look.rays().all(|ray| ray.samples as usize == ray.seen.len() && ray.seen.iter().all(|s| s.shows)));
    let work = Work::of(&method::SINGLE_PASS_OMNI, TUNING, &look);
    assert_eq!(work.lookups, 0.0, "nothing is looked up where nothing is free");
    // Samples are those of the longest ray of each cluster.
    assert!(work.shown <= work.samples && work.shown > 0.8 * work.samples, "{work:?}");
}

#[test]
fn a_look_at_nothing_sees_nothing() {
    let scene = scene("constant:20", "ramp", |s| {
        s.transfer.preset = None;
        s.transfer.points = Some(vec![[0.0, 1.0, 1.0, 1.0, 0.0], [1.0, 1.0, 1.0, 1.0, 0.0]]);
    });
    let look = Look::of(&scene).unwrap();
    assert_eq!(look.coarse.open_share(), 0.0);
    let work = Work::of(&method::NN_OMNI, TUNING, &look);
    assert_eq!((work.main, work.samples), (0.0, 0.0));
    assert!(work.intermediate > 0.0);
}

#[test]
fn a_look_finds_where_opaque_rays_end() {
    let end = |termination: f64| {
        let scene = scene("constant:40", "ramp", |s| {
            s.transfer.preset = None;
            s.transfer.points = Some(vec![[0.0, 1.0, 1.0, 1.0, 0.1], [1.0, 1.0, 1.0, 1.0, 0.1]]);
            s.sampling.termination = termination;
        });
        let rays = Look::of(&scene).unwrap();
        rays.rays().map(|ray| ray.seen.len()).sum::<usize>()
    };
    assert!(end(0.5) < end(0.95) && end(0.95) < end(1.0), "{} {} {}", end(0.5), end(0.95), end(1.0));
}

#[test]
fn estimates_are_near_what_frames_count() {
    for (volume, tf) in [("shells:48", "ramp"), ("jets:48", "ramp"), ("blocks:64", "surface"), ("shells:40", "haze")] {
        let scene = scene(volume, tf, |_| {});
        let look = Look::of(&scene).unwrap();
        for name in ["rc", "rc-ert", "rc-block", "nn-omni", "nn-directional", "nn-optimal", "single-pass", "slices-3d"]
        {
            let (work, counts) = (Work::of(row(name), TUNING, &look), counted(&scene, row(name)));
            // What is leapt over hangs on where things are, of which a look sees some.
            let within = if row(name).looks_ahead() { 5.0 } else { 1.5 };
            let near = |estimate: f64, count: f64| (1.0 / within..within).contains(&((estimate + 1.0) / (count + 1.0)));
            assert!(near(work.main, sum(&counts.main)), "{volume}, {name}: {work:?} {}", sum(&counts.main));
            let intermediate = sum(&counts.intermediate);
            assert!(near(work.intermediate, intermediate), "{volume}, {name}: {work:?} {intermediate}");
        }
    }
}

#[test]
fn what_is_asked_for_stays_and_what_is_left_open_is_chosen() {
    let mut open = scene("jets:48", "ramp", |s| s.method.frames = 1000);
    let record = settle(&mut open, &DeviceFacts::default()).unwrap().expect("a choice");
    let settings = &open.settings;
    assert_eq!(settings.method.name.name(), record.chosen.method);
    assert_eq!(
        (settings.sampling.samples_per_pass, settings.method.cell),
        (record.chosen.samples_per_pass, record.chosen.cell)
    );
    assert_eq!(record.samples_per_pass, 8, "what was asked for");
    let mut named = scene("jets:48", "ramp", |s| s.method.name = method::RC.name());
    assert_eq!(settle(&mut named, &DeviceFacts::default()).unwrap(), None);
    let kept =
        scene("jets:48", "ramp", |s| (s.sampling.samples_per_pass, s.method.lookups, s.method.cell) = (12, 3, 8));
    let weighed = chosen(&kept).weighed;
    assert!(weighed.iter().all(|e| (e.samples_per_pass, e.lookups, e.cell) == (12, 3, 8)), "{weighed:?}");
}

#[test]
fn what_is_built_counts_by_the_frames_it_serves() {
    let build = |frames: u32, moving: bool| {
        let record = chosen(&scene("shells:96", "ramp", |s| (s.method.frames, s.method.moving) = (frames, moving)));
        let best = record.weighed.iter().map(|estimate| estimate.ms).fold(f64::INFINITY, f64::min);
        assert_eq!(record.chosen.ms, best);
        (record.chosen.build_ms, record.clone())
    };
    let (once, _) = build(1, false);
    let (often, of_view) = build(100_000, false);
    let (_, moving) = build(100_000, true);
    assert!(once < often, "{once} {often}");
    let for_a_view = |record: &AutoRecord| ["optimal", "cone"].iter().any(|kind| record.chosen.method.contains(kind));
    assert!(!for_a_view(&moving), "{}", moving.chosen.method);
    let ms = |record: &AutoRecord| record.weighed.iter().find(|e| e.method == "nn-optimal").unwrap().ms;
    assert!(ms(&moving) > 2.0 * ms(&of_view), "a structure for each view");
}

#[test]
fn nothing_is_skipped_where_everything_shows() {
    for frames in [1, 1000] {
        let record = chosen(&scene("constant:64", "haze", |s| s.method.frames = frames));
        let method = row(&record.chosen.method);
        assert!(!method.looks_ahead() || record.chosen.build_ms == 0.0, "{}", record.chosen.method);
    }
}

#[test]
fn only_methods_that_draw_the_scene_are_weighed() {
    let effect = "vec4 effect(Sample here) { return here.color; }\n";
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("same.glsl");
    std::fs::write(&file, effect).unwrap();
    let record = chosen(&scene("jets:24", "ramp", |s| s.effects.file = Some(file)));
    assert!(!record.weighed.is_empty() && record.weighed.iter().all(|e| row(&e.method).loops()), "{record:?}");
    let surface = chosen(&scene("jets:24", "ramp", |s| s.surface.iso = Some(90.0)));
    assert!(surface.weighed.iter().all(|e| row(&e.method).stack().is_none()));
    assert!(surface.weighed.iter().all(|e| row(&e.method).on_device));
}

#[test]
fn late_culling_makes_culled_fragments_cost() {
    let scene = scene("jets:48", "ramp", |s| s.method.frames = 1000);
    let late = DeviceFacts { culls_late: Some("as its probe found".to_owned()), ..DeviceFacts::default() };
    let ms = |facts: &DeviceFacts, name: &str| {
        let record = choose(&scene, facts).unwrap();
        record.weighed.iter().find(|estimate| estimate.method == name).unwrap().frame_ms
    };
    assert!(ms(&late, "nn-omni") > 1.2 * ms(&DeviceFacts::default(), "nn-omni"));
    assert_eq!(ms(&late, "single-pass"), ms(&DeviceFacts::default(), "single-pass"));
    assert!(choose(&scene, &late).unwrap().sentences().iter().any(|line| line.contains("as its probe found")));
}

#[test]
fn sentences_name_the_choice_the_runner_up_and_what_was_found() {
    let record = chosen(&scene("jets:24", "ramp", |_| {}));
    let text = record.sentences().join("\n");
    let runner_up = record.runner_up.as_ref().unwrap();
    assert_ne!(runner_up.method, record.chosen.method);
    for part in ["auto chose", &record.chosen.method, &runner_up.method, "for one frame", "% of the cells"] {
        assert!(text.contains(part), "{part}: {text}");
    }
    let json = serde_json::to_value(&record).unwrap();
    assert_eq!(serde_json::from_value::<AutoRecord>(json).unwrap(), record);
}

#[test]
fn the_name_is_read_where_a_method_may_be_chosen() {
    assert_eq!("auto".parse(), Ok(MethodName::AUTO));
    assert!(Settings::default().method.name.is_auto());
    assert_eq!(method::of(MethodName::AUTO).unwrap().name, "nn-omni", "where nothing has chosen");
}

#[test]
fn methods_cull_as_they_are_asked_to() {
    let scene = scene("jets:24", "ramp", |s| s.method.cull = Cull::Ztest);
    let forms = |estimate: &depthleap::auto::Estimate| (row(&estimate.method).forms)();
    let weighed = chosen(&scene).weighed;
    assert!(!weighed.is_empty() && weighed.iter().all(|e| forms(e).iter().any(|form| form.cull == Cull::Ztest)));
}
