//! Rays in single floats: the numbers that devices find them by, and when these are good enough.

use depthleap::math::ray::ViewRays;
use depthleap::plan::plan;
use depthleap::read;
use depthleap::scene::settings::Filter;
use depthleap::scene::single_rays::{Even, SingleRays};
use depthleap::scene::{Camera, Settings};
use glam::DVec3;

const SIZE: [u32; 2] = [500, 430];

fn rays(camera: Camera) -> ViewRays {
    camera.rays(SIZE).unwrap()
}

/// What a number comes to at a column and a row from the middle, each operation rounded to f32.
fn in_f32(even: &Even, column: f64, row: f64) -> [f32; 3] {
    let [middle, right, down] = [even.middle, even.right, even.down].map(|v| v.to_array().map(|c| c as f32));
    std::array::from_fn(|axis| (middle[axis] + column as f32 * right[axis]) + row as f32 * down[axis])
}

#[test]
fn high_parts_are_exact_in_f32_and_low_parts_small() {
    for camera in [Camera::orbit(30.0, 20.0, 1.91, 45.0), Camera::orbit(71.0, -33.0, 40.0, 3.0)] {
        let rays = rays(camera);
        let single = SingleRays::new(&rays, DVec3::new(1.0, 0.7, 0.9), SIZE);
        for [high, low] in [&single.place, &single.heading] {
            for (x, y) in [(0.5, 0.5), (-249.5, 214.5), (249.5, -214.5), (-0.5, 101.5)] {
                let exact = high.middle + x * high.right + y * high.down;
                assert_eq!(in_f32(high, x, y).map(f64::from), exact.to_array(), "{camera:?}");
                let left = (low.middle + x * low.right + y * low.down).abs().max_element();
                let whole = exact.abs().max_element();
                assert!(left < 1e-4 * whole, "{camera:?}: {left:e} of {whole}");
            }
        }
    }
}

#[test]
fn parts_are_those_of_the_rays() {
    let (extent, rays) = (DVec3::new(1.0, 0.7, 0.9), rays(Camera::orbit(30.0, 20.0, 1.91, 45.0)));
    let single = SingleRays::new(&rays, extent, SIZE);
    for [column, row] in [[0, 0], [273, 245], [499, 429]] {
        let ray = rays.of(column, row);
        let [x, y] = [f64::from(column) + 0.5 - single.center[0], f64::from(row) + 0.5 - single.center[1]];
        let sum = |parts: &[Even; 2]| -> DVec3 {
            parts.iter().map(|even| even.middle + x * even.right + y * even.down).sum()
        };
        let middle = rays.near - single.near;
        assert!((sum(&single.place) * extent - ray.at(middle)).length() < 1e-14);
        assert!((sum(&single.heading) * extent - ray.direction).length() < 1e-14);
    }
}

#[test]
fn what_is_off_does_not_grow_with_the_distance_of_the_eye() {
    let off = |distance: f64| {
        let fov = 2.0 * (0.8 / distance).atan().to_degrees();
        SingleRays::new(&rays(Camera::orbit(30.0, 20.0, distance, fov)), DVec3::ONE, SIZE).error
    };
    let near = off(2.0);
    assert!(near < 2e-6, "{near:e}");
    for distance in [8.0, 32.0, 128.0] {
        assert!(off(distance) < 1.5 * near, "{:e} at {distance}, {near:e} at 2", off(distance));
    }
}

/// Where a ray meets a face along which it runs, or does not meet it, single floats tell little.
#[test]
fn what_is_off_grows_as_faces_are_seen_from_their_planes() {
    let off = |eye: DVec3, height: Option<f64>| {
        SingleRays::new(&rays(Camera { eye, height, ..Camera::orbit(0.0, 0.0, 2.0, 45.0) }), DVec3::ONE, SIZE).error
    };
    let level = |over: f64| off(DVec3::new(0.9, 0.5 + over, 1.4), None);
    assert!(level(1e-6) > 2.0 * level(0.1), "{:e}, {:e}", level(1e-6), level(0.1));
    assert_eq!(level(0.0), f64::INFINITY);
    assert_eq!(off(DVec3::new(0.0, 0.0, 2.0), Some(1.2)), f64::INFINITY);
}

#[test]
fn plans_have_them_where_the_texture_unit_interpolates_and_the_view_lets_them() {
    let steps = |change: fn(&mut Settings)| {
        let mut settings = Settings::default();
        settings.volume.builtin = Some("shells:64".to_owned());
        settings.sampling.filter = Filter::Hardware;
        change(&mut settings);
        let plan = plan(&read::scene(&settings).unwrap(), None).unwrap();
        let reads = plan.frame().iter().any(|step| step.accesses.iter().any(|a| a.resource.name() == "single_rays"));
        assert_eq!(reads, plan.rays_off > 0.0);
        reads
    };
    assert!(steps(|_| ()));
    assert!(!steps(|s| s.sampling.filter = Filter::Exact));
    // Without the planner the picture is the same to the bit.
    assert!(steps(|s| s.method.planner = false));
    assert!(!steps(|s| (s.camera.eye, s.camera.height) = ([0.0, 0.0, 2.0], Some(1.2))));
}
