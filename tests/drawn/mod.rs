//! A scene, drawn in f64 by its method in the papers' form.

use depthleap::frame::{CpuFrame, Structures, cpu};
use depthleap::method;
use depthleap::plan::{Plan, plan};
use depthleap::scene::Scene;

pub fn drawn(scene: &Scene) -> (Plan, CpuFrame) {
    let plan = plan(scene, method::papers_form(scene.settings.method.name)).unwrap();
    let mut structures = Structures::default();
    structures.prepare(scene, &plan);
    let frame = cpu::run(scene, &plan, &structures, cpu::SUB_PIXEL_BITS);
    (plan, frame)
}
