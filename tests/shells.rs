//! Shells: iso-surfaces as polygons, closed and on their levels whatever the voxels are; needs no device.

mod random;

use std::collections::{BTreeSet, HashMap};

use depthleap::math::interpolate::trilinear;
use depthleap::scene::field::NanPolicy;
use depthleap::scene::mesh::Mesh;
use depthleap::scene::shells::{CASES, EDGES, Faces, Lattice, MOST_TRIANGLES, edge, polygons};
use depthleap::scene::volume::Voxels;
use depthleap::scene::{Field, Volume};
use glam::DVec3;
use random::Random;

fn field_of(dims: [usize; 3], spacing: [f64; 3], values: Vec<f32>) -> Field {
    let volume = Volume::new("test", dims, spacing, Voxels::F32(values)).unwrap();
    Field::new(volume, Some([0.0, 1.0]), NanPolicy::Hole).unwrap()
}

/// How often each directed edge is one of a triangle.
fn directed_edges(shell: &Mesh) -> HashMap<[u32; 2], u32> {
    let mut edges = HashMap::new();
    for [a, b, c] in &shell.triangles {
        for edge in [[*a, *b], [*b, *c], [*c, *a]] {
            *edges.entry(edge).or_default() += 1;
        }
    }
    edges
}

/// Edges that are not those of two triangles, one in each direction.
fn open_edges(shell: &Mesh) -> Vec<[u32; 2]> {
    let edges = directed_edges(shell);
    let closed = |[from, to]: [u32; 2]| edges[&[from, to]] == 1 && edges.get(&[to, from]) == Some(&1);
    edges.keys().copied().filter(|edge| !closed(*edge)).collect()
}

/// In voxels from the volume's face on.
fn in_voxels(field: &Field, vertex: [f32; 3]) -> DVec3 {
    let place = DVec3::from_array(vertex.map(f64::from)) / field.voxel();
    place + 0.5 * DVec3::from_array(field.dims().map(|n| n as f64))
}

/// Both ends lie in one face of the volume's box.
fn on_the_box(field: &Field, ends: [[f32; 3]; 2]) -> bool {
    let [a, b] = ends.map(|vertex| in_voxels(field, vertex));
    let sides = DVec3::from_array(field.dims().map(|n| n as f64));
    (0..3).any(|axis| [0.0, sides[axis]].iter().any(|face| [a, b].iter().all(|p| (p[axis] - face).abs() < 1e-4)))
}

/// Both ends lie in a cell that is a hole.
fn at_a_hole(field: &Field, ends: [[f32; 3]; 2]) -> bool {
    let Some(holes) = &field.holes else { return false };
    let [nx, ny, nz] = field.cells();
    let inside = |place: DVec3, at: [usize; 3]| {
        (0..3).all(|axis| {
            // Cells at a face reach out to it.
            let last = field.cells()[axis] - 1;
            let low = if at[axis] == 0 { 0.0 } else { at[axis] as f64 + 0.5 };
            let high = if at[axis] == last { field.dims()[axis] as f64 } else { at[axis] as f64 + 1.5 };
            (low - 1e-4..=high + 1e-4).contains(&place[axis])
        })
    };
    let ends = ends.map(|vertex| in_voxels(field, vertex));
    (0..nx * ny * nz)
        .filter(|i| holes[*i])
        .any(|i| ends.iter().all(|end| inside(*end, [i % nx, i / nx % ny, i / (nx * ny)])))
}

/// Whether a place lies in a cell that is a hole, and not on its faces.
fn is_inside_a_hole(field: &Field, place: DVec3) -> bool {
    let (cell, [nx, ny, _]) = (field.cell_at(place), field.cells());
    let from_face = (0..3).map(|axis| (place[axis] - 0.5 - (place[axis] - 0.5).round()).abs()).fold(1.0, f64::min);
    let holes = field.holes.as_ref();
    from_face > 1e-4 && holes.is_some_and(|holes| holes[(cell[2] * ny + cell[1]) * nx + cell[0]])
}

