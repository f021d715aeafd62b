//! The plan is what runs: the names that a device records are the names that were planned.

use std::sync::Arc;

use depthleap::frame::{Background, EarlyEnd, GpuFrame, Measure, Resident, plan_on};
use depthleap::method::{self, METHODS};
use depthleap::part::Group;
use depthleap::part::form::Form;
use depthleap::plan::builds::Maker;
use depthleap::plan::{Choice, Plan, plan_for};
use depthleap::scene::settings::Builder;
use depthleap::scene::{Camera, Scene};
use depthleap::vulkan::Device;

use super::scenes::{by, forms, scene};
use crate::harness::{Need, Test, open, test};

pub fn tests() -> Vec<Test> {
    vec![
        test("recorded::every_method_built_on_host_and_device", every_method).needs(Need::Thoroughness),
        test("recorded::what_is_there_is_passed_over", what_is_there_is_passed_over),
        test("recorded::ends_of_frames", ends_of_frames),
        test("recorded::orbit", orbit),
        test("recorded::a_cpu_builds_on_the_host", a_cpu_builds_on_the_host),
    ]
}

/// A device of its own, so that nobody else's names are in its trace.
pub fn alone() -> Arc<Device> {
    open(false).expect("the device once more")
}

/// The names recorded by everything that a plan asks for, run once.
fn traced(
    device: &Arc<Device>,
    resident: &mut Resident,
    scene: &Scene,
    plan: &Plan,
    end: Option<EarlyEnd>,
) -> Vec<String> {
    device.begin_trace();
    resident.prepare(scene, plan).expect("room on the device");
    let mut frame = GpuFrame::new(device, scene, plan, resident, end).expect("a frame");
    frame.run(Measure::Nothing).expect("a frame");
    device.end_trace()
}

/// The names of a plan's steps; of its frame and the uploads for that alone, where the rest is there.
fn planned(plan: &Plan, rest_is_there: bool) -> Vec<String> {
    let passed_over = plan.builds.iter().filter(|build| rest_is_there && !build.of_frame());
    let passed_over: Vec<usize> = passed_over.flat_map(|build| build.steps.clone()).collect();
    let run = plan.steps.iter().enumerate().filter(|(i, _)| !passed_over.contains(i));
    run.map(|(_, step)| step.name.clone()).collect()
}

fn last_form(device: &Device, scene: &Scene) -> Option<Form> {
    forms(device, scene.settings.method.name).pop().flatten()
}

fn every_method(_: &Arc<Device>) {
    let device = &alone();
    let mut resident = Resident::new(device);
    for method in METHODS.into_iter().filter(|method| method.on_device && method.takes_samples()) {
        for (on_host, cell) in [(false, 1), (false, 4), (true, 1)] {
            let scene = by(&scene("shells:24", "ramp", |s| s.method.cell = cell), method.name());
            let choice = Choice { form: last_form(device, &scene), on_host, ..Choice::default() };
            let plan = plan_for(&scene, choice).expect("a plan");
            let makers = |maker: Maker| plan.builds.iter().filter(|build| build.maker == maker).count();
            assert_eq!(makers(Maker::Host), usize::from(on_host && method.distance().is_some()), "{}", method.name);
            assert!(makers(Maker::Compute) > 0 || on_host || !method.looks_ahead(), "{}", method.name);
            resident.forget_scene();
            let found = traced(device, &mut resident, &scene, &plan, Some(EarlyEnd::Never));
            assert_eq!(found, planned(&plan, false), "{}, cells of {cell}, on the host: {on_host}", method.name);
        }
    }
}

