//! What the planner leaves out changes no bit of a picture, and is not in the device's memory.

use std::sync::Arc;

use depthleap::frame::{GpuFrame, Measure, Resident};
use depthleap::part::form::Form;
use depthleap::plan;
use depthleap::read;
use depthleap::scene::Scene;
use depthleap::vulkan::Device;

use super::lacking::{self, Less, SCENES};
use super::scenes::{differing, forms};
use crate::harness::{Test, test};

pub fn tests() -> Vec<Test> {
    vec![test("planner::pictures_stay_and_memory_and_passes_do_not", pictures_stay)]
}

struct Frame {
    picture: Vec<[f32; 4]>,
    bytes: u64,
    steps: usize,
}

/// One frame; of what `resident` has, pipelines serve.
fn frame(resident: &mut Resident, device: &Arc<Device>, scene: &Scene, form: Option<Form>, planner: bool) -> Frame {
    let mut scene = scene.clone();
    scene.settings.method.planner = planner;
    let plan = plan::plan(&scene, form).expect("a plan");
    resident.forget_scene();
    resident.prepare(&scene, &plan).expect("room");
    let mut gpu = GpuFrame::new(device, &scene, &plan, resident, None).expect("a frame");
    gpu.run(Measure::Nothing).expect("a frame");
    let there: Vec<_> = resident.bytes(&plan).into_iter().chain(gpu.bytes()).collect();
    for (resource, found) in &there {
        let told = resource.bytes(&plan.facts(&scene));
        assert_eq!(told, *found, "{} in the plan and on the device", resource.name());
    }
    let bytes = there.iter().map(|(_, bytes)| bytes).sum();
    Frame { picture: gpu.picture().expect("a picture"), bytes, steps: plan.steps.len() }
}

fn pictures_stay(device: &Arc<Device>) {
    let mut resident = Resident::new(device);
    for (name, change, less) in SCENES {
        let scene = read::scene(&lacking::settings(change)).expect("a sound scene");
        // The last form of each method is the one every device has.
        let form = forms(device, scene.settings.method.name).pop().flatten();
        let [lean, full] = [true, false].map(|planner| frame(&mut resident, device, &scene, form, planner));
        println!("{name}: {} bytes of {}, {} steps of {}", lean.bytes, full.bytes, lean.steps, full.steps);
        assert_eq!(differing(&lean.picture, &full.picture), 0, "{name}");
        assert!(full.picture.iter().any(|p| p[3] > 0.0) || matches!(less, Less::Everything), "{name} shows something");
        assert!(lean.steps <= full.steps && lean.bytes <= full.bytes, "{name}");
        match less {
            Less::Resource(resource) => assert!(lean.bytes < full.bytes, "{name}: {}", resource.name()),
            Less::Pixels => assert!(lean.bytes < full.bytes, "{name}"),
            Less::Group(group) => assert!(lean.steps < full.steps, "{name}: {}", group.name()),
            Less::Passes => assert!(lean.steps < full.steps, "{name}"),
            Less::Everything => assert_eq!((lean.steps, lean.bytes), (0, 0), "{name}"),
        }
    }
}
