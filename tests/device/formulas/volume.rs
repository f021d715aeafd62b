//! `glsl/shared/volume.glsl`, the cells of `samples.glsl`, `transfer.glsl` and `block.glsl` and their twins.

use std::sync::Arc;

use depthleap::math::interpolate::trilinear;
use depthleap::scene::transfer::Knot;
use depthleap::scene::{Scene, TransferFunction};
use depthleap::shared::{Frame, pieces, rows};
use depthleap::structure::blocks::{Blocks, range_codes};
use depthleap::vulkan::{Bound, Buffer, BufferInfo, Device, Place, Sampler, vk};
use glam::DVec3;

use super::kit::{Evaluator, ROUNDING, Random, SAMPLED, Setup, Worst, image};
use super::scene;
use crate::harness::{Test, tests};

pub fn all() -> Vec<Test> {
    tests![
        interpolation_in_the_shader_is_its_twin,
        cell_is_its_twin,
        classification_is_its_twin,
        block_codes_and_counts_are_their_twins,
    ]
}

/// Cell and value; colour and opacity; codes of a range and blocks along x and y.
type Results = [[f32; 4]; 3];

/// Position in texture coordinates, scalar value; the first and the last make a range too.
type Arguments = [f32; 4];

/// A noise that leaves no two neighbours alike.
fn noise(dims: &str) -> Scene {
    let mut scene = scene(dims);
    let mut random = Random(61);
    let mut field = (*scene.field).clone();
    field.values.iter_mut().for_each(|value| *value = random.next() as f32);
    scene.field = Arc::new(field);
    scene
}

fn transfer(random: &mut Random) -> TransferFunction {
    // Places that f32 holds exactly, some twice.
    let mut places: Vec<f64> = (0..21).map(|_| (16.0 * random.next()).floor() / 16.0).collect();
    places.sort_by(f64::total_cmp);
    let knots = places.iter().map(|&x| Knot { x, color: [0.0; 3].map(|_: f64| random.next()), opacity: random.next() });
    TransferFunction::new("random", knots.collect(), 1.0).unwrap()
}

fn results(device: &Arc<Device>, scene: &Scene, arguments: &[Arguments]) -> Vec<Results> {
    let extent = scene.field.dims().map(|n| n as u32);
    let volume = image(device, "volume", extent, vk::Format::R32_SFLOAT, &scene.field.values);
    let sampler = Sampler::new(device, "nearest", false).unwrap();
    let pieces = pieces(&scene.transfer);
    let rows = rows(&pieces, false);
    let bytes: &[u8] = bytemuck::cast_slice(&rows);
    let (size, usage) = (bytes.len() as u64, vk::BufferUsageFlags::STORAGE_BUFFER);
    let info = BufferInfo { name: "transfer".to_owned(), size, usage, place: Place::Upload };
    let transfer = Buffer::new(device, info).unwrap();
    transfer.write(0, bytes).unwrap();
    let count = pieces.len() as u32;
    let setup = Setup {
        frame: Some(Frame::new(scene, &scene.camera.rays([4, 4]).unwrap(), 1, [0; 2])),
        resources: vec![
            ("volume", Bound::Sampled(&volume, &sampler, SAMPLED)),
            ("transfer", Bound::Storage(&transfer)),
        ],
    };
    let constants = [("PIECES", count), ("SEARCH", count.next_power_of_two() / 2)];
    Evaluator::new(device, "volume.comp", &constants).run(&setup, arguments)
}

/// A number where something jumps, and its neighbours; beside 0 the nearest that no driver takes for 0.
fn beside(x: f32) -> [f32; 3] {
    match x == 0.0 {
        true => [0.0, -f32::MIN_POSITIVE, f32::MIN_POSITIVE],
        false => [x, x.next_down(), x.next_up()],
    }
}

