//! Distances against closed forms, and against every triangle.

use std::f64::consts::PI;

use depthleap::math::triangle::Triangle;
use depthleap::scene::mesh::{Mesh, shape};
use depthleap::scene::mesh_field;
use glam::{DVec2, DVec3};

use super::random::Random;
use super::{BAND, field, random_point, random_soup, soup, triangles};

/// What f32 rounds a distance of up to 4 voxels by, and f64 the places of voxels.
const ROUNDING: f64 = 1e-6;

/// Holds a field against signed distances in the mesh's unit, above 0 inside, that are right within `tolerance`.
fn holds(mesh: &Mesh, dims: [usize; 3], tolerance: f64, truth: impl Fn(DVec3) -> f64) {
    let (volume, voxels) = field(mesh, dims);
    let spacing = volume.spacing[0];
    let (mut in_band, mut inside) = (0, 0);
    for (point, value) in voxels {
        let expected = (truth(point) / spacing).clamp(-BAND, BAND);
        assert!(
            (value - expected).abs() <= tolerance / spacing + ROUNDING,
            "{}: {value} for {expected} at {point}",
            mesh.name
        );
        in_band += usize::from(value.abs() < BAND);
        inside += usize::from(value > 0.0);
    }
    assert!(in_band > 1000 && inside > 100, "{}: {in_band} voxels in the band, {inside} inside", mesh.name);
    assert_eq!(volume.warnings, [""; 0]);
}

#[test]
fn a_sphere_has_its_distances_within_what_its_facets_are_off_by() {
    let segments = 150;
    let sphere = shape(&format!("sphere:{segments}")).unwrap();
    // The sagitta of an arc of one segment, in both directions.
    let sagitta = 2.0 * 0.5 * (1.0 - (PI / f64::from(segments)).cos());
    holds(&sphere, [40, 40, 40], sagitta, |p| 0.5 - p.length());
    // More than enough voxels along two axes.
    holds(&sphere, [33, 50, 41], sagitta, |p| 0.5 - p.length());
}

/// Of a box with these half sides about the origin.
fn to_box(point: DVec3, half: DVec3) -> f64 {
    let beyond = point.abs() - half;
    -(beyond.max(DVec3::ZERO).length() + beyond.max_element().min(0.0))
}

#[test]
fn a_box_is_exact_at_faces_edges_and_corners() {
    let cube = shape("box").unwrap();
    holds(&cube, [37, 37, 37], 0.0, |p| to_box(p, DVec3::splat(0.5)));
    let stretched: Vec<[f32; 3]> = cube.corners.iter().map(|c| [2.0 * c[0], 0.5 * c[1], c[2]]).collect();
    let long = Mesh { corners: stretched, ..cube };
    holds(&long, [60, 24, 40], 0.0, |p| to_box(p, DVec3::new(1.0, 0.25, 0.5)));
}

#[test]
fn a_torus_has_its_distances_within_what_its_facets_are_off_by() {
    let segments = 200;
    let torus = shape(&format!("torus:{segments}")).unwrap();
    let [least, greatest] = torus.bounds();
    let thickness = 0.5 * (greatest.y - least.y);
    let ring = 0.5 - thickness;
    // Around the tube there may be fewer segments than around the ring.
    let sagitta = 0.5 * (1.0 - (PI / f64::from(segments)).cos()) + thickness * (1.0 - (PI / 50.0).cos());
    let truth = |p: DVec3| thickness - DVec2::new(DVec2::new(p.x, p.z).length() - ring, p.y).length();
    holds(&torus, [64, 24, 64], sagitta, truth);
}

/// The nearest point of a triangle by its Voronoi regions [Ericson, *Real-Time Collision Detection*, 5.1.5].
fn nearest(triangle: &Triangle, p: DVec3) -> DVec3 {
    let [a, b, c] = triangle.corners;
    let (ab, ac, ap, bp, cp) = (b - a, c - a, p - a, p - b, p - c);
    let (d1, d2, d3, d4, d5, d6) = (ab.dot(ap), ac.dot(ap), ab.dot(bp), ac.dot(bp), ab.dot(cp), ac.dot(cp));
    let (va, vb, vc) = (d3 * d6 - d5 * d4, d5 * d2 - d1 * d6, d1 * d4 - d3 * d2);
    if d1 <= 0.0 && d2 <= 0.0 {
        a
    } else if d3 >= 0.0 && d4 <= d3 {
        b
    } else if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        a + d1 / (d1 - d3) * ab
    } else if d6 >= 0.0 && d5 <= d6 {
        c
    } else if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        a + d2 / (d2 - d6) * ac
    } else if va <= 0.0 && d4 >= d3 && d5 >= d6 {
        b + (d4 - d3) / (d4 - d3 + d5 - d6) * (c - b)
    } else {
        a + (vb * ab + vc * ac) / (va + vb + vc)
    }
}

