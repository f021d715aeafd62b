//! `glsl/shared/ray.glsl` and `src/math/ray.rs`: where rays meet the box.

use std::sync::Arc;

use depthleap::math::polyhedron::HalfSpace;
use depthleap::math::ray::{ViewRay, ViewRays, box_interval, cut_interval};
use depthleap::scene::{Camera, Scene};
use depthleap::shared::{ClipPlane, Frame};
use depthleap::vulkan::{Bound, Buffer, BufferInfo, Device, Place, vk};
use glam::DVec3;

use super::kit::{Evaluator, Random, Setup, Worst};
use super::scene;
use crate::harness::{Test, tests};

pub fn all() -> Vec<Test> {
    tests![
        interval_is_its_twin,
        planes_cut_as_in_the_twin,
        points_on_faces_are_exact,
        texture_coordinates_are_their_twins
    ]
}

/// The interval's ends, then for each axis the coordinate at both; double-floats.
type Results = [[f32; 4]; 4];

/// A ray of a view, its results and what is right.
struct Case {
    ray: ViewRay,
    half: DVec3,
    results: Results,
    truth: Option<(f64, f64)>,
    /// What double-floats can tell of depths along this ray.
    allowed: f64,
}

const SIZE: [u32; 2] = [64, 48];

/// The shaders of both kinds of views, and the height of an orthographic picture.
const LENSES: [(&str, Option<f64>); 2] = [("", None), ("ORTHOGRAPHIC", Some(1.7))];

/// Rays from all around, through the corners' neighbourhood, along an axis and from the inside.
fn views(height: Option<f64>) -> Vec<(Scene, Camera)> {
    let mut random = Random(41);
    let boxes = ["shells:8", "shells:8x5x7", "shells:4x16x9"].map(scene);
    let mut cameras: Vec<Camera> = (0..12)
        .map(|_| {
            Camera::orbit(
                random.between(-180.0, 180.0),
                random.between(-80.0, 80.0),
                random.between(0.6, 4.0),
                random.between(10.0, 90.0),
            )
        })
        .collect();
    cameras.push(Camera::orbit(0.0, 0.0, 1.91, 45.0));
    cameras.push(Camera { eye: DVec3::new(0.1, -0.05, 0.02), ..Camera::orbit(30.0, 20.0, 2.0, 70.0) });
    let all = cameras.into_iter().enumerate();
    all.map(|(i, camera)| (boxes[i % 3].clone(), Camera { height, ..camera })).collect()
}

fn cases(device: &Arc<Device>) -> Vec<Case> {
    let mut cases = Vec::new();
    for (define, height) in LENSES {
        of_lens(&Evaluator::new(device, &format!("ray.comp:{define}"), &[]), height, &mut cases);
    }
    cases
}

fn of_lens(evaluator: &Evaluator, height: Option<f64>, cases: &mut Vec<Case>) {
    for (scene, camera) in views(height) {
        let rays = camera.rays(SIZE).unwrap();
        // The near plane is a plain f32 on the device.
        let rays = ViewRays { near: f64::from(rays.near as f32), ..rays };
        let frame = Some(Frame::new(&scene, &rays, 1, [0; 2]));
        let pixels: Vec<[u32; 2]> = (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| [x, y])).collect();
        let arguments: Vec<[f32; 4]> =
            pixels.iter().map(|&[x, y]| [x as f32 + 0.5, y as f32 + 0.5, 0.0, 0.0]).collect();
        let results = evaluator.run(&Setup { frame, ..Setup::default() }, &arguments);
        let half = 0.5 * scene.field.extent();
        for (&[x, y], results) in pixels.iter().zip(results) {
            let ray = rays.of(x, y);
            let truth = box_interval(&ray, half, rays.near);
            // A component of the direction is a sum of numbers up to 1, each good to 2^-44; the smaller it is, the
            // larger is what that error makes of the depth, which is at most 5.
            let smallest = ray.direction.abs().min_element();
            let allowed = 5.0 * 2_f64.powi(-42) / smallest.max(1e-9);
            cases.push(Case { ray, half, results, truth, allowed });
        }
    }
}

fn joined(high: f32, low: f32) -> f64 {
    f64::from(high) + f64::from(low)
}

fn interval_is_its_twin(device: &Arc<Device>) {
    let mut worst = Worst::default();
    let (mut hits, mut misses) = (0, 0);
    for case in cases(device) {
        let [enter_high, enter_low, leave_high, leave_low] = case.results[0];
        let (enter, leave) = (joined(enter_high, enter_low), joined(leave_high, leave_low));
        let told = (enter < leave).then_some((enter, leave));
        match (told, case.truth) {
            (Some((enter, leave)), Some(truth)) => {
                hits += 1;
                worst.see(enter, truth.0, case.allowed, || format!("entry of {:?}", case.ray));
                worst.see(leave, truth.1, case.allowed, || format!("exit of {:?}", case.ray));
            }
            (None, None) => misses += 1,
            // Through an edge, to the last bit.
            _ => assert!((enter - leave).abs() <= 2.0 * case.allowed, "{:?}", case.ray),
        }
    }
    assert!(hits > 5000 && misses > 5000, "{hits} hits, {misses} misses");
    worst.assert(10_000);
}

/// Rays that rise less over a plane run in it, as far as double-floats tell; where it goes through the eye they may be on either side.
const RAY_IN_PLANE: f64 = 1e-11;

