//! Meshes in their places: shapes are closed and face outwards, rays meet them where closed forms say, wrong places are
//! refused.

use std::collections::HashMap;

use depthleap::math::bvh::{Bounds, Hierarchy};
use depthleap::read;
use depthleap::scene::mesh::{Mesh, SHAPES, shape};
use depthleap::scene::settings::{MeshSettings, Settings};
use depthleap::scene::{Camera, Scene};
use glam::DVec3;

fn point(corner: [f32; 3]) -> DVec3 {
    DVec3::from_array(corner.map(f64::from))
}

fn scene(meshes: Vec<MeshSettings>) -> Scene {
    let mut settings = Settings { meshes, ..Settings::default() };
    settings.volume.builtin = Some("shells:8".to_owned());
    settings.image.size = [40, 30];
    read::scene(&settings).unwrap()
}

fn mesh(builtin: &str) -> MeshSettings {
    MeshSettings { builtin: Some(builtin.to_owned()), opacity: 0.5, ..MeshSettings::default() }
}

/// The volume within a closed mesh, negative where its fronts are inside.
fn content(mesh: &Mesh) -> f64 {
    let six = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|i| point(mesh.corners[i as usize]));
        a.dot(b.cross(c))
    };
    mesh.triangles.iter().map(six).sum::<f64>() / 6.0
}

#[test]
fn shapes_are_closed_and_their_fronts_outside() {
    for row in &SHAPES {
        for segments in ["", ":3", ":7", ":200"] {
            let mesh = shape(&format!("{}{segments}", row.name)).unwrap();
            // By places, since a circle's last corner is its first.
            let key = |i: u32| mesh.corners[i as usize].map(|c| (c + 0.0).to_bits());
            let mut edges: HashMap<_, i32> = HashMap::new();
            for [a, b, c] in &mesh.triangles {
                for (from, to) in [(a, b), (b, c), (c, a)] {
                    *edges.entry((key(*from), key(*to))).or_default() += 1;
                    *edges.entry((key(*to), key(*from))).or_default() -= 1;
                }
            }
            let open = edges.values().filter(|n| **n != 0).count();
            assert_eq!(open, 0, "{}{segments}: {open} of {} edges are open", row.name, edges.len());
            assert!(content(&mesh) > 0.0, "{}{segments} is inside out", row.name);
            let [least, greatest] = mesh.bounds();
            assert!((0.8..=1.0 + 1e-6).contains(&(greatest - least).max_element()), "{}: {least} {greatest}", row.name);
        }
    }
    let ball = content(&shape("sphere:200").unwrap());
    assert!((ball - std::f64::consts::PI / 6.0).abs() < 1e-3, "{ball}");
}

#[test]
fn wrong_shapes_are_named() {
    for (spec, says) in [
        ("spheer", "did you mean `sphere`"),
        ("sphere:2", "from 3 to 2048"),
        ("sphere:x", "from 3 to 2048"),
        ("torus:99999999999999999999", "from 3 to 2048"),
    ] {
        let error = shape(spec).unwrap_err().to_string();
        assert!(error.contains(says), "{error}");
    }
}

#[test]
fn rays_meet_a_sphere_where_its_equation_says() {
    let scene = scene(vec![MeshSettings { scale: 0.8, translate: [0.1, 0.05, -0.1], ..mesh("sphere:500") }]);
    let size = scene.settings.image.size;
    let rays = scene.camera.rays(size).unwrap();
    let centre = DVec3::new(0.1, 0.05, -0.1);
    let mut met = 0;
    for i in 0..size[0] * size[1] {
        let pixel = [i % size[0], i / size[0]];
        let direction = rays.of(pixel[0], pixel[1]).direction;
        let (a, b) = (direction.length_squared(), direction.dot(rays.origin - centre));
        let root = b * b - a * ((rays.origin - centre).length_squared() - 0.16);
        let found = scene.polygons.crossings(&rays, pixel, 0.0).list;
        // Facets lie up to 8e-6 inside of the sphere.
        if root.abs() < 1e-3 {
            continue;
        }
        assert_eq!(found.len(), if root > 0.0 { 2 } else { 0 }, "pixel {pixel:?}");
        if root > 0.0 {
            met += 1;
            let depths = [(-b - root.sqrt()) / a, (-b + root.sqrt()) / a];
            for (crossing, (depth, front)) in found.iter().zip(depths.into_iter().zip([true, false])) {
                assert!((crossing.depth - depth).abs() < 5e-4, "{} is not {depth}", crossing.depth);
                assert_eq!(crossing.front, front);
            }
        }
    }
    assert!(met > 100, "{met} rays");
}

