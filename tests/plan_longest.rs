//! The longest ray of a view: what going through all pixels finds, for much less.

use depthleap::math::polyhedron::HalfSpace;
use depthleap::math::ray::{ViewRays, cut_interval};
use depthleap::scene::Camera;
use depthleap::scene::Region;
use depthleap::scene::longest::longest_ray;
use glam::DVec3;

fn brute(rays: &ViewRays, half: DVec3, planes: &[HalfSpace], region: Region) -> f64 {
    let lengths = region.rows().flat_map(|row| {
        region.columns().map(move |c| {
            let ray = rays.of(c, row);
            let interval = cut_interval(&ray, half, rays.near, planes);
            interval.map_or(0.0, |(enter, leave)| (leave - enter) * ray.direction.length())
        })
    });
    lengths.fold(0.0, f64::max)
}

/// Numbers from 0 to 1, the same in every run.
fn numbers() -> impl FnMut() -> f64 {
    let mut state = 1_u64;
    move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    }
}

#[test]
fn is_what_going_through_all_pixels_finds() {
    let mut number = numbers();
    for i in 0..300 {
        let distance = [0.0, 0.3, 1.0, 2.0, 50.0, 5000.0][i % 6];
        let mut eye = || distance * (number() - 0.5) + 1e-3;
        let eye = DVec3::new(eye(), eye(), eye());
        let half = 0.5 * DVec3::new(1.0, number(), 1e-3 + number());
        let (up, fov_y) = (DVec3::new(0.1, 1.0, 0.3), 1.0 + 168.0 * number());
        // A third of them is orthographic.
        let height = (i % 3 == 2).then(|| 0.01 + 3.0 * number());
        let camera = Camera { eye, target: half * (number() - 0.5), up, fov_y, height };
        let size = [1 + (60.0 * number()) as u32, 1 + (60.0 * number()) as u32];
        let rays = camera.rays(size).unwrap();
        let region = Region { x: 0, y: 0, width: size[0], height: size[1] };
        let normal = |number: &mut dyn FnMut() -> f64| DVec3::new(number() - 0.5, number() - 0.5, number() - 0.5);
        let plane = |_| HalfSpace { normal: normal(&mut number).normalize(), distance: 0.6 * (number() - 0.7) };
        let planes: Vec<HalfSpace> = (0..i % 4).map(plane).collect();
        let found = longest_ray(&rays, half, &planes, region);
        assert_eq!(found, brute(&rays, half, &planes, region), "{camera:?} {size:?} {half} {planes:?}");
    }
}

#[test]
fn costs_little_in_the_largest_picture() {
    let camera = Camera::orbit(30.0, 20.0, 1.91, 45.0);
    let rays = camera.rays([65535, 65535]).unwrap();
    let region = Region { x: 0, y: 0, width: 65535, height: 65535 };
    let slab = |half: f64| [DVec3::Z, DVec3::NEG_Z].map(|normal| HalfSpace { normal, distance: -half });
    let (thin, empty) = (slab(4e-3), slab(-0.1));
    for (planes, least, most) in [(&[][..], 1.0, 3.0_f64.sqrt()), (&thin, 8e-3, 0.02), (&empty, 0.0, 0.0)] {
        let begin = std::time::Instant::now();
        let found = longest_ray(&rays, DVec3::splat(0.5), planes, region);
        assert!(begin.elapsed().as_secs() < 5, "{planes:?}: {:?}", begin.elapsed());
        assert!((least..=most).contains(&found), "{planes:?}: {found}");
    }
}
