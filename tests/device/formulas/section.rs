//! `glsl/shared/section.glsl` and `src/reference/section.rs`.

use std::sync::Arc;

use depthleap::reference::DEAD;
use depthleap::reference::section::{passes_skipped, section_depth, section_end};
use depthleap::scene::Scene;
use depthleap::shared::Frame;
use depthleap::vulkan::Device;

use super::kit::{Evaluator, ROUNDING, Setup, Worst};
use super::scene;
use crate::harness::{Test, tests};

pub fn all() -> Vec<Test> {
    tests![
        depth_of_a_section_is_its_twin,
        every_section_lies_between_its_bounds,
        skipped_passes_are_those_of_the_twin,
        skipped_passes_hold_no_sample_near_the_work,
    ]
}

/// Depth of a section that lies ahead, of one where the ray has arrived, passes skipped, depth of a dead ray.
type Results = [f32; 4];

fn frame(passes: u32, step: f64, samples_per_pass: u32) -> Frame {
    let mut scene: Scene = scene("shells:4");
    scene.settings.sampling.step = step;
    scene.settings.sampling.samples_per_pass = samples_per_pass;
    Frame::new(&scene, &scene.camera.rays([4, 4]).unwrap(), passes)
}

fn evaluator(device: &Arc<Device>, variant: &str) -> Evaluator {
    Evaluator::new(device, &format!("section.comp:{variant}"), &[])
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
    let (middle, mut worst) = (evaluator(device, "middle"), Worst::default());
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
    for variant in ["middle", "any"] {
        let evaluator = evaluator(device, variant);
        for passes in PASSES {
            let end = |section: u32| section_end(section, passes) as f32;
            let found = results(&evaluator, frame(passes, 1.0, 8), &sections(passes));
            for (section, &[ahead, arrived, _, _]) in found.iter().enumerate() {
                let section = section as u32;
                let before = section.checked_sub(1).map_or(0.0, end);
                assert!(before < ahead && ahead <= arrived && arrived <= end(section), "{section} of {passes}");
                // Compare GREATER lets only depths pass that rise.
                assert!(variant == "middle" || ahead < arrived, "{section} of {passes}");
            }
            assert_eq!(end(passes - 1), 0.5, "sections fill the lower half");
        }
    }
}

/// Segments in voxels: M * step of every likely pair, and some that no f32 holds.
fn segments() -> Vec<(f64, u32)> {
    let steps = [1.0, 0.5, 0.25, 2.0, 0.1, 0.2, 0.3, 0.7, 0.9, 1.1, 1.0 / 3.0, 0.016 * 64.0, 0.004 * 256.0, 0.01];
    let samples = [1, 2, 3, 4, 5, 7, 8, 10, 16, 32, 64];
    steps.iter().flat_map(|&step| samples.map(|m| (step, m))).collect()
}

/// Every distance there can be: whole voxels up to 255.
fn distances() -> Vec<[f32; 4]> {
    (0..256).map(|free| [0.0, free as f32, 0.0, 0.0]).collect()
}

fn skipped_passes_are_those_of_the_twin(device: &Arc<Device>) {
    let middle = evaluator(device, "middle");
    for (step, m) in segments() {
        let found = results(&middle, frame(1, step, m), &distances());
        for (free, found) in found.iter().enumerate() {
            let expected = passes_skipped(free as f64, f64::from(m) * step);
            assert_eq!(found[2], expected as f32, "{free} voxels in segments of {m} samples {step} apart");
        }
    }
}

/// The samples of the passes skipped lie nearer than the distance read: the last is a step before their end.
fn skipped_passes_hold_no_sample_near_the_work(device: &Arc<Device>) {
    let middle = evaluator(device, "middle");
    for (step, m) in segments() {
        let found = results(&middle, frame(1, step, m), &distances());
        for (free, found) in found.iter().enumerate() {
            let last = (f64::from(found[2]) * f64::from(m) - 1.0) * step;
            assert!(last < free as f64 || found[2] == 0.0, "{free} voxels, {m} samples {step} apart: {found:?}");
            // And no whole segment that fits is left out, but for rounding.
            let left = free as f64 - f64::from(found[2]) * f64::from(m) * step;
            assert!(left < f64::from(m) * step * (1.0 + 1e-9), "{free} voxels, {m} samples {step} apart: {found:?}");
        }
    }
}
