//! What a frame leaves out, how it ends early, its formats, and the self-check.

use std::sync::Arc;

use depthleap::frame::{Counts, EarlyEnd, GpuFrame, Measure, Resident, Verdict};
use depthleap::measure::law::law_of_skipping;
use depthleap::measure::runner::{Effort, Runner};
use depthleap::measure::{Checked, CostSource};
use depthleap::method;
use depthleap::part::form::Form;
use depthleap::part::rows::Method;
use depthleap::plan;
use depthleap::scene::field::NanPolicy;
use depthleap::scene::settings::{Accumulate, Cull, Filter, Last, Mark, MethodName, MethodSettings, VolumeTexture};
use depthleap::scene::volume::Voxels;
use depthleap::scene::{Field, Scene, Volume};
use depthleap::vulkan::Device;

use super::scenes::{Stage, VIEWS, by, checked, differing, exactly, forms, scene, seen, shapes};
use crate::harness::{Need, Test, open, test};

/// Methods that end rays early between their passes, of each shape one.
fn ending() -> impl Iterator<Item = MethodName> {
    shapes().into_iter().filter(|method| method.under_the_law() && !method.loops()).map(Method::name)
}

const COPY: Option<Form> = Some(Form { cull: Cull::Ztest, mark: Mark::Copy });

pub fn tests() -> Vec<Test> {
    vec![
        test("self_check_finds_what_is_known_of_the_driver", self_check_finds_what_is_known_of_the_driver),
        test("early_end::dead_passes_are_not_run", dead_passes_are_not_run),
        test("early_end::ways_agree", ways_of_ending_agree).needs(Need::Conditional),
        test("one_queue_gives_the_same_picture", one_queue_gives_the_same_picture),
        test("repeated_frames_are_the_same", repeated_frames_are_the_same),
        test("looking_away_is_transparent", looking_away_is_transparent),
        test("times_have_every_step_that_ran", times_have_every_step_that_ran),
        test("volume_formats_differ_by_their_rounding", volume_formats_differ_by_their_rounding),
        test("accumulation_formats_differ_by_their_rounding", accumulation_formats_differ_by_their_rounding),
        test("holes_are_transparent", holes_are_transparent),
        test("omni_runs_fewer_fragments_than_blocks", omni_runs_fewer_fragments_than_blocks),
        test("fused_passes_run_fewer_fragments", fused_passes_run_fewer_fragments),
        test("runs_are_held_against_the_law_of_skipping", runs_are_held_against_the_law_of_skipping),
    ]
}

/// Drivers of DESIGN.md §5 by what they call themselves, and the forms they are known to do wrong.
fn self_check_finds_what_is_known_of_the_driver(device: &Arc<Device>) {
    let check = checked(device);
    for (form, verdict) in check.words() {
        println!("{form}: {verdict}");
    }
    let of = |cull, mark| &check.forms[&Form { cull, mark }];
    assert_eq!(*of(Cull::Ztest, Mark::Copy), Verdict::Right);
    assert_eq!(*of(Cull::Discard, Mark::Copy), Verdict::Right);
    let info = &device.info;
    let driver = format!("{} {}", info.driver_name, info.driver_info);
    let fragdepth = [of(Cull::Bounds, Mark::Fragdepth), of(Cull::Bounds, Mark::FragdepthAny)];
    if driver.contains("llvmpipe") && info.depth_bounds {
        // Mesa 26: with depth writes on, some fragments in range are rejected.
        assert!(fragdepth.iter().all(|v| matches!(v, Verdict::Wrong(_))), "{driver} does it right now: {fragdepth:?}");
        assert_eq!(*of(Cull::Bounds, Mark::Copy), Verdict::Right);
        assert_eq!(check.statistics, None);
    } else if driver.contains("llvmpipe") {
        assert!(fragdepth.iter().all(|v| matches!(v, Verdict::Missing(_))), "{driver}: {fragdepth:?}");
        assert!(check.statistics.is_some(), "{driver} counts invocations right now");
    } else if driver.contains("SwiftShader") {
        assert!(check.forms.values().all(|v| *v == Verdict::Right), "{driver}: {:?}", check.words());
    }
    let automatic = check.automatic(method::NN_OMNI.name()).expect("a form");
    assert_eq!(check.forms[&automatic], Verdict::Right);
}

