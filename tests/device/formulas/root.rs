//! `glsl/shared/root.glsl` and `src/truth/exact/first.rs`: roots of the interpolant along rays.

use std::sync::Arc;

use depthleap::scene::Scene;
use depthleap::shared::Frame;
use depthleap::truth::exact::ExactIntegrator;
use depthleap::vulkan::{Bound, Device, Sampler, vk};
use glam::DVec3;

use super::kit::{Evaluator, Random, SAMPLED, Setup, image};
use super::scene;
use crate::harness::{Test, tests};

pub fn all() -> Vec<Test> {
    tests![roots_on_the_device_are_those_of_f64]
}

/// Pixels of a row, as in the shader.
const ROW: u32 = 64;
const ROWS: u32 = 64;

/// How far a root of the device may be from that of f64, in sides of the volume.
const NEAR: f64 = 2e-6;

/// Roots about which the value changes by less than this in a voxel are not decided: rounding moves them by as much as it is.
const FLAT: f64 = 0.02;

/// A ray, as in ENTRY and DIR.
#[derive(Clone, Copy)]
struct Ray {
    entry: DVec3,
    direction: DVec3,
    length: f64,
}

/// Rays through the volume, of numbers that f32 holds.
fn rays(scene: &Scene, random: &mut Random) -> Vec<Ray> {
    let point = |random: &mut Random| DVec3::from_array([0; 3].map(|_| random.next()));
    (0..ROW * ROWS)
        .map(|_| {
            let entry = point(random).as_vec3().as_dvec3();
            let way = (point(random) - entry) * scene.field.extent();
            Ray { entry, direction: way.normalize().as_vec3().as_dvec3(), length: f64::from(way.length() as f32) }
        })
        .collect()
}

fn roots_on_the_device_are_those_of_f64(device: &Arc<Device>) {
    let (mut decided, mut flat, mut missed, mut farthest) = (0, 0, 0, 0.0f64);
    for (number, volume) in ["marschner-lobb:24", "gaussian:20x31x17", "linear:16"].into_iter().enumerate() {
        let scene = scene(volume);
        let level = 0.45;
        let step = scene.settings.sampling.step * scene.field.finest();
        let rays = rays(&scene, &mut Random(71 + number as u64));
        let integrator = ExactIntegrator::new(&scene.field, &scene.transfer);
        let exact = |ray: &Ray, rises: bool| {
            let values = if rises { [level, f64::INFINITY] } else { [f64::NEG_INFINITY, level] };
            integrator.first_within((ray.entry - 0.5) * scene.field.extent(), ray.direction, ray.length, &[values])
        };
        // A ray that begins on one side is asked where it comes to the other.
        let rises: Vec<bool> = rays.iter().map(|ray| exact(ray, true).is_none_or(|found| found.t > 0.0)).collect();
        let asked: Vec<[f32; 4]> = rays
            .iter()
            .zip(&rises)
            .map(|(ray, rises)| [0.0, (ray.length / step) as f32, level as f32, if *rises { 1.0 } else { -1.0 }])
            .collect();
        let found = on_device(device, &scene, &rays, &asked);
        for ((ray, rises), [steps, ..]) in rays.iter().zip(&rises).zip(found) {
            let Some(root) = exact(ray, *rises) else {
                missed += 1;
                assert!((f64::from(steps) * step - ray.length).abs() < 1e-5, "a ray without a root ends at its end");
                continue;
            };
            if root.slope.abs() * scene.field.finest() < FLAT {
                flat += 1;
                continue;
            }
            decided += 1;
            let off = (f64::from(steps) * step - root.t).abs();
            farthest = farthest.max(off);
            assert!(off <= NEAR, "{volume}: a root at {} is found {off:e} from there", root.t);
        }
    }
    println!("{decided} roots, the farthest {farthest:.1e} off; {flat} too flat to decide, {missed} rays without one");
    assert!(decided > 4000 && missed > 1000 && flat < decided, "{decided} roots, {flat} flat, {missed} missed");
}

/// What the shader finds of each ray.
fn on_device(device: &Arc<Device>, scene: &Scene, rays: &[Ray], asked: &[[f32; 4]]) -> Vec<[f32; 4]> {
    let four = |v: DVec3, w: f64| [v.x as f32, v.y as f32, v.z as f32, w as f32];
    let entry: Vec<f32> = rays.iter().flat_map(|ray| four(ray.entry, 1.0)).collect();
    let direction: Vec<f32> = rays.iter().flat_map(|ray| four(ray.direction, ray.length)).collect();
    let format = vk::Format::R32G32B32A32_SFLOAT;
    let entry = image(device, "entry", [ROW, ROWS, 1], format, &entry);
    let direction = image(device, "direction", [ROW, ROWS, 1], format, &direction);
    let extent = scene.field.dims().map(|n| n as u32);
    let volume = image(device, "volume", extent, vk::Format::R32_SFLOAT, &scene.field.values);
    let sampler = Sampler::new(device, "nearest", false).unwrap();
    let setup = Setup {
        frame: Some(Frame::new(scene, &scene.camera.rays([ROW, ROWS]).unwrap(), 1, [0; 2])),
        resources: vec![
            ("entry", Bound::Sampled(&entry, &sampler, SAMPLED)),
            ("direction", Bound::Sampled(&direction, &sampler, SAMPLED)),
            ("volume", Bound::Sampled(&volume, &sampler, SAMPLED)),
        ],
    };
    Evaluator::new(device, "root.comp", &[]).run(&setup, asked)
}