fn what_is_there_is_passed_over(_: &Arc<Device>) {
    let device = &alone();
    let mut resident = Resident::new(device);
    let scene = by(&scene("shells:24", "ramp", |_| {}), method::NN_OMNI.name());
    let plan = |scene: &Scene| {
        plan_for(scene, Choice { form: last_form(device, scene), ..Choice::default() }).expect("a plan")
    };
    let omni = plan(&scene);
    assert_eq!(traced(device, &mut resident, &scene, &omni, None), planned(&omni, false));
    assert_eq!(traced(device, &mut resident, &scene, &omni, None), planned(&omni, true));
    // Distances along rays are made from those in any direction, which are there.
    let scene = by(&scene, method::NN_OPTIMAL.name());
    let optimal = plan(&scene);
    let found = traced(device, &mut resident, &scene, &optimal, None);
    let is = |name: &str| found.iter().any(|found| found == name);
    assert!(is("bundle.1") && is("wide_2") && is("nearest_distance"), "{found:?}");
    assert!(!is("volume") && !is("interesting") && !is("omni_distance") && !is("distance_x"), "{found:?}");
}

fn ends_of_frames(_: &Arc<Device>) {
    let device = &alone();
    // Long enough for the rays left to be counted, and opaque enough to leave none.
    let scene = scene("shells:48", "surface", |s| {
        (s.sampling.samples_per_pass, s.sampling.termination) = (1, 0.5);
    });
    let scene = by(&scene, method::RC_ERT.name());
    let plan = plan_on(device, &scene, last_form(device, &scene), None).expect("a plan");
    let of = |end| traced(device, &mut Resident::new(device), &scene, &plan, Some(end));
    let all = planned(&plan, false);
    assert!(plan.steps.iter().any(|step| step.group == Group::Alive));
    if device.info.conditional_rendering {
        assert_eq!(of(EarlyEnd::Conditional), all, "the device leaves draws out, which were recorded");
    }
    let read_back = of(EarlyEnd::ReadBack);
    assert_eq!(read_back, all[..read_back.len()], "the end of the list is left out");
    let last = read_back.last().expect("names");
    assert!(read_back.len() == all.len() || last.starts_with("alive"), "{last}");
    let without: Vec<String> = all.into_iter().filter(|name| !name.starts_with("alive")).collect();
    assert_eq!(of(EarlyEnd::Never), without);
}

fn orbit(_: &Arc<Device>) {
    let device = &alone();
    let base = by(&scene("shells:24", "ramp", |_| {}), method::NN_OPTIMAL.name());
    let form = last_form(device, &base);
    let scene_of = |frame: usize| {
        let camera = Camera::from(&base.settings.camera).turned(frame as f64);
        (frame < 24).then(|| base.clone().seen_by(camera))
    };
    let (mut background, mut resident) = (Background::new(device), Resident::new(device));
    for (frame, scene) in (0..).map_while(|frame| Some((frame, scene_of(frame)?))) {
        let served = background.serve(frame, &scene, &mut resident).expect("a look").expect("distances");
        let plan = plan_on(device, &scene, form, Some(served.lookup)).expect("a plan");
        assert_eq!(plan.distance, Some(served.lookup));
        let found = traced(device, &mut resident, &scene, &plan, None);
        let (new, seen) = (planned(&plan, false), planned(&plan, true));
        let expected = if frame == 0 { &new } else { &seen };
        assert_eq!(&found, expected, "frame {frame}, {served:?}");
        background.go_on(frame, &mut resident, &scene_of).expect("a build");
    }
}

fn a_cpu_builds_on_the_host(device: &Arc<Device>) {
    for (builder, on_host) in [(Builder::Auto, device.info.is_cpu()), (Builder::Host, true), (Builder::Device, false)] {
        let scene = by(&scene("shells:16", "ramp", |s| s.method.build = builder), method::NN_DIRECTIONAL.name());
        let plan = plan_on(device, &scene, last_form(device, &scene), None).expect("a plan");
        let line = plan.lines().into_iter().find(|line| line.contains(" nearest_distance ")).expect("a line");
        assert_eq!(line.contains(" host "), on_host, "{line}");
        assert_eq!(plan.lines().iter().any(|line| line.contains("distance_x")), !on_host, "{builder:?}");
    }
}