/// An opaque volume far longer than what is seen of it.
fn deep() -> Scene {
    scene("constant:64", "linear", |s| {
        s.volume.range = Some([0.0, 1.0].map(Into::into));
        (s.image.size, s.sampling.samples_per_pass) = ([60, 50], 1);
    })
}

fn dead_passes_are_not_run(device: &Arc<Device>) {
    for method in ending() {
        let shot = Stage::new(device).shoot(&by(&deep(), method), COPY);
        let counts = shot.run.fragments.expect("counts");
        // Opacity 0.5 a sample: above 0.95 after five samples.
        let last = counts.main.iter().rposition(|&n| n > 0).expect("fragments");
        assert_eq!(last, 4, "{}: {:?}", method.name(), counts.main);
        assert!(counts.main.len() >= 64, "{} passes are planned", counts.main.len());
        // The rays left are counted every few passes; soon after, the intermediate passes stop too.
        let stop = counts.intermediate.iter().rposition(|&n| n > 0).expect("fragments");
        assert!(stop <= 8, "{}: {:?}", method.name(), counts.intermediate);
    }
}

fn ways_of_ending_agree(device: &Arc<Device>) {
    let scenes = [deep(), scene("shells:32", "ramp", |s| s.sampling.samples_per_pass = 1)];
    // Each from other sides.
    for (scene, views) in scenes.into_iter().zip(VIEWS.chunks(VIEWS.len() / 2)) {
        let mut stages = [EarlyEnd::Conditional, EarlyEnd::ReadBack].map(|way| {
            let mut stage = Stage::new(device);
            stage.early_end = Some(way);
            stage
        });
        for view in views {
            for method in ending() {
                let scene = by(&seen(&scene, *view), method);
                let shots = stages.each_mut().map(|stage| stage.shoot(&scene, COPY));
                assert_eq!(differing(&shots[0].picture, &shots[1].picture), 0);
                assert_eq!(shots[0].run.fragments, shots[1].run.fragments);
            }
        }
    }
}

fn one_queue_gives_the_same_picture(device: &Arc<Device>) {
    let single = open(true).expect("the device once more");
    assert!(!single.separate_compute());
    if !device.separate_compute() {
        println!("{} has one queue: both are the same path here", device.info.name);
    }
    let scene = by(&scene("blocks:48", "ramp", |_| {}), method::RC_BLOCK.name());
    let shots = [device, &single].map(|device| Stage::new(device).shoot(&scene, COPY));
    assert_eq!(differing(&shots[0].picture, &shots[1].picture), 0);
    assert_eq!(shots[0].run.fragments, shots[1].run.fragments);
    assert_eq!(single.instance().messages(), Vec::<String>::new());
}

fn repeated_frames_are_the_same(device: &Arc<Device>) {
    let scene = scene("shells:32", "ramp", |_| {});
    let both = [method::NN_OMNI.name(), method::NN_OMNI_FUSED.name()].map(|method| by(&scene, method));
    for (scene, form) in
        both.iter().flat_map(|s| forms(device, s.settings.method.name).into_iter().map(move |f| (s, f)))
    {
        let plan = plan::plan(scene, form).expect("a plan");
        let mut resident = Resident::new(device);
        resident.prepare(scene, &plan).expect("room");
        let mut frame = GpuFrame::new(device, scene, &plan, &mut resident, None).expect("a frame");
        let mut take = || {
            frame.run(Measure::Nothing).expect("a frame");
            frame.picture().expect("a picture")
        };
        let (first, second) = (take(), take());
        assert_eq!(differing(&first, &second), 0, "{form:?}");
    }
}

fn looking_away_is_transparent(device: &Arc<Device>) {
    let away = scene("shells:16", "haze", |s| s.camera.target = [0.0, 0.0, 5.0]);
    for method in [method::RC.name(), method::NN_OMNI.name()] {
        let form = forms(device, method).pop().flatten();
        let shot = Stage::new(device).shoot(&by(&away, method), form);
        assert!(shot.plan.steps.is_empty());
        assert!(shot.picture.iter().all(|p| *p == [0.0; 4]));
    }
}

