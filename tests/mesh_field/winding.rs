//! Winding numbers seen from far away against those of all triangles, and the bound of their change.

use depthleap::math::triangle::Triangle;
use depthleap::scene::mesh::{Mesh, open_edges, shape};
use depthleap::scene::mesh_field::{Skin, Winding};

use super::random::Random;
use super::{random_point, random_soup, triangles, winding_of_all};

/// What a number may be off by that sees many triangles as one.
const FROM_FAR: f64 = 0.01;

fn skin(mesh: &Mesh) -> (Skin, Vec<Triangle>) {
    let all = triangles(mesh);
    (Skin::new(all.clone(), &open_edges(&mesh.triangles, &mesh.corners)), all)
}

#[test]
fn a_triangle_knows_how_much_it_covers() {
    let mut random = Random(8);
    for triangle in triangles(&random_soup(&mut random, 500)) {
        let point = random_point(&mut random);
        let (found, truth) = (triangle.cover(point), winding_of_all(&[triangle], point));
        assert!((found - truth).abs() < 1e-7, "{triangle:?}: {found} for {truth} at {point}");
        assert_eq!(triangle.cover(triangle.corners[1]), 0.0);
    }
}

#[test]
fn numbers_seen_from_far_are_near_those_of_all_triangles() {
    let mut random = Random(21);
    for mesh in [shape("torus:90").unwrap(), shape("teapot").unwrap(), random_soup(&mut random, 2000)] {
        let (skin, all) = skin(&mesh);
        let [least, greatest] = mesh.bounds();
        for _ in 0..300 {
            let point = least + (1.4 * random_point(&mut random) - 0.2) * (greatest - least);
            let (found, truth) = (skin.winding(point, 0.0, 0.0), winding_of_all(&all, point));
            assert!((found.number - truth).abs() < FROM_FAR, "{}: {found:?} for {truth}", mesh.name);
            assert_eq!(found.change, 0.0);
        }
    }
}

#[test]
fn a_number_changes_within_a_ball_by_no_more_than_its_bound() {
    let mut random = Random(77);
    let (mut balls, mut tight) = (0, 0);
    for count in [1, 10, 100] {
        let mesh = random_soup(&mut random, count);
        let (skin, all) = skin(&mesh);
        for _ in 0..2000 {
            let middle = 3.0 * random_point(&mut random) - 1.0;
            let Some((_, distance)) = skin.nearest(middle, 10.0, None) else { panic!("{middle} is far from all") };
            let radius = 0.8 * random.next() * distance;
            let Winding { number, change } = skin.winding(middle, radius, distance);
            let direction = (random_point(&mut random) - 0.5).normalize();
            let other = winding_of_all(&all, middle + radius * direction);
            assert!((other - number).abs() <= change + FROM_FAR, "{other} and {number}, not {change} apart");
            balls += 1;
            tight += usize::from(change < 0.4);
        }
    }
    assert!(tight > balls / 10, "a bound that says nothing would always hold: {tight} of {balls}");
    let (skin, _) = skin(&shape("sphere").unwrap());
    let Winding { number, change } = skin.winding(glam::DVec3::ZERO, 0.4, 0.49);
    assert!(change == 0.0 && (number - 1.0).abs() < FROM_FAR, "a closed mesh has one number: {number}, {change}");
}

#[test]
fn the_nearest_triangle_is_found_with_and_without_a_hint() {
    let mut random = Random(4);
    let mesh = random_soup(&mut random, 500);
    let (skin, all) = skin(&mesh);
    for _ in 0..500 {
        let point = 2.0 * random_point(&mut random) - 0.5;
        let truth = all.iter().map(|t| t.squared_distance(point, f64::INFINITY)).fold(f64::INFINITY, f64::min).sqrt();
        let (place, distance) = skin.nearest(point, 10.0, None).unwrap();
        assert_eq!(distance, truth);
        let hint = (random.next() * 500.0) as usize;
        for near in [place, hint] {
            assert_eq!(skin.nearest(point, 10.0, Some(near)).unwrap().1, truth);
        }
        assert_eq!(skin.nearest(point, truth * (1.0 - 1e-12), Some(hint)), None, "none is nearer than the limit");
    }
    let (none, _) = self::skin(&Mesh::default());
    assert_eq!(
        (none.nearest(glam::DVec3::ZERO, 1.0, None), none.winding(glam::DVec3::ZERO, 1.0, 2.0).number),
        (None, 0.0)
    );
}
