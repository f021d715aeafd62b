//! `glsl/shared/polygon.glsl`: where surfaces are on their rays.

use std::sync::Arc;

use depthleap::math::ray::{ViewRays, box_interval};
use depthleap::scene::mesh::Polygons;
use depthleap::scene::settings::MeshSettings;
use depthleap::scene::{Camera, Settings};
use depthleap::vulkan::{Bound, Buffer, BufferInfo, Device, Place, vk};
use depthleap::{read, shared};

use super::kit::{Evaluator, Random, Setup, Worst};
use crate::harness::{Test, tests};

pub fn all() -> Vec<Test> {
    tests![surfaces_are_where_they_are]
}

/// What a surface may be away from its place: parts of the volume's longest side.
const PLACE: f64 = 1e-6;

const SIZE: [u32; 2] = [33, 25];

/// Meshes across the volume, near the eye and far behind.
fn polygons() -> Polygons {
    let mesh = |builtin: &str, scale, translate| MeshSettings {
        builtin: Some(builtin.to_owned()),
        rotate: [17.0, 29.0, 41.0],
        scale,
        translate,
        ..MeshSettings::default()
    };
    let mut settings = Settings::default();
    settings.volume.builtin = Some("shells:8x5x7".to_owned());
    settings.meshes = vec![
        mesh("sphere:40", 0.8, [0.0; 3]),
        mesh("teapot:12", 0.6, [0.3, -0.1, 0.2]),
        mesh("box", 0.01, [0.1, 0.4, 0.1]),
        mesh("torus:30", 1.4, [-0.4, 0.2, -0.6]),
    ];
    (*read::scene(&settings).unwrap().polygons).clone()
}

fn surfaces_are_where_they_are(device: &Arc<Device>) {
    let polygons = polygons();
    let mut random = Random(53);
    let evaluators = ["polygon.comp", "polygon.comp:ORTHOGRAPHIC"].map(|name| Evaluator::new(device, name, &[]));
    let mut worst = Worst::default();
    let mut largest = 0.0f64;
    for view in 0..12 {
        let eye_distance = if view % 3 == 0 { 0.2 } else { random.between(0.8, 4.0) };
        let (azimuth, elevation) = (random.between(-180.0, 180.0), random.between(-80.0, 80.0));
        let orthographic = view % 4 == 1;
        let height = orthographic.then_some(1.6);
        let camera = Camera { height, ..Camera::orbit(azimuth, elevation, eye_distance, 50.0) };
        let scene = super::scene("shells:8x5x7");
        let rays = camera.rays(SIZE).unwrap();
        // The near plane is a plain f32 on the device.
        let rays = ViewRays { near: f64::from(rays.near as f32), ..rays };
        let mut arguments = Vec::new();
        let mut truths = Vec::new();
        for i in 0..SIZE[0] * SIZE[1] {
            let pixel = [i % SIZE[0], i / SIZE[0]];
            let ray = rays.of(pixel[0], pixel[1]);
            let direction = ray.direction;
            let half = 0.5 * scene.field.extent();
            let Some((enter, _)) = box_interval(&ray, half, rays.near) else { continue };
            for crossing in polygons.crossings(&rays, pixel, 0.0).list {
                let (x, y) = (pixel[0] as f32 + 0.5, pixel[1] as f32 + 0.5);
                arguments.push([x, y, crossing.triangle as f32, 0.0]);
                let normal = polygons.triangles[crossing.triangle as usize].normal;
                // A surface that is seen from its side moves along the ray by more than its plane does.
                let slant = (normal.dot(direction) / direction.length()).abs();
                truths.push(((crossing.depth - enter) * direction.length(), slant, crossing));
            }
        }
        let found = run(device, &evaluators[usize::from(orthographic)], &polygons, &rays, &scene, &arguments);
        for ((way, slant, crossing), [place, key, shown, front]) in truths.into_iter().zip(found) {
            let what = || format!("triangle {} in view {view}, seen at a cosine of {slant:.1e}", crossing.triangle);
            // The way is as long as it is, to 2^-24 of it; the sides of the box are 1 at the most.
            let allowed = PLACE * way.abs().max(1.0);
            worst.see(f64::from(place), way, allowed, what);
            largest = largest.max((f64::from(place) - way).abs() / way.abs().max(1.0));
            let nearness = rays.near / crossing.depth;
            worst.see(f64::from(key), nearness, 1e-6 * nearness, what);
            assert_eq!((shown, front), (1.0, f32::from(u8::from(crossing.front))), "{}", what());
        }
    }
    println!("the farthest surface is {largest:.1e} away from its place");
    worst.assert(10_000);
}

fn run(
    device: &Arc<Device>,
    evaluator: &Evaluator,
    polygons: &Polygons,
    rays: &ViewRays,
    scene: &depthleap::scene::Scene,
    arguments: &[[f32; 4]],
) -> Vec<[f32; 4]> {
    let triangles: Vec<_> = polygons.triangles.iter().map(|one| shared::Triangle::new(one, rays.origin)).collect();
    let materials: Vec<_> = polygons.materials.iter().map(shared::Material::new).collect();
    let buffer = |name: &str, bytes: &[u8]| {
        let usage = vk::BufferUsageFlags::STORAGE_BUFFER;
        let info = BufferInfo { name: name.to_owned(), size: bytes.len() as u64, usage, place: Place::Upload };
        let buffer = Buffer::new(device, info).unwrap();
        buffer.write(0, bytes).unwrap();
        buffer
    };
    let triangles = buffer("triangles", bytemuck::cast_slice(&triangles));
    let materials = buffer("materials", bytemuck::cast_slice(&materials));
    let setup = Setup {
        frame: Some(shared::Frame::new(scene, rays, 1, [0; 2])),
        resources: vec![("triangles", Bound::Storage(&triangles)), ("materials", Bound::Storage(&materials))],
    };
    if arguments.is_empty() { Vec::new() } else { evaluator.run(&setup, arguments) }
}