fn times_have_every_step_that_ran(device: &Arc<Device>) {
    let scene = scene("shells:32", "ramp", |_| {});
    let plan = plan::plan(&scene, COPY).expect("a plan");
    let mut resident = Resident::new(device);
    resident.prepare(&scene, &plan).expect("room");
    let mut frame = GpuFrame::new(device, &scene, &plan, &mut resident, None).expect("a frame");
    let run = frame.run(Measure::Times).expect("a frame");
    if device.graphics.timestamp_valid_bits == 0 {
        assert_eq!((run.gpu_total_ms, run.step_ms.len()), (None, 0));
        return;
    }
    let total = run.gpu_total_ms.expect("a time");
    let sum: f64 = run.step_ms.iter().map(|s| s.2).sum();
    assert!(!run.step_ms.is_empty() && run.step_ms.len() <= plan.steps.len());
    assert!(run.step_ms.iter().all(|s| s.2 >= 0.0) && sum > 0.0);
    // Steps do not overlap, so their times do not add up to more than the whole (but for rounding).
    assert!(sum <= total * 1.001, "{sum} ms in steps, {total} ms in all");
}

/// The largest difference of a channel.
fn largest(a: &[[f32; 4]], b: &[[f32; 4]]) -> f32 {
    a.iter().flatten().zip(b.iter().flatten()).map(|(p, q)| (p - q).abs()).fold(0.0, f32::max)
}

fn volume_formats_differ_by_their_rounding(device: &Arc<Device>) {
    let taken = |texture, filter| {
        let scene = scene("shells:32", "ramp", |s| {
            (s.volume.texture, s.sampling.filter, s.sampling.termination) = (texture, filter, 1.0);
        });
        Stage::new(device).shoot(&by(&scene, method::RC.name()), None).picture
    };
    let exact = taken(VolumeTexture::R32f, Filter::Exact);
    // u8 voxels are the same numbers in every format, up to the last bit of a UNORM and 1/65535 of an R16 over its range.
    assert!(largest(&exact, &taken(VolumeTexture::Native, Filter::Exact)) < 1e-5);
    assert!(largest(&exact, &taken(VolumeTexture::R16, Filter::Exact)) < 1e-3);
    // Texture units weigh with 8 bits at least: some 2^-8 of a step in value, and opacities add up.
    assert!(largest(&exact, &taken(VolumeTexture::R32f, Filter::Hardware)) < 2e-2);
    assert!(largest(&exact, &taken(VolumeTexture::Native, Filter::Hardware)) < 5e-2);
}

fn accumulation_formats_differ_by_their_rounding(device: &Arc<Device>) {
    let taken = |accumulate| {
        let scene = scene("shells:32", "ramp", |s| {
            exactly(s);
            (s.image.accumulate, s.sampling.termination) = (accumulate, 1.0);
        });
        let shot = Stage::new(device).shoot(&by(&scene, method::RC.name()), None);
        (shot.plan.passes as f32, shot.picture)
    };
    let (passes, full) = taken(Accumulate::Rgba32f);
    // Each pass rounds what it leaves: 11 bits of a half, 8 bits of a byte.
    let half = largest(&full, &taken(Accumulate::Rgba16f).1);
    let byte = largest(&full, &taken(Accumulate::Rgba8).1);
    assert!(half > 0.0 && half < passes / 2048.0, "rgba16f is {half} off");
    assert!(byte > half && byte < passes / 255.0, "rgba8 is {byte} off");
}

/// A dense medium with one NaN: the eight cells about it let the light behind through.
fn holes_are_transparent(device: &Arc<Device>) {
    let mut voxels = vec![1.0f32; 9 * 9 * 9];
    voxels[4 * 81 + 4 * 9 + 4] = f32::NAN;
    let volume = Volume::new("holed", [9; 3], [1.0; 3], Voxels::F32(voxels)).expect("a volume");
    for method in shapes().into_iter().map(Method::name) {
        let mut scene = by(&scene("constant:9", "haze", exactly), method);
        scene.settings.sampling.last = Last::Partial;
        scene.field = Arc::new(Field::new(volume.clone(), Some([0.0, 1.0]), NanPolicy::Hole).expect("a field"));
        let form = forms(device, method).pop().flatten();
        let mut stage = Stage::new(device);
        let shot = stage.shoot(&scene, form);
        let twin = stage.twin(&scene, method::papers_form(method));
        let [width, height] = scene.settings.image.size;
        let middle = (height / 2 * width + width / 2) as usize;
        let off = (f64::from(shot.picture[middle][3]) - twin.pixels[middle][3]).abs();
        assert!(off < 1e-6, "{}: {:?}, twin {:?}", method.name(), shot.picture[middle], twin.pixels[middle]);
        // Nine voxels of 0.01 each, two of them through the hole.
        let through = 1.0 - 0.99f64.powi(7);
        assert!((twin.pixels[middle][3] - through).abs() < 2e-3, "{}: {:?}", method.name(), twin.pixels[middle]);
    }
}