/// One plane to three, some through the box, some through the eye.
fn planes_cut_as_in_the_twin(device: &Arc<Device>) {
    let [perspective, orthographic] =
        ["ray.comp:PLANES", "ray.comp:ORTHOGRAPHIC+PLANES"].map(|name| Evaluator::new(device, name, &[]));
    let mut random = Random(43);
    let mut worst = Worst::default();
    let (mut cut, mut misses) = (0, 0);
    let views = LENSES.into_iter().flat_map(|(_, height)| views(height));
    for (i, (scene, camera)) in views.enumerate() {
        let evaluator = if camera.height.is_some() { &orthographic } else { &perspective };
        let rays = camera.rays(SIZE).unwrap();
        let rays = ViewRays { near: f64::from(rays.near as f32), ..rays };
        let mut plane = |n: usize| {
            let mut component = || random.between(-1.0, 1.0);
            let normal = DVec3::new(component(), component(), component()).normalize();
            let distance = if (i + n).is_multiple_of(4) { normal.dot(rays.origin) } else { 0.3 * component() - 0.2 };
            HalfSpace { normal, distance }
        };
        let planes: Vec<HalfSpace> = (0..1 + i % 3).map(&mut plane).collect();
        let heights: Vec<ClipPlane> = planes.iter().map(|plane| ClipPlane::new(plane, &rays)).collect();
        let storage = Buffer::new(
            device,
            BufferInfo {
                name: "clip planes".to_owned(),
                size: size_of_val(heights.as_slice()) as u64,
                usage: vk::BufferUsageFlags::STORAGE_BUFFER,
                place: Place::Upload,
            },
        )
        .unwrap();
        storage.write(0, bytemuck::cast_slice(&heights)).unwrap();
        let frame = Some(Frame::new(&scene, &rays, 1, [0; 2]));
        let pixels: Vec<[u32; 2]> = (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| [x, y])).collect();
        let arguments: Vec<[f32; 4]> =
            pixels.iter().map(|&[x, y]| [x as f32 + 0.5, y as f32 + 0.5, 0.0, 0.0]).collect();
        let setup = Setup { frame, resources: vec![("clip_planes", Bound::Storage(&storage))] };
        let results: Vec<Results> = evaluator.run(&setup, &arguments);
        let half = 0.5 * scene.field.extent();
        for (&[x, y], results) in pixels.iter().zip(results) {
            let ray = rays.of(x, y);
            let direction = ray.direction;
            let [enter_high, enter_low, leave_high, leave_low] = results[0];
            let (enter, leave) = (joined(enter_high, enter_low), joined(leave_high, leave_low));
            let told = (enter < leave).then_some((enter, leave));
            // As for the box: a rise over the plane is a component of the direction, and depths are up to 5 where they count.
            let rises = planes.iter().map(|plane| plane.normal.dot(direction).abs()).fold(f64::INFINITY, f64::min);
            let smallest = direction.abs().min_element().min(rises);
            let allowed = 5.0 * 2_f64.powi(-42) / smallest.max(1e-9);
            match (told, cut_interval(&ray, half, rays.near, &planes)) {
                (Some(told), Some(truth)) => {
                    cut += u32::from(Some(truth) != box_interval(&ray, half, rays.near));
                    let what = || format!("{planes:?} of {ray:?}");
                    worst.see(told.0, truth.0, allowed, what);
                    worst.see(told.1, truth.1, allowed, what);
                }
                (None, None) => misses += 1,
                // Along an edge of what is left.
                _ => {
                    assert!((enter - leave).abs() <= 2.0 * allowed || rises <= RAY_IN_PLANE, "{planes:?} {ray:?}")
                }
            }
        }
    }
    assert!(cut > 1000 && misses > 5000, "{cut} cut, {misses} misses");
    worst.assert(4000);
}

fn points_on_faces_are_exact(device: &Arc<Device>) {
    let mut faces = 0;
    for case in cases(device).iter().filter(|case| case.truth.is_some()) {
        let on_a_face = |at: usize| {
            case.results[1..].iter().any(|axis| axis[at + 1] == 0.0 && (axis[at] == 0.0 || axis[at] == 1.0))
        };
        // A ray enters at the near plane where the eye is inside; it always leaves by a face.
        let inside = case.ray.origin.abs().cmplt(case.half).all();
        assert!(inside || on_a_face(0), "entry of {:?}: {:?}", case.ray, case.results);
        assert!(on_a_face(2), "exit of {:?}: {:?}", case.ray, case.results);
        faces += 1;
    }
    assert!(faces > 5000, "{faces}");
}

fn texture_coordinates_are_their_twins(device: &Arc<Device>) {
    let mut worst = Worst::default();
    for case in &cases(device) {
        let Some((enter, leave)) = case.truth else { continue };
        for axis in 0..3 {
            let [enter_high, enter_low, leave_high, leave_low] = case.results[axis + 1];
            let at = |depth: f64| case.ray.at(depth)[axis] / (2.0 * case.half[axis]) + 0.5;
            // The depth's error, in parts of the box's side, and the arithmetic's own.
            let allowed = (case.allowed + 2_f64.powi(-40)) / (2.0 * case.half[axis]);
            let what = || format!("axis {axis} of {:?}", case.ray);
            worst.see(joined(enter_high, enter_low), at(enter), allowed, what);
            worst.see(joined(leave_high, leave_low), at(leave), allowed, what);
        }
    }
    worst.assert(30_000);
}