#[test]
fn mirrored_meshes_keep_their_fronts() {
    let mirror = vec![[-1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];
    for transform in [None, Some(mirror)] {
        let scene = scene(vec![MeshSettings { transform, ..mesh("teapot") }]);
        for one in &scene.polygons.triangles {
            let [a, b, c] = one.corners.map(point);
            assert!((b - a).cross(c - a).dot(one.normal) > 0.0);
        }
        let inside: f64 = scene
            .polygons
            .triangles
            .iter()
            .map(|t| {
                let [a, b, c] = t.corners.map(point);
                a.dot(b.cross(c))
            })
            .sum();
        assert!(inside > 0.0);
    }
}

#[test]
fn fitted_turned_and_moved_in_that_order() {
    let settings = MeshSettings {
        fit: Some(2.0),
        scale: 3.0,
        rotate: [90.0, 0.0, 0.0],
        translate: [1.0, 2.0, 3.0],
        ..mesh("box")
    };
    let place = settings.placed().place([DVec3::splat(10.0), DVec3::splat(14.0)]);
    // (12, 13, 12): (0, 1, 0) about the centre, halved to (0, 0.5, 0), 1.5 long, turned to z.
    let found = place.transform_point3(DVec3::new(12.0, 13.0, 12.0));
    assert!((found - DVec3::new(1.0, 2.0, 4.5)).length() < 1e-12, "{found}");
}

#[test]
fn transparent_triangles_come_first_and_opaque_ones_end_rays() {
    let scene = scene(vec![
        MeshSettings { opacity: 1.0, scale: 0.3, ..mesh("box") },
        MeshSettings { scale: 0.6, ..mesh("sphere:12") },
    ]);
    let polygons = &scene.polygons;
    assert!(polygons.transparent().all(|i| !polygons.material(i as u32).is_opaque()));
    assert_eq!(polygons.opaque().len(), 12);
    let rays = scene.camera.rays([41, 31]).unwrap();
    let surfaces = polygons.divided(&rays, [20, 15], 8).surfaces;
    assert_eq!(surfaces.len(), 2, "{surfaces:?}");
    assert_eq!([surfaces[0].color[3], surfaces[1].color[3]], [0.5, 1.0]);
    // Looked at from behind: as many.
    let behind = scene.clone().seen_by(Camera { eye: DVec3::new(0.0, 0.0, -2.0), ..(&scene.settings.camera).into() });
    assert_eq!(behind.polygons.divided(&behind.camera.rays([41, 31]).unwrap(), [20, 15], 8).surfaces.len(), 2);
}

#[test]
fn layers_that_are_lacking_are_counted() {
    let scene = scene(vec![mesh("sphere:9"), MeshSettings { scale: 0.5, ..mesh("sphere:9") }]);
    let rays = scene.camera.rays([41, 31]).unwrap();
    let of = |most| scene.polygons.lacking(&rays, [41, 31], most)[15 * 41 + 20];
    assert_eq!([1, 3, 4, 9].map(of), [3, 1, 0, 0]);
}

#[test]
fn wrong_meshes_are_refused_by_their_key() {
    let cases: [(MeshSettings, &str); 8] = [
        (MeshSettings { opacity: 1.5, ..mesh("box") }, "mesh.opacity"),
        (MeshSettings { color: [f64::NAN; 3], ..mesh("box") }, "mesh.color"),
        (MeshSettings { scale: 0.0, ..mesh("box") }, "mesh.scale"),
        (MeshSettings { fit: Some(-1.0), ..mesh("box") }, "mesh.fit"),
        (MeshSettings { translate: [f64::INFINITY; 3], ..mesh("box") }, "mesh.translate"),
        (MeshSettings { builtin: None, ..mesh("box") }, "mesh.path"),
        (MeshSettings { transform: Some(vec![[0.0; 4]; 3]), ..mesh("box") }, "determinant is 0"),
        (MeshSettings { translate: [1e9, 0.0, 0.0], ..mesh("box") }, "place it within"),
    ];
    for (mesh, says) in cases {
        let mut settings = Settings { meshes: vec![mesh], ..Settings::default() };
        settings.volume.builtin = Some("shells:8".to_owned());
        let error = read::scene(&settings).unwrap_err().to_string();
        assert!(error.contains(says), "{error}");
    }
}

#[test]
fn a_hierarchy_finds_what_a_ray_meets() {
    let boxes: Vec<Bounds> = (0..500)
        .map(|i| {
            let at = DVec3::new(f64::from(i % 10), f64::from(i / 10 % 10), f64::from(i / 100));
            Bounds { least: at, greatest: at + 0.5 }
        })
        .collect();
    let hierarchy = Hierarchy::new(&boxes);
    let found = |origin: DVec3, direction: DVec3| {
        let mut found = hierarchy.met(origin, direction, 0.0);
        found.sort_unstable();
        found
    };
    let along_x: Vec<u32> = (0..10).map(|i| 100 + 20 + i).collect();
    assert_eq!(found(DVec3::new(-1.0, 2.25, 1.25), DVec3::X), along_x);
    assert_eq!(found(DVec3::new(-1.0, 2.25, 1.25), -DVec3::X), [0u32; 0]);
    // Along a face.
    assert_eq!(found(DVec3::new(-1.0, 2.5, 1.0), DVec3::X), along_x);
    assert_eq!(Hierarchy::new(&[]).met(DVec3::ZERO, DVec3::X, 0.0), [0u32; 0]);
}
