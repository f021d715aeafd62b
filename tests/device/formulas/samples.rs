//! `glsl/shared/samples.glsl` and `src/twin/samples.rs`.

use std::sync::Arc;

use depthleap::projection::{self, Levels};
use depthleap::scene::Scene;
use depthleap::scene::settings::Offset;
use depthleap::shared::Frame;
use depthleap::twin::{Pixel, Twin};
use depthleap::vulkan::{Bound, Device, Sampler, vk};
use glam::DVec3;

use super::kit::{Evaluator, ROUNDING, Random, SAMPLED, Setup, Worst, image};
use super::scene;
use crate::harness::{Test, tests};

pub fn all() -> Vec<Test> {
    tests![
        count_of_samples_is_its_twin,
        positions_of_samples_are_their_twins,
        places_of_samples_are_their_twins_beyond_single_precision,
    ]
}

/// Pixels of a row, as in the shader.
const ROW: u32 = 64;
const ROWS: u32 = 32;

/// A pixel as the first two passes leave it, what the shader makes of it, and the sample that was asked for.
struct Case {
    pixel: Pixel,
    index: u32,
    steps: f32,
    samples: f32,
    position: [f32; 3],
    below: [f32; 3],
    weight: [f32; 3],
}

/// Rays of all directions and lengths, held in f32 as in ENTRY and DIR.
fn pixels(random: &mut Random) -> Vec<Pixel> {
    (0..ROW * ROWS)
        .map(|i| {
            let mut unit = || {
                let direction = DVec3::from_array([0; 3].map(|_| random.between(-1.0, 1.0)));
                direction.try_normalize().unwrap_or(DVec3::X).as_vec3().as_dvec3()
            };
            let direction = unit();
            // Some rays miss.
            let length = if i % 17 == 0 { 0.0 } else { f64::from(random.between(0.0, 1.7) as f32) };
            let entry = DVec3::from_array([0; 3].map(|_| f64::from(random.next() as f32)));
            Pixel { entry, direction, length, ..Pixel::default() }
        })
        .collect()
}

fn scenes() -> Vec<Scene> {
    let settings = [(1.0, Offset::Left), (0.5, Offset::Midpoint), (0.1, Offset::Left), (3.0, Offset::Midpoint)];
    let volumes = ["shells:64", "shells:33x64x17"];
    let both = settings.iter().flat_map(|setting| volumes.map(|volume| (setting, volume)));
    both.map(|(&(step, offset), volume)| {
        let mut scene = scene(volume);
        scene.settings.sampling.step = step;
        scene.settings.sampling.offset = offset;
        scene
    })
    .collect()
}

fn cases(device: &Arc<Device>, evaluator: &Evaluator, scene: &Scene) -> Vec<Case> {
    let mut random = Random(51);
    let pixels = pixels(&mut random);
    let four = |v: DVec3, w: f64| [v.x as f32, v.y as f32, v.z as f32, w as f32];
    let entry: Vec<f32> = pixels.iter().flat_map(|p| four(p.entry, 1.0)).collect();
    let direction: Vec<f32> = pixels.iter().flat_map(|p| four(p.direction, p.length)).collect();
    let format = vk::Format::R32G32B32A32_SFLOAT;
    let entry = image(device, "entry", [ROW, ROWS, 1], format, &entry);
    let direction = image(device, "direction", [ROW, ROWS, 1], format, &direction);
    let sampler = Sampler::new(device, "nearest", false).unwrap();
    let twin = twin(scene);
    // Any sample of the ray, and one past its end.
    let index = |pixel: &Pixel, random: &mut Random| (random.next() * f64::from(twin.sample_count(pixel) + 1)) as u32;
    let indices: Vec<u32> = pixels.iter().map(|pixel| index(pixel, &mut random)).collect();
    let arguments: Vec<[f32; 4]> = indices.iter().map(|&i| [i as f32, 0.0, 0.0, 0.0]).collect();
    let setup = Setup {
        frame: Some(Frame::new(scene, &twin.rays, 1, [0; 2])),
        resources: vec![
            ("entry", Bound::Sampled(&entry, &sampler, SAMPLED)),
            ("direction", Bound::Sampled(&direction, &sampler, SAMPLED)),
        ],
    };
    let results: Vec<[[f32; 4]; 4]> = evaluator.run(&setup, &arguments);
    let all = pixels.into_iter().zip(indices).zip(results);
    let three = |[x, y, z, _]: [f32; 4]| [x, y, z];
    all.map(|((pixel, index), [[steps, samples, ..], position, below, weight])| Case {
        pixel,
        index,
        steps,
        samples,
        position: three(position),
        below: three(below),
        weight: three(weight),
    })
    .collect()
}