/// Closed but on the box and at holes, no vertex off the level, and each number of a vertex one that there is.
fn check(field: &Field, level: f32, what: &str) -> Mesh {
    let shell = polygons(field, level, Faces::Open).unwrap();
    let used: BTreeSet<u32> = shell.triangles.iter().flatten().copied().collect();
    assert!(used.into_iter().eq(0..shell.corners.len() as u32), "{what}: each vertex is one of a triangle");
    for triangle in &shell.triangles {
        let middle = triangle.map(|i| in_voxels(field, shell.corners[i as usize])).iter().sum::<DVec3>() / 3.0;
        // Where a triangle has no area, the middle may lie on the hole.
        assert!(!is_inside_a_hole(field, middle), "{what}: {triangle:?} lies in a hole");
    }
    for ends in open_edges(&shell) {
        let places = ends.map(|i| shell.corners[i as usize]);
        assert!(on_the_box(field, places) || at_a_hole(field, places), "{what}: the edge {places:?} is open");
    }
    let closed = polygons(field, level, Faces::Closed).unwrap();
    for ends in open_edges(&closed) {
        let places = ends.map(|i| closed.corners[i as usize]);
        assert!(at_a_hole(field, places), "{what}: the edge {places:?} is open where shells are closed");
    }
    let span = field.values.iter().fold(0.0f32, |most, value| most.max(value.abs()));
    for vertex in &shell.corners {
        let value = trilinear(&field.values, field.dims(), in_voxels(field, *vertex));
        let off = (value - f64::from(level)).abs();
        // A place in f32 is off by some units in its last place, of voxels too.
        assert!(off <= 2e-5 * f64::from(span), "{what}: {vertex:?} is {off:e} off the level");
    }
    shell
}

#[test]
fn every_case_has_a_triangle_for_each_crossed_edge() {
    for (case, triangles) in CASES.iter().enumerate() {
        let above = |corner: usize| case >> corner & 1;
        let crossed = |number: &usize| {
            let (axis, corner) = edge(*number);
            above(corner) != above(corner | 1 << axis)
        };
        let used = |number: &usize| triangles.iter().flatten().any(|edge| usize::from(*edge) == *number);
        assert!((0..EDGES).all(|number| crossed(&number) == used(&number)), "case {case}: {triangles:?}");
        assert!(triangles.len() <= MOST_TRIANGLES, "case {case}: {triangles:?}");
    }
    assert_eq!(CASES.iter().map(Vec::len).max(), Some(MOST_TRIANGLES));
}

#[test]
fn all_cases_are_closed_beside_all_others() {
    for case in 0..256usize {
        let corner = |i: usize| (case >> i & 1) as f32;
        check(&field_of([2; 3], [1.0; 3], (0..8).map(corner).collect()), 0.5, &format!("case {case}"));
    }
    let mut random = Random(5);
    for i in 0..200 {
        let values = (0..27).map(|_| (random.next() < 0.5) as u8 as f32).collect();
        check(&field_of([3; 3], [1.0; 3], values), 0.3, &format!("signs {i}"));
    }
}

#[test]
fn shells_of_random_volumes_are_closed_and_on_the_level() {
    let mut random = Random(17);
    let mut triangles = 0;
    for i in 0..200 {
        let dims = [0; 3].map(|_| 1 + (random.next() * 9.0) as usize);
        let spacing = [0; 3].map(|_| 0.3 + random.next());
        let values = (0..dims.iter().product()).map(|_| random.next() as f32).collect();
        triangles +=
            check(&field_of(dims, spacing, values), 0.2 + 0.6 * random.next() as f32, &format!("{i}: {dims:?}"))
                .triangles
                .len();
    }
    assert!(triangles > 10_000, "{triangles}");
}

#[test]
fn plateaus_at_the_level_and_holes_leave_no_gap() {
    let mut random = Random(23);
    let (mut holes, mut triangles) = (0, 0);
    for i in 0..200 {
        let dims = [0; 3].map(|_| 2 + (random.next() * 6.0) as usize);
        let hole = i % 2 == 1;
        let mut value = || match (random.next() * 4.0) as u32 {
            0 if hole && random.next() < 0.2 => f32::NAN,
            level => level as f32 / 4.0,
        };
        let values = (0..dims.iter().product()).map(|_| value()).collect();
        // Many voxels have this very value.
        let field = field_of(dims, [1.0; 3], values);
        holes += field.holes.iter().flatten().filter(|hole| **hole).count();
        triangles += check(&field, 0.5, &format!("{i}: {dims:?}")).triangles.len();
    }
    assert!(holes > 500 && triangles > 10_000, "{holes} holes, {triangles} triangles");
}

#[test]
fn what_stands_for_a_hole_makes_no_surface() {
    // All voxels but one are 0.9, and that one is filled with 0.
    let mut values = vec![0.9; 125];
    values[62] = f32::NAN;
    let shell = polygons(&field_of([5; 3], [1.0; 3], values), 0.5, Faces::Open).unwrap();
    assert!(shell.corners.is_empty() && shell.triangles.is_empty(), "{} vertices", shell.corners.len());
}

