//! Which voxels lie inside: closed, open, crossing, doubled and turned meshes.

use depthleap::scene::mesh::{Mesh, shape};
use glam::DVec3;

use super::random::Random;
use super::{BAND, field, moved, random_soup, soup, together, triangles, turned_over, winding_of_all};

/// The voxels' values alone.
fn values(mesh: &Mesh, dims: [usize; 3]) -> Vec<f64> {
    field(mesh, dims).1.into_iter().map(|(_, value)| value).collect()
}

fn same(a: &Mesh, b: &Mesh, dims: [usize; 3]) {
    for (a, b) in values(a, dims).into_iter().zip(values(b, dims)) {
        assert!((a - b).abs() < 1e-5, "{a} and {b}");
    }
}

#[test]
fn faces_may_all_be_turned_and_doubled() {
    let torus = shape("torus:24").unwrap();
    let dims = [40, 22, 40];
    same(&torus, &turned_over(&torus), dims);
    same(&torus, &together(&torus, &torus), dims);
    let thrice = together(&torus, &together(&torus, &torus));
    same(&torus, &thrice, dims);
    assert_eq!(field(&thrice, dims).0.warnings, [""; 0]);
}

#[test]
fn every_corner_may_be_told_apart() {
    let torus = shape("torus:24").unwrap();
    let corners = |triangle: &[u32; 3]| triangle.map(|corner| torus.corners[corner as usize]);
    let apart = soup(&torus.triangles.iter().map(corners).collect::<Vec<_>>());
    same(&torus, &apart, [40, 22, 40]);
    assert_eq!(field(&apart, [40, 22, 40]).0.warnings, [""; 0]);
}

#[test]
fn what_is_in_any_of_two_crossing_boxes_is_inside() {
    let cube = shape("box").unwrap();
    let crossing = together(&cube, &moved(&cube, [0.5, 0.25, 0.3]));
    let (volume, voxels) = field(&crossing, [48, 40, 40]);
    let in_box = |p: DVec3| p.abs().max_element() < 0.5;
    let mut in_both = 0;
    for (point, value) in voxels {
        let [one, other] = [in_box(point), in_box(point - DVec3::new(0.5, 0.25, 0.3))];
        if value.abs() > 1e-4 {
            assert_eq!(value > 0.0, one || other, "{value} at {point}");
        }
        in_both += usize::from(one && other);
    }
    assert!(in_both > 1000);
    assert_eq!(volume.warnings, [""; 0], "boxes that cross are closed");
}

#[test]
fn a_box_in_a_box_that_is_turned_inwards_is_a_hole() {
    let cube = shape("box").unwrap();
    let small = Mesh { corners: cube.corners.iter().map(|c| c.map(|x| 0.5 * x)).collect(), ..cube.clone() };
    let hollow = together(&cube, &turned_over(&small));
    let solid = together(&cube, &small);
    for (mesh, is_hollow) in [(&hollow, true), (&turned_over(&hollow), true), (&solid, false)] {
        let (_, voxels) = field(mesh, [40; 3]);
        for (point, value) in voxels.into_iter().filter(|(_, value)| value.abs() > 1e-4) {
            let far = point.abs().max_element();
            assert_eq!(value > 0.0, far < 0.5 && (far > 0.25 || !is_hollow), "{value} at {point}");
        }
    }
}

#[test]
fn a_box_without_a_lid_is_closed_where_it_covers_half_of_all_directions() {
    let cube = shape("box").unwrap();
    let all = triangles(&cube);
    let is_lid = |i: &usize| all[*i].corners.iter().all(|corner| corner.y > 0.49);
    let kept = |i: usize| cube.triangles[i];
    let open = Mesh { triangles: (0..all.len()).filter(|i| !is_lid(i)).map(kept).collect(), ..cube.clone() };
    assert!(open.triangles.len() < all.len());
    let (volume, voxels) = field(&open, [40; 3]);
    let open_triangles = triangles(&open);
    let mut jumps = 0;
    for (point, value) in voxels {
        let winding = winding_of_all(&open_triangles, point);
        // In the plane of a face, and along an edge of it, angles are not defined.
        let is_beside = (point.abs() - 0.5).abs().min_element() < 1e-9;
        if !is_beside && (winding.abs() - 0.5).abs() > 0.01 && value.abs() > 1e-4 {
            assert_eq!(value > 0.0, winding.abs() >= 0.5, "{value} at {point}, where {winding}");
        }
        jumps += usize::from(point.y.abs() < 0.4 && point.abs().max_element() < 0.3 && value == BAND);
    }
    assert!(jumps > 100, "the box is full far from its sides");
    let [warning] = &volume.warnings[..] else { panic!("{:?}", volume.warnings) };
    for part in ["box", "is open at 4 edges", "1/2", "without being 0", "close it"] {
        assert!(warning.contains(part), "no `{part}` in {warning}");
    }
}

#[test]
fn a_random_mesh_has_the_sides_of_its_winding_number() {
    let mut random = Random(5);
    let (mut inside, mut unsure) = (0, 0);
    for count in [3, 30, 300] {
        let mesh = random_soup(&mut random, count);
        // Pieces of closed surfaces, so that there is an inside.
        let mesh = together(&mesh, &moved(&shape("sphere:12").unwrap(), [0.5; 3]));
        let all = triangles(&mesh);
        for (point, value) in field(&mesh, [26, 24, 25]).1 {
            let winding = winding_of_all(&all, point).abs();
            if (winding - 0.5).abs() < 0.02 || value.abs() < 1e-4 {
                unsure += 1;
                continue;
            }
            assert_eq!(value > 0.0, winding > 0.5, "{count}: {value} at {point}, where {winding}");
            inside += usize::from(value > 0.0);
        }
    }
    assert!(inside > 1000 && unsure < inside, "{inside} inside, {unsure} unsure");
}

#[test]
fn a_sheet_has_no_inside() {
    let sheet = soup(&[[[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]], [[0.0; 3], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]]);
    let (volume, voxels) = field(&sheet, [32, 32, 12]);
    let spacing = volume.spacing[0];
    for (point, value) in voxels {
        let from_middle = point - DVec3::new(0.5, 0.5, 0.0);
        let beyond = (from_middle.abs() - DVec3::new(0.5, 0.5, 0.0)).max(DVec3::ZERO).length() / spacing;
        assert!((value + beyond.min(BAND)).abs() < 1e-6, "{value} for {beyond}");
    }
    let [warning] = &volume.warnings[..] else { panic!("{:?}", volume.warnings) };
    for part in ["soup.ply", "is open at 4 edges", "has no inside", "below 0 only", "iso such as -1"] {
        assert!(warning.contains(part), "no `{part}` in {warning}");
    }
}

#[test]
fn a_mesh_between_voxel_centres_is_said_to_have_no_inside() {
    let cube = shape("box").unwrap();
    let plate = Mesh { corners: cube.corners.iter().map(|c| [c[0], 1e-3 * c[1], c[2]]).collect(), ..cube };
    let (volume, voxels) = field(&plate, [30, 10, 30]);
    assert!(voxels.iter().all(|(_, value)| *value <= 0.0));
    let [warning] = &volume.warnings[..] else { panic!("{:?}", volume.warnings) };
    assert!(warning.contains("holds a voxel's centre") && warning.contains("larger volume.dims"), "{warning}");
}