#[test]
fn a_triangle_knows_how_far_it_is() {
    let mut random = Random(3);
    for triangle in triangles(&random_soup(&mut random, 300)) {
        for _ in 0..20 {
            let point = 2.0 * random_point(&mut random) - 0.5;
            let (found, truth) = (triangle.squared_distance(point, f64::INFINITY).sqrt(), nearest(&triangle, point));
            assert!((found - truth.distance(point)).abs() < 1e-12, "{triangle:?}: {found} at {point}");
            // A limit only ends the search.
            let limit = random.next();
            let limited = triangle.squared_distance(point, limit);
            assert!(limited == triangle.squared_distance(point, f64::INFINITY) || limited >= limit);
        }
    }
}

#[test]
fn thin_triangles_are_their_edges() {
    let needle = Triangle::new([DVec3::ZERO, DVec3::X, DVec3::new(0.5, 1e-13, 0.0)]);
    let point = DVec3::new(0.25, 0.3, -0.4);
    assert!((needle.squared_distance(point, f64::INFINITY) - 0.25).abs() < 1e-9);
    for corners in [[DVec3::ONE; 3], [DVec3::ZERO, DVec3::X, 2.0 * DVec3::X]] {
        let triangle = Triangle::new(corners);
        assert!(!triangle.has_area());
        assert!(triangle.squared_distance(point, f64::INFINITY).is_finite());
        assert!(triangle.cover(point).abs() < 1e-15);
    }
}

#[test]
fn a_random_mesh_has_the_distance_of_its_nearest_triangle() {
    let mut random = Random(11);
    for count in [1, 5, 40, 400] {
        let mesh = random_soup(&mut random, count);
        let all = triangles(&mesh);
        let (volume, voxels) = field(&mesh, [20, 27, 22]);
        for (point, value) in voxels {
            let truth = all.iter().map(|t| nearest(t, point).distance(point)).fold(f64::INFINITY, f64::min);
            let expected = (truth / volume.spacing[0]).min(BAND);
            assert!((value.abs() - expected).abs() < ROUNDING, "{count}: {value} for {expected} at {point}");
        }
    }
}

#[test]
fn triangles_without_an_area_change_nothing() {
    let cube = shape("box:3").unwrap();
    let mut with = cube.clone();
    let first = with.corners.len() as u32;
    with.corners.extend([[0.1, 0.2, 0.3], [0.2, 0.4, 0.6], [0.3, 0.6, 0.9], [9.0, 9.0, 9.0]]);
    with.triangles.extend([[first; 3], [first, first, first + 1], [0, 1, 1], [first + 3; 3]]);
    let [a, b] = [&cube, &with].map(|mesh| mesh_field::volume(mesh, Some([24; 3]), BAND).unwrap());
    assert_eq!(a.voxels, b.voxels);
    assert!(b.notes[0].contains("without 4 that have no area"), "{:?}", b.notes);
    // A sliver that joins a long side to two short ones closes them.
    let split =
        soup(&[[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.5, 0.0, 0.0]], [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]]);
    let volume = mesh_field::volume(&split, Some([20; 3]), BAND).unwrap();
    assert!((0..volume.voxels.len()).all(|i| volume.voxels.get(i).is_finite()));
}

#[test]
fn size_and_place_of_a_mesh_make_no_difference() {
    let torus = shape("torus:30").unwrap();
    let scaled = |factor: f32, by: f32| {
        let corners = torus.corners.iter().map(|c| c.map(|x| factor * x + by)).collect();
        mesh_field::volume(&Mesh { corners, ..torus.clone() }, Some([40, 20, 40]), BAND).unwrap()
    };
    let truth = scaled(1.0, 0.0);
    for (factor, by, tolerance) in [(1e17, 0.0, 1e-4), (1e-25, 0.0, 1e-4), (1e-40, 0.0, 0.01), (1.0, 1000.0, 0.02)] {
        let volume = scaled(factor, by);
        for i in 0..volume.voxels.len() {
            let (value, expected) = (volume.voxels.get(i), truth.voxels.get(i));
            assert!((value - expected).abs() < tolerance, "times {factor}: {value} for {expected}");
        }
    }
}