fn twin(scene: &Scene) -> Twin<'_> {
    Twin {
        scene,
        rays: scene.camera.rays([ROW, ROWS]).unwrap(),
        rays_off: 0.0,
        slices: None,
        cells: None,
        medium: None,
        cell_table: None,
        importance: None,
        passes: 1,
        distance: None,
        blocks: None,
        table: None,
        gradients: None,
        projection: projection::of(&scene.settings),
        fused: false,
        levels: Levels::default(),
        surface_values: &[],
        lights: &[],
        raster: 0.0,
    }
}

fn count_of_samples_is_its_twin(device: &Arc<Device>) {
    let evaluator = Evaluator::new(device, "samples.comp", &[]);
    let (mut compared, mut undecided) = (0, 0);
    for scene in scenes() {
        let twin = twin(&scene);
        let mut worst = Worst::default();
        for case in cases(device, &evaluator, &scene) {
            let steps = twin.steps(&case.pixel);
            // The inverse of the step is rounded, and the product.
            worst.see(case.steps.into(), steps, 2.5 * ROUNDING * steps + 1e-30, || format!("{:?}", case.pixel));
            if twin.sample_count_decided(&case.pixel) {
                compared += 1;
                assert_eq!(case.samples, twin.sample_count(&case.pixel) as f32, "{steps} steps");
            } else {
                undecided += 1;
            }
        }
        worst.assert(2000);
    }
    // Those that miss are undecided with offset 0, since they may just touch.
    assert!(compared > 10 * undecided, "{compared} compared, {undecided} undecided");
}

fn positions_of_samples_are_their_twins(device: &Arc<Device>) {
    let evaluator = Evaluator::new(device, "samples.comp", &[]);
    for scene in scenes() {
        let (twin, mut worst) = (twin(&scene), Worst::default());
        for case in cases(device, &evaluator, &scene) {
            let truth = twin.sample_position(&case.pixel, case.index);
            for axis in 0..3 {
                // The way from the entry is a product of four rounded numbers and two roundings; the sum is one more.
                let way = (truth[axis] - case.pixel.entry[axis]).abs();
                let allowed = ROUNDING * (5.0 * way + truth[axis].abs()) + 1e-30;
                let what = || format!("axis {axis} of sample {} of {:?}", case.index, case.pixel);
                worst.see(case.position[axis].into(), truth[axis], allowed, what);
            }
        }
        worst.assert(6000);
    }
}

fn places_of_samples_are_their_twins_beyond_single_precision(device: &Arc<Device>) {
    let evaluator = Evaluator::new(device, "samples.comp", &[]);
    for scene in scenes() {
        let (twin, mut worst) = (twin(&scene), Worst::default());
        for case in cases(device, &evaluator, &scene) {
            let truth = twin.voxel(twin.sample_position(&case.pixel, case.index)) - 0.5;
            for axis in 0..3 {
                assert!((0.0..=1.0).contains(&case.weight[axis]), "{:?}", case.weight);
                // Whole voxels are exact; parts below 4 voxels are added up with four roundings.
                let place = f64::from(case.below[axis]) + f64::from(case.weight[axis]);
                let what = || format!("axis {axis} of sample {} of {:?}", case.index, case.pixel);
                worst.see(place, truth[axis], 8.0 * ROUNDING, what);
            }
        }
        worst.assert(6000);
    }
}
