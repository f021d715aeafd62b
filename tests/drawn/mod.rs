//! A scene, drawn in f64 by rays that end.

use depthleap::frame::{CpuFrame, Structures, cpu};
use depthleap::method::RC_ERT;
use depthleap::plan::{Plan, plan};
use depthleap::scene::Scene;

pub fn drawn(scene: &Scene) -> (Plan, CpuFrame) {
    let plan = plan(scene, RC_ERT.papers).unwrap();
    let mut structures = Structures::default();
    structures.prepare(scene, &plan);
    let frame = cpu::run(scene, &plan, &structures, cpu::SUB_PIXEL_BITS);
    (plan, frame)
}