fn random_arguments(random: &mut Random) -> Vec<Arguments> {
    // Beyond the faces too, where the edge goes on; values in and around the range.
    let coordinate = |random: &mut Random| random.between(-0.1, 1.1) as f32;
    (0..20_000).map(|_| [0; 4].map(|_| coordinate(random))).collect()
}

const SHAPES: [&str; 3] = ["shells:8", "shells:17x5x9", "shells:31x2x3"];

fn voxel(scene: &Scene, a: &Arguments) -> DVec3 {
    DVec3::from_array(std::array::from_fn(|axis| f64::from(a[axis]) * scene.field.dims()[axis] as f64))
}

fn interpolation_in_the_shader_is_its_twin(device: &Arc<Device>) {
    for shape in SHAPES {
        let (scene, mut worst) = (noise(shape), Worst::default());
        let arguments = random_arguments(&mut Random(62));
        for (a, r) in arguments.iter().zip(results(device, &scene, &arguments)) {
            let at = voxel(&scene, a);
            let truth = trilinear(&scene.field.values, scene.field.dims(), at);
            // Values lie in [0, 1]. A weight is off by the rounding of a voxel coordinate, twice; each of the three
            // interpolations adds two roundings of its own.
            let allowed = ROUNDING * (2.0 * at.abs().element_sum() + 6.0);
            worst.see(r[0][3].into(), truth, allowed, || format!("voxel {at} of {shape}"));
        }
        worst.assert(20_000);
    }
}

fn cell_is_its_twin(device: &Arc<Device>) {
    for shape in SHAPES {
        let scene = noise(shape);
        let arguments = random_arguments(&mut Random(63));
        let mut compared = 0;
        for (a, r) in arguments.iter().zip(results(device, &scene, &arguments)) {
            let at = voxel(&scene, a);
            // f32 cannot tell the side of a boundary nearer than two roundings of the coordinate.
            let beside = (at - 0.5 - (at - 0.5).round()).abs();
            if beside.cmple(2.0 * ROUNDING * (at.abs() + 1.0)).any() {
                continue;
            }
            compared += 1;
            assert_eq!(r[0][..3], scene.field.cell_at(at).map(|c| c as f32), "voxel {at} of {shape}");
        }
        assert!(compared > 19_000, "{compared}");
    }
}

fn classification_is_its_twin(device: &Arc<Device>) {
    let mut random = Random(64);
    for _ in 0..8 {
        let scene = Scene { transfer: transfer(&mut random), ..scene("shells:8") };
        let mut arguments = random_arguments(&mut random);
        let places = scene.transfer.knots().iter().map(|knot| knot.x as f32);
        arguments.extend(places.flat_map(beside).map(|x| [0.5, 0.5, 0.5, x]));
        let mut worst = Worst::default();
        for (a, r) in arguments.iter().zip(results(device, &scene, &arguments)) {
            let truth = scene.transfer.evaluate(a[3].into());
            for c in 0..4 {
                // The weight has four roundings, the change two, the sum one; all numbers lie in [0, 1].
                worst.see(r[1][c].into(), truth[c], 8.0 * ROUNDING, || format!("component {c} at {}", a[3]));
            }
        }
        worst.assert(80_000);
    }
}

fn block_codes_and_counts_are_their_twins(device: &Arc<Device>) {
    for shape in SHAPES {
        let scene = scene(shape);
        let mut arguments = random_arguments(&mut Random(65));
        let codes = (0..256).map(|code| code as f32 / 255.0).flat_map(beside);
        arguments.extend(codes.map(|x| [x, 0.0, 0.0, x]));
        let [blocks_x, blocks_y, _] = Blocks::dims(&scene.field);
        for (a, r) in arguments.iter().zip(results(device, &scene, &arguments)) {
            let (low, high) = range_codes(a[0], a[3]);
            let expected = [low.into(), high.into(), blocks_x as f32, blocks_y as f32];
            assert_eq!(r[2], expected, "{} to {} in {shape}", a[0], a[3]);
        }
    }
}
