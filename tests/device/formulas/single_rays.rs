//! `glsl/shared/single_rays.glsl` and `src/math/ray.rs`: rays in single floats are no farther off than `src/scene/single_rays.rs` says.

use std::sync::Arc;

use depthleap::math::ray::box_interval;
use depthleap::scene::Camera;
use depthleap::scene::single_rays::{ENOUGH, SingleRays};
use depthleap::shared::{self, Frame};
use depthleap::vulkan::{Bound, Buffer, BufferInfo, Device, Place, vk};
use glam::DVec3;

use super::kit::{Evaluator, Random, Setup};
use super::scene;
use crate::harness::{Test, tests};

pub fn all() -> Vec<Test> {
    tests![rays_are_no_farther_off_than_stated]
}

/// The entry point, then direction and length.
type Results = [[f32; 4]; 2];

const SIZE: [u32; 2] = [110, 75];

/// From all around, from far away, from within, with narrow and wide fields of view, and without perspective.
fn cameras() -> Vec<Camera> {
    let mut random = Random(47);
    let camera = |i: usize| {
        let (azimuth, elevation) = (random.between(-180.0, 180.0), random.between(-85.0, 85.0));
        let distance = [random.between(1.1, 4.0), random.between(5.0, 60.0), 0.3][i % 3];
        let fov = [45.0, random.between(5.0, 90.0), 60.0 / distance.max(0.5)][i / 3 % 3];
        let height = (i % 4 == 3).then(|| random.between(0.2, 2.0));
        Camera { height, ..Camera::orbit(azimuth, elevation, distance, fov) }
    };
    (0..72).map(camera).collect()
}

fn rays_are_no_farther_off_than_stated(device: &Arc<Device>) {
    let evaluator = Evaluator::new(device, "single_rays.comp", &[]);
    let boxes = ["shells:8", "shells:8x5x7", "shells:4x16x9"].map(scene);
    // The largest part of what is allowed, rays that were looked at, and views that are good enough for 256 voxels.
    let (mut worst, mut hits, mut enough) = (0.0_f64, 0, 0);
    for (i, camera) in cameras().into_iter().enumerate() {
        let scene = &boxes[i % boxes.len()];
        let (rays, extent) = (camera.rays(SIZE).unwrap(), scene.field.extent());
        let single = SingleRays::new(&rays, extent, SIZE);
        assert!(single.error.is_finite(), "{camera:?}");
        enough += u32::from(256.0 * single.error <= ENOUGH);
        let numbers = shared::SingleRays::new(&single);
        let uniform = Buffer::new(
            device,
            BufferInfo {
                name: "single rays".to_owned(),
                size: size_of::<shared::SingleRays>() as u64,
                usage: vk::BufferUsageFlags::UNIFORM_BUFFER,
                place: Place::Upload,
            },
        )
        .unwrap();
        uniform.write(0, bytemuck::bytes_of(&numbers)).unwrap();
        let frame = Some(Frame::new(scene, &rays, 1, [0; 2]));
        let setup = Setup { frame, resources: vec![("single_rays", Bound::Uniform(&uniform))] };
        let pixels: Vec<[u32; 2]> = (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| [x, y])).collect();
        let arguments: Vec<[f32; 4]> =
            pixels.iter().map(|&[x, y]| [x as f32 + 0.5, y as f32 + 0.5, 0.0, 0.0]).collect();
        let results: Vec<Results> = evaluator.run(&setup, &arguments);
        for (&[x, y], [begin, direction]) in pixels.iter().zip(results) {
            let ray = rays.of(x, y);
            let three = |v: [f32; 4]| DVec3::new(v[0].into(), v[1].into(), v[2].into());
            let (entry, length) = (three(begin), f64::from(direction[3]));
            let way = three(direction) * length / extent;
            let Some((enter, leave)) = box_interval(&ray, 0.5 * extent, rays.near) else {
                // Along an edge, a ray that misses may hit.
                assert!((way.abs().max_element()) <= 4.0 * single.error, "{camera:?} {x} {y}: {direction:?}");
                continue;
            };
            hits += 1;
            let at = |depth: f64| ray.at(depth) / extent + 0.5;
            if length == 0.0 {
                let true_way = (at(leave) - at(enter)).abs().max_element();
                assert!(true_way <= 4.0 * single.error, "{camera:?} {x} {y}: {true_way:e} long");
                continue;
            }
            // Half way, too, where samples are.
            let middle = 0.5 * (enter + leave);
            for (found, truth) in [(entry, at(enter)), (entry + way, at(leave)), (entry + 0.5 * way, at(middle))] {
                let off = (found - truth).abs().max_element();
                assert!(
                    off <= single.error,
                    "{camera:?} {x} {y}: {found} for {truth}, off by {off:e}, {:e} is stated",
                    single.error
                );
                worst = worst.max(off / single.error);
            }
        }
    }
    assert!(hits > 50_000 && enough > 30, "{hits} rays, {enough} views");
    // A bound that nothing comes near says little.
    assert!(worst > 0.05, "the largest error is {worst} of what is stated");
}
