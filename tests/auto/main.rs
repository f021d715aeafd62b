//! `auto`: what a look finds, what methods would do by it, held against what their f64 frames count, and what is chosen; needs no
//! device.

mod costs;
mod left_open;

use depthleap::auto::{AutoRecord, DeviceFacts, Estimate, Look, MethodFacts, Tuning, Work, choose, settle};
use depthleap::frame::cpu::Counts;
use depthleap::frame::{Structures, cpu};
use depthleap::method::{self, METHODS};
use depthleap::part::rows::Method;
use depthleap::plan::plan;
use depthleap::read;
use depthleap::scene::settings::{Cull, MethodName};
use depthleap::scene::volume::Voxels;
use depthleap::scene::{Scene, Settings, Volume};

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
        for estimate in record.weighed.iter().filter(|estimate| row(&estimate.method).looks_ahead()) {
            assert_eq!((estimate.build_ms, estimate.work.lookups), (0.0, 0.0), "{}", estimate.method);
        }
    }
    let asked = chosen(&scene("constant:64", "haze", |s| s.method.planner = false));
    let looking = asked.weighed.iter().filter(|estimate| row(&estimate.method).looks_ahead());
    assert!(looking.clone().count() > 0 && looking.clone().all(|estimate| estimate.build_ms > 0.0), "all is built");
}

#[test]
fn a_volume_with_one_free_cell_has_what_is_built_for_it_counted() {
    let mut settings = Settings::default();
    settings.transfer.preset = Some("linear".to_owned());
    settings.image.size = [64, 64];
    let mut voxels = vec![0.5f32; 64 * 64 * 64];
    for (x, y, z) in (0..27).map(|i| (i % 3, i / 3 % 3, i / 9)) {
        voxels[((30 + z) * 64 + 30 + y) * 64 + 30 + x] = 0.0;
    }
    settings.volume.range = Some([0.0, 1.0].map(Into::into));
    let volume = Volume::new("a hole", [64; 3], [1.0; 3], Voxels::F32(voxels)).unwrap();
    let scene = read::scene_of(&settings, |_| Ok(volume.clone())).unwrap();
    let weighed = chosen(&scene).weighed;
    let skipping = weighed.iter().filter(|estimate| row(&estimate.method).looks_ahead());
    assert!(skipping.clone().count() > 0 && skipping.clone().all(|estimate| estimate.build_ms > 0.0), "{weighed:?}");
}

#[test]
fn a_look_stays_small_whatever_it_looks_at() {
    let samples = |size: [u32; 2], height: f64, step: f64| {
        let settings = |s: &mut Settings| {
            (s.image.size, s.camera.height, s.sampling.step) = (size, Some(height), step);
        };
        let look = Look::of(&scene("shells:32", "linear", settings)).unwrap();
        assert!(look.rays().count() > 0, "{size:?}");
        (look.rays().count(), look.rays().map(|ray| ray.seen.len()).sum::<usize>(), look.pixels)
    };
    let (_, taken, _) = samples([400, 400], 1.3, 1e-3);
    assert!(taken < 1 << 21, "{taken} samples of long rays");
    let (rays, ..) = samples([20_000, 1], 1e-4, 1.0);
    assert!(rays <= 4 * 129, "{rays} rays of a line of pixels");
    let (.., pixels) = samples([1, 1], 0.5, 1.0);
    assert_eq!(pixels, 1.0, "the only pixel shows the volume");
}

#[test]
fn rays_end_where_planners_and_passes_let_them() {
    let mut settings = Settings::default();
    settings.image.size = [32, 32];
    settings.projection.kind = "mip".parse().unwrap();
    let halves: Vec<f32> = (0..512).map(|i| if i % 8 < 4 { 0.0 } else { 1.0 }).collect();
    let volume = Volume::new("halves", [8; 3], [1.0; 3], Voxels::F32(halves)).unwrap();
    let mip = Look::of(&read::scene_of(&settings, |_| Ok(volume.clone())).unwrap()).unwrap();
    assert!(
        mip.may_end && mip.rays().any(|ray| ray.seen.len() < ray.samples as usize),
        "the greatest value is reached"
    );
    let xray = Look::of(&scene("shells:40", "ramp", |s| s.projection.kind = "xray".parse().unwrap())).unwrap();
    assert!(!xray.may_end);
    // An eye within a surface meets it at once.
    let inside = |s: &mut Settings| {
        s.surface.iso = Some(0.1);
        (s.camera.eye, s.camera.target) = ([0.0, 0.0, 0.05], [0.3, 0.1, 0.0]);
    };
    let look = Look::of(&scene("gaussian:32", "ramp", inside)).unwrap();
    assert!(look.rays().all(|ray| ray.seen.len() == 1));
}