#[test]
fn rows_longer_than_a_word_are_closed() {
    let mut random = Random(29);
    for nx in [61, 62, 63, 64, 65, 126, 127, 128, 200] {
        let dims = [nx, 3, 4];
        let values = (0..dims.iter().product()).map(|_| random.next() as f32).collect();
        let shell = check(&field_of(dims, [1.0; 3], values), 0.5, &format!("{nx}"));
        assert!(shell.triangles.len() > nx, "{nx}");
    }
}

/// A sphere's value: 0.5 on it, falling outwards.
fn ball(side: usize, radius: f64) -> Field {
    let middle = side as f64 / 2.0;
    let value = |i: usize| {
        let voxel = DVec3::new((i % side) as f64, (i / side % side) as f64, (i / (side * side)) as f64) + 0.5;
        (0.5 + (radius - (voxel - middle).length() / side as f64)) as f32
    };
    field_of([side; 3], [1.0; 3], (0..side.pow(3)).map(value).collect())
}

/// The volume that a closed shell encloses.
fn enclosed(shell: &Mesh) -> f64 {
    let corner = |i: u32| DVec3::from_array(shell.corners[i as usize].map(f64::from));
    let six = |[a, b, c]: &[u32; 3]| corner(*a).dot(corner(*b).cross(corner(*c)));
    shell.triangles.iter().map(six).sum::<f64>() / 6.0
}

#[test]
fn a_sphere_is_one_surface_that_converges_by_order_two() {
    let radius = 0.31;
    let rule = 4.0 / 3.0 * std::f64::consts::PI * radius * radius * radius;
    let off = [16, 32, 64].map(|side| {
        let shell = polygons(&ball(side, radius), 0.5, Faces::Open).unwrap();
        assert_eq!(open_edges(&shell), Vec::<[u32; 2]>::new());
        let edges = directed_edges(&shell).len() / 2;
        // Euler's number of a sphere.
        assert_eq!(shell.corners.len() + shell.triangles.len() - edges, 2, "side {side}");
        // Positive where triangles go round against the clock as seen from outside.
        (rule - enclosed(&shell)) / rule
    });
    assert!(off[2] > 0.0 && off[2] < 1e-2, "{off:?}");
    let orders = [0, 1].map(|i| (off[i] / off[i + 1]).log2());
    assert!(orders.iter().all(|order| (1.8..2.2).contains(order)), "{orders:?} of {off:?}");
}

#[test]
fn a_level_that_no_value_crosses_has_no_polygons() {
    let field = ball(8, 0.3);
    let [low, high] = field.extremes();
    for level in [low, low - 1.0, high + 1.0, high.next_up(), f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        assert_eq!(polygons(&field, level, Faces::Open).unwrap().triangles, Vec::<[u32; 3]>::new(), "{level}");
    }
    assert!(
        !polygons(&field, high, Faces::Open).unwrap().triangles.is_empty(),
        "the greatest value is not below the level"
    );
    assert!(!polygons(&field, low.next_up(), Faces::Open).unwrap().triangles.is_empty());
}

/// A shell of all voxels is the box, and what all faces cut off is closed.
#[test]
fn closed_shells_enclose_what_is_not_below_the_level() {
    let field = ball(8, 0.3);
    let [low, high] = field.extremes();
    let of = |level: f32| enclosed(&polygons(&field, level, Faces::Closed).unwrap());
    let box_of_all = field.extent().element_product();
    for level in [low, low - 1.0, f32::NEG_INFINITY] {
        assert!((of(level) - box_of_all).abs() < 1e-6 * box_of_all, "{level}: {}", of(level));
    }
    let most = low + 0.1 * (high - low);
    assert!(of(most) < box_of_all && of(most) > 0.5 * box_of_all, "{} of {box_of_all}", of(most));
    for level in [high.next_up(), f32::NAN, f32::INFINITY] {
        assert_eq!(polygons(&field, level, Faces::Closed).unwrap().triangles, Vec::<[u32; 3]>::new(), "{level}");
    }
}

#[test]
fn nodes_lie_at_voxels_and_on_the_faces() {
    let field = field_of([3, 1, 2], [1.0, 2.0, 0.5], (0..6).map(|i| i as f32).collect());
    let lattice = Lattice::new(&field, Faces::Open);
    assert_eq!(lattice.nodes(), [5, 3, 4]);
    let half = 0.5 * field.extent();
    for (node, place) in [([0; 3], -half), ([4, 2, 3], half), ([1; 3], -half + 0.5 * field.voxel())] {
        assert!((lattice.position(&field, node) - place).length() < 1e-15, "{node:?}");
    }
    assert_eq!([lattice.value(&field, [0, 0, 0]), lattice.value(&field, [3, 1, 3])], [0.0, 5.0]);
}
