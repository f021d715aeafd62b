//! `glsl/shared/section.glsl`, `free.glsl` and `src/twin/section.rs`.

use std::sync::Arc;

use depthleap::scene::Scene;
use depthleap::shared::Frame;
use depthleap::structure::grid::SLACK;
use depthleap::twin::DEAD;
use depthleap::twin::section::{free_samples, section_depth, section_end};
use depthleap::vulkan::Device;

use super::kit::{Evaluator, ROUNDING, Setup, Worst};
use super::scene;
use crate::harness::{Test, tests};

pub fn all() -> Vec<Test> {
    tests![
        depth_of_a_section_is_its_twin,
        every_section_lies_between_its_bounds,
        free_samples_are_those_of_the_twin,
        free_samples_lie_nearer_than_the_work,
    ]
}

/// Depth of a section that lies ahead, of one where the ray has arrived, free samples, depth of a dead ray.
type Results = [f32; 4];

fn frame(passes: u32, step: f64, samples_per_pass: u32) -> Frame {
    let mut scene: Scene = scene("shells:4");
    scene.settings.sampling.step = step;
    scene.settings.sampling.samples_per_pass = samples_per_pass;
    Frame::new(&scene, &scene.camera.rays([4, 4]).unwrap(), passes, [0; 2])
}

const MIDDLE: &str = "section.comp";
/// For marks that have to rise.
const ANY: &str = "section.comp:MARK_FRAGDEPTH_ANY";

fn evaluator(device: &Arc<Device>, shader: &str) -> Evaluator {
    Evaluator::new(device, shader, &[])
}

fn results(evaluator: &Evaluator, frame: Frame, arguments: &[[f32; 4]]) -> Vec<Results> {
    evaluator.run(&Setup { frame: Some(frame), ..Setup::default() }, arguments)
}

/// Main passes: few, those of the thesis, many, the most there can be.
const PASSES: [u32; 6] = [1, 2, 3, 55, 1000, 65_536];

fn sections(passes: u32) -> Vec<[f32; 4]> {
    (0..passes).map(|section| [section as f32, 0.0, 0.0, 0.0]).collect()
}

fn depth_of_a_section_is_its_twin(device: &Arc<Device>) {
    let (middle, mut worst) = (evaluator(device, MIDDLE), Worst::default());
    for passes in PASSES {
        for (section, found) in results(&middle, frame(passes, 1.0, 8), &sections(passes)).iter().enumerate() {
            let truth = section_depth(section as u32, passes);
            // The sum is exact; the quotient is off by 2.5 units at most.
            worst.see(found[0].into(), truth, 5.0 * ROUNDING * truth, || format!("section {section} of {passes}"));
            assert_eq!((found[0], f64::from(found[3])), (found[1], DEAD));
        }
    }
    worst.assert(60_000);
}

/// The test of main pass k lets exactly the sections up to k through: end k - 1 < depth k <= end k, in f32.
fn every_section_lies_between_its_bounds(device: &Arc<Device>) {
    for shader in [MIDDLE, ANY] {
        let evaluator = evaluator(device, shader);
        for passes in PASSES {
            let end = |section: u32| section_end(section, passes) as f32;
            let found = results(&evaluator, frame(passes, 1.0, 8), &sections(passes));
            for (section, &[ahead, arrived, _, _]) in found.iter().enumerate() {
                let section = section as u32;
                let before = section.checked_sub(1).map_or(0.0, end);
                assert!(before < ahead && ahead <= arrived && arrived <= end(section), "{section} of {passes}");
                // Compare GREATER lets only depths pass that rise.
                assert!(shader == MIDDLE || ahead < arrived, "{section} of {passes}");
            }
            assert_eq!(end(passes - 1), 0.5, "sections fill the lower half");
        }
    }
}

/// Steps in voxels: likely ones, and some that no f32 holds.
const STEPS: [f64; 14] =
    [1.0, 0.5, 0.25, 2.0, 0.1, 0.2, 0.3, 0.7, 0.9, 1.1, 1.0 / 3.0, 0.016 * 64.0, 0.004 * 256.0, 0.01];

/// Every whole distance, and the way inside a cell besides.
fn distances() -> Vec<[f32; 4]> {
    (0..509).map(|free| [0.0, free as f32, 0.0, 0.0]).collect()
}

fn free_samples_are_those_of_the_twin(device: &Arc<Device>) {
    let middle = evaluator(device, MIDDLE);
    for step in STEPS {
        let found = results(&middle, frame(1, step, 8), &distances());
        for (free, found) in found.iter().enumerate() {
            assert_eq!(found[2], free_samples(free as f64, step) as f32, "{free} voxels, samples {step} apart");
        }
    }
}

/// A sample is free where it is no farther than what is free, but for rounding.
fn free_samples_lie_nearer_than_the_work(device: &Arc<Device>) {
    let middle = evaluator(device, MIDDLE);
    for step in STEPS {
        let found = results(&middle, frame(1, step, 8), &distances());
        for (free, found) in found.iter().enumerate() {
            let last = (f64::from(found[2]) - 1.0) * step;
            let (free, room) = (free as f64, SLACK / 2.0);
            assert!(last <= free + room, "{free} voxels, samples {step} apart: {found:?}");
            // And none that is free is left out.
            assert!(last + step > free - room, "{free} voxels, samples {step} apart: {found:?}");
        }
    }
}