#[test]
fn values_beyond_the_range_are_looked_at_as_they_are() {
    let mut settings = Settings::default();
    settings.image.size = [32, 32];
    settings.volume.range = Some([0.0, 1.0].map(Into::into));
    settings.transfer.preset = None;
    settings.transfer.points =
        Some(vec![[0.0, 1.0, 1.0, 1.0, 0.0], [1.0, 1.0, 1.0, 1.0, 0.0], [2.0, 1.0, 1.0, 1.0, 0.5]]);
    let look = |value: f32| {
        let volume = Volume::new("far", [8; 3], [1.0; 3], Voxels::F32(vec![value; 512])).unwrap();
        Look::of(&read::scene_of(&settings, |_| Ok(volume.clone())).unwrap()).unwrap().coarse.open_share()
    };
    assert_eq!([look(-5.0), look(0.5), look(1.5), look(3.0), look(1e30)], [0.0, 0.0, 1.0, 1.0, 1.0]);
    // Where opacities begin with 0, the value itself shows nothing, and what is next to it does.
    settings.transfer.points = Some(vec![[0.0, 1.0, 1.0, 1.0, 0.0], [1.0, 1.0, 1.0, 1.0, 0.5]]);
    let look = |value: f32| {
        let volume = Volume::new("near", [8; 3], [1.0; 3], Voxels::F32(vec![value; 512])).unwrap();
        Look::of(&read::scene_of(&settings, |_| Ok(volume.clone())).unwrap()).unwrap().coarse.open_share()
    };
    assert_eq!([look(0.0), look(1e-6)], [0.0, 1.0]);
}

#[test]
fn forced_passes_stay_what_they_are() {
    let record = chosen(&scene("jets:48", "ramp", |s| s.sampling.passes = 4));
    let takes_passes = |estimate: &Estimate| !row(&estimate.method).loops() && !row(&estimate.method).back_to_front();
    assert!(record.weighed.iter().all(|e| takes_passes(e) && e.samples_per_pass == 8), "{record:?}");
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

/// Facts of every method that culls.
fn facts(of: impl Fn(&Method) -> (bool, Option<String>)) -> DeviceFacts {
    let culling = METHODS.into_iter().filter(|method| method.papers.is_some());
    let one = |method: &'static Method| {
        let (unfit, culls_late) = of(method);
        MethodFacts { method: method.name, unfit, form: None, culls_late }
    };
    DeviceFacts { methods: culling.map(one).collect(), ..DeviceFacts::default() }
}

#[test]
fn late_culling_makes_culled_fragments_cost() {
    let scene = scene("jets:48", "ramp", |s| s.method.frames = 1000);
    let late = facts(|_| (false, Some("as its probe found".to_owned())));
    let ms = |facts: &DeviceFacts, name: &str| {
        let record = choose(&scene, facts).unwrap();
        record.weighed.iter().find(|estimate| estimate.method == name).unwrap().frame_ms
    };
    assert!(ms(&late, "nn-omni") > 1.2 * ms(&DeviceFacts::default(), "nn-omni"));
    assert!(ms(&late, "slices-3d-omni+ftb") > 1.2 * ms(&DeviceFacts::default(), "slices-3d-omni+ftb"));
    assert_eq!(ms(&late, "single-pass"), ms(&DeviceFacts::default(), "single-pass"));
    assert!(choose(&scene, &late).unwrap().sentences().iter().any(|line| line.contains("as its probe found")));
}

#[test]
fn what_a_device_has_not_or_not_right_is_not_chosen() {
    let scene = scene("jets:48", "ramp", |s| s.method.frames = 1000);
    let record = choose(&scene, &facts(|method| (method.marks_sections(), None))).unwrap();
    assert!(record.weighed.iter().all(|estimate| !row(&estimate.method).marks_sections()));
    assert!(record.weighed.iter().any(|estimate| estimate.method == "rc-ert"));
    assert!(record.sentences().iter().any(|line| line.contains("whose way to cull this device lacks or gets wrong")));
    // Asked for a way to cull that the device lacks, it is chosen all the same, so that the device can say what it lacks.
    let mut bounds = scene.clone();
    bounds.settings.method.cull = Cull::Bounds;
    let record = choose(&bounds, &facts(|_| (true, None))).unwrap();
    assert!(record.weighed.iter().all(|estimate| !row(&estimate.method).loops()) && !record.weighed.is_empty());
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