fn omni_runs_fewer_fragments_than_blocks(device: &Arc<Device>) {
    let sum = |list: &[u64]| list.iter().sum::<u64>();
    for view in &VIEWS[..2] {
        let scene = seen(&scene("jets:64", "ramp", |_| {}), *view);
        let mut stage = Stage::new(device);
        let [block, omni] = [method::RC_BLOCK.name(), method::NN_OMNI.name()]
            .map(|method| stage.shoot(&by(&scene, method), COPY).run.fragments.expect("counts"));
        let ideal = stage.twin(&by(&scene, method::RC_ERT.name()), method::papers_form(method::RC_ERT.name())).ideal;
        assert!(sum(&omni.main) < sum(&block.main) && sum(&omni.intermediate) < sum(&block.intermediate) / 2);
        assert!(ideal <= sum(&omni.main), "ideal {ideal}, omni {}", sum(&omni.main));
    }
}

/// A ray that goes on has one fragment a pass where two passes had one each. Only where a ray that jumped lands in free
/// space again does a fused pass run without taking samples.
fn fused_passes_run_fewer_fragments(device: &Arc<Device>) {
    let sum = |list: &[u64]| list.iter().sum::<u64>();
    let (scene, mut stage) = (scene("jets:64", "ramp", |_| {}), Stage::new(device));
    for view in VIEWS {
        let scene = seen(&scene, view);
        let [apart, fused] = [method::NN_OMNI.name(), method::NN_OMNI_FUSED.name()]
            .map(|method| stage.shoot(&by(&scene, method), COPY).run.fragments.expect("counts"));
        assert_eq!(fused.intermediate[0], apart.intermediate[0], "{}: the first pass is the same", view.0);
        assert_eq!(sum(&fused.intermediate[1..]), 0, "{}: others are merged", view.0);
        let both = |counts: &Counts| sum(&counts.main) + sum(&counts.intermediate);
        println!("{}: {} fragments, fused {}", view.0, both(&apart), both(&fused));
        assert!(sum(&apart.main) <= sum(&fused.main), "{}", view.0);
        assert!(both(&fused) < both(&apart), "{}: {} of {}", view.0, both(&fused), both(&apart));
    }
}

fn runs_are_held_against_the_law_of_skipping(device: &Arc<Device>) {
    let scene = scene("shells:24", "ramp", |_| {});
    let checked =
        Checked { device: device.clone(), check: checked(device).clone(), early_end: None, costs: CostSource::Fitted };
    let methods = [method::RC.name(), method::RC_ERT.name(), method::NN_OMNI.name()]
        .map(|name| MethodSettings { name, ..MethodSettings::default() });
    let effort = Effort { warmups: 0, repeats: 0, reference: false };
    let mut measured =
        Runner::new(Some(&checked), scene, "shells".to_owned()).measure(&methods, effort, &|_| {}).expect("runs");
    assert_eq!(measured.iter().map(|one| one.differing).collect::<Vec<_>>(), [None, None, Some(0)]);
    assert!(measured[2].run.notes.iter().any(|note| note.contains("that of rc-ert") && note.contains("bit for bit")));

    measured[2].picture.pixels[77][3] += 0.5;
    law_of_skipping(&mut measured);
    assert_eq!(measured[2].differing, Some(1));
    // A first run of another M is a rule for its like alone.
    measured[0].method = measured[1].method;
    measured[0].run.settings.sampling.samples_per_pass += 1;
    measured.iter_mut().for_each(|one| one.differing = None);
    law_of_skipping(&mut measured);
    assert_eq!(measured.iter().map(|one| one.differing).collect::<Vec<_>>(), [None, None, Some(1)]);
    assert!(measured[2].run.notes.iter().any(|note| note.contains("1 pixels differ")), "{:?}", measured[2].run.notes);
}
