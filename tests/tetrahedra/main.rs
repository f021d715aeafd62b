//! Meshes of tetrahedra: the way of rays through them, of which none is lost and none comes twice, and how they are put together.

mod mending;
#[path = "../random/mod.rs"]
mod random;

use std::collections::HashSet;
use std::f64::consts::PI;

use depthleap::math::ray::ViewRay;
use depthleap::scene::Tetrahedra;
use depthleap::scene::tetrahedra::cut::{Cutter, HEXAHEDRON};
use depthleap::scene::tetrahedra::seen::{Line, through};
use depthleap::scene::tetrahedra::{Grid, NOTHING, builtin};
use glam::DVec3;
use random::Random;
use rayon::prelude::*;

fn grid(name: &str) -> Grid {
    builtin::mesh(name).expect("a built-in mesh").unwrap().cleaned().unwrap()
}

fn mesh(name: &str) -> Tetrahedra {
    made(&grid(name))
}

fn made(grid: &Grid) -> Tetrahedra {
    let values: Vec<f32> = grid.values.iter().map(|value| *value as f32).collect();
    Tetrahedra::new(grid, &values).unwrap()
}

fn of(points: &[[f64; 3]], cells: &[[u32; 4]]) -> Grid {
    let values = (0..points.len()).map(|i| i as f64).collect();
    Grid { name: "test".to_owned(), points: points.to_vec(), values, cells: cells.to_vec(), notes: Vec::new() }
}

fn six_volumes(mesh: &Tetrahedra) -> impl Iterator<Item = f64> {
    mesh.cells.iter().map(|cell| {
        let [a, b, c, d] = cell.map(|corner| mesh.point(corner));
        (b - a).cross(c - a).dot(d - a)
    })
}

#[test]
fn built_in_meshes_have_the_volume_of_their_shapes() {
    let ring = PI * (0.5f64.powi(2) - 0.2f64.powi(2)) * 0.3;
    for (name, volume, within) in
        [("tets-cube:5", 1.0, 1e-6), ("tets-ball:16", PI / 6.0, 0.005), ("tets-torus:8", ring, 0.01)]
    {
        let mesh = mesh(name);
        assert!(six_volumes(&mesh).all(|volume| volume > 0.0), "{name} has flat or inverted cells");
        let found = six_volumes(&mesh).sum::<f64>() / 6.0;
        assert!((found - volume).abs() < within, "{name}: {found} where {volume} is the shape's");
        let boundary = mesh.across.iter().flatten().filter(|across| **across == NOTHING).count();
        assert_eq!(boundary, mesh.boundary.len());
        // A closed surface: each edge has two faces, so that there are three edges for two faces.
        assert_eq!(boundary % 2, 0, "{name}");
        assert!(mesh.beside.iter().flatten().all(|face| *face != NOTHING), "{name}");
    }
    assert_eq!(mesh("tets-cube:16").cells.len(), 24_576);
    assert!((mesh("tets-cube:16").unit - 1.0 / 16.0).abs() < 1e-7);
}

#[test]
fn neighbours_know_each_other() {
    for name in ["tets-cube:3", "tets-ball:3", "tets-torus:2"] {
        let mesh = mesh(name);
        for (cell, across) in (0u32..).zip(&mesh.across) {
            for (side, other) in (0u32..).zip(across).filter(|(_, other)| **other != NOTHING) {
                assert_eq!(mesh.across[*other as usize / 4][*other as usize % 4], 4 * cell + side);
            }
        }
    }
}

/// The cells of a line by going from each to the next, after what has to hold of the ways there.
fn walked(mesh: &Tetrahedra, origin: DVec3, direction: DVec3) -> HashSet<u32> {
    let line = Line::new(origin, direction);
    let mut cells = HashSet::new();
    for entry in mesh.entries(&line, (origin, direction)) {
        let (mut last, mut ends) = (entry.at, false);
        for way in mesh.chain(&line, entry) {
            assert!(
                cells.insert(way.cell),
                "cell {} comes twice on the line from {origin} along {direction}",
                way.cell
            );
            assert_eq!(way.from, last);
            assert!(way.to.depth >= way.from.depth - 1e-9, "goes back from {origin} along {direction}: {way:?}");
            last = way.to;
            let left = mesh.leave(&line, side_of(mesh, &line, way.cell));
            ends = left.is_some_and(|(side, _)| mesh.across[side as usize / 4][side as usize % 4] == NOTHING);
        }
        assert!(ends, "the way from {origin} along {direction} ends within the mesh");
    }
    cells
}

/// The side by which a line enters a cell of its way.
fn side_of(mesh: &Tetrahedra, line: &Line, cell: u32) -> u32 {
    let enters = |side: &u32| {
        let [a, b, c] = mesh.face(line, *side);
        through([&a, &b, &c]) == Some(false)
    };
    (4 * cell..4 * cell + 4).find(enters).expect("a face by which it enters")
}

/// The cells of a line by looking at each.
fn looked_at(mesh: &Tetrahedra, origin: DVec3, direction: DVec3) -> HashSet<u32> {
    let line = Line::new(origin, direction);
    let passes = |cell: &u32| {
        let sides = (4 * cell..4 * cell + 4).filter(|side| {
            let [a, b, c] = mesh.face(&line, *side);
            through([&a, &b, &c]).is_some()
        });
        match sides.count() {
            0 => false,
            2 => true,
            other => panic!("the line from {origin} along {direction} passes through {other} faces of the cell {cell}"),
        }
    };
    (0..mesh.cells.len() as u32).filter(passes).collect()
}

#[test]
fn a_line_through_vertices_edges_and_faces_meets_the_cells_that_a_look_at_each_finds() {
    for name in ["tets-cube:3", "tets-ball:2", "tets-torus:2"] {
        let mesh = mesh(name);
        let mut random = Random(7);
        let mut vertex = || mesh.point((random.next() * mesh.points.len() as f64) as u32);
        let mut lines: Vec<(DVec3, DVec3)> = (0..200).map(|_| (vertex(), vertex())).collect();
        // Along edges, and within faces.
        for cell in mesh.cells.iter().take(150) {
            let [a, b, c, _] = cell.map(|corner| mesh.point(corner));
            lines.extend([(a, b), (a, 0.5 * (b + c)), (0.5 * (a + b), 0.5 * (b + c))]);
        }
        for (from, to) in lines.into_iter().filter(|(from, to)| from != to) {
            for (origin, direction) in [(from, to - from), (from - 2.0 * (to - from), to - from), (to, from - to)] {
                assert_eq!(
                    walked(&mesh, origin, direction),
                    looked_at(&mesh, origin, direction),
                    "{name}: {origin} {direction}"
                );
            }
        }
    }
}

/// A line through the box around a mesh.
fn random_line(random: &mut Random) -> (DVec3, DVec3) {
    let mut place = |side: f64| DVec3::new(random.next() - 0.5, random.next() - 0.5, random.next() - 0.5) * side;
    let (through, direction) = (place(1.0), place(2.0));
    (through - 3.0 * direction.normalize(), direction.normalize())
}

/// Lines whose ways are looked at, of all meshes together.
const LINES: u64 = 1_000_000;

#[test]
fn of_a_million_lines_none_is_lost_and_none_comes_twice() {
    let meshes = [mesh("tets-cube:6"), mesh("tets-ball:5"), mesh("tets-torus:3"), made(&warped())];
    let each = LINES / meshes.len() as u64;
    for (number, mesh) in (0u64..).zip(&meshes) {
        let met: u64 = (0..each)
            .into_par_iter()
            .map(|i| {
                let (origin, direction) = random_line(&mut Random(i + number * each));
                let line = Line::new(origin, direction);
                let entries = mesh.entries(&line, (origin, direction));
                let mut before = f64::NEG_INFINITY;
                let mut seen = HashSet::new();
                for entry in &entries {
                    // In a mesh without overlap a line leaves before it enters again.
                    assert!(entry.at.depth >= before - 1e-9, "{origin} {direction}");
                    let mut side = entry.side;
                    let mut last = entry.at.depth;
                    loop {
                        assert!(seen.insert(side / 4), "cell {} comes twice: {origin} {direction}", side / 4);
                        let (leaves, to) =
                            mesh.leave(&line, side).unwrap_or_else(|| panic!("lost: {origin} {direction}"));
                        assert!(to.depth >= last - 1e-9, "goes back: {origin} {direction}");
                        last = to.depth;
                        side = mesh.across[leaves as usize / 4][leaves as usize % 4];
                        if side == NOTHING {
                            break;
                        }
                    }
                    before = last;
                }
                u64::from(!entries.is_empty())
            })
            .sum();
        assert!(met > each / 10, "{met} of {each} lines meet the mesh");
    }
}

/// A lattice of bent hexahedra, cut.
fn warped() -> Grid {
    let side = 6;
    let places: Vec<[usize; 3]> =
        (0..side * side * side).map(|i| [i % side, i / side % side, i / (side * side)]).collect();
    let mut random = Random(3);
    let points: Vec<[f64; 3]> =
        places.iter().map(|place| place.map(|i| i as f64 + 0.25 * (random.next() - 0.5))).collect();
    let number = |[x, y, z]: [usize; 3]| ((z * side + y) * side + x) as u32;
    let mut cutter = Cutter::new("test");
    for [x, y, z] in places.into_iter().filter(|place| place.iter().all(|i| i + 1 < side)) {
        let ring = [[0, 0], [1, 0], [1, 1], [0, 1]];
        let corners: Vec<u32> = (0..8).map(|i| number([x + ring[i % 4][0], y + ring[i % 4][1], z + i / 4])).collect();
        cutter.add(&HEXAHEDRON, &corners).unwrap();
    }
    of(&points, &cutter.cells)
}

#[test]
fn lengths_within_a_cube_are_those_of_its_box() {
    let mesh = mesh("tets-cube:7");
    for i in 0..20_000 {
        let (origin, direction) = random_line(&mut Random(i));
        let ray = ViewRay { origin, direction };
        let found: f64 = mesh.ways(&ray, 0.0).iter().map(|way| way.to.depth - way.from.depth).sum();
        let rule = depthleap::math::ray::box_interval(&ray, DVec3::splat(0.5), 0.0)
            .map_or(0.0, |(enter, leave)| leave - enter);
        assert!((found - rule).abs() < 1e-9, "{origin} {direction}: {found} where {rule} is the box's");
    }
}

#[test]
fn values_along_a_ray_are_those_of_a_linear_field() {
    let mesh = mesh("tets-cube:4");
    for i in 0..2000 {
        let (origin, direction) = random_line(&mut Random(i));
        for way in mesh.ways(&ViewRay { origin, direction }, 2.7) {
            assert!(way.from.depth >= 2.7);
            for at in [way.from, way.to] {
                let place = origin + at.depth * direction;
                let value = place.element_sum() / 3.0 + 0.5;
                assert!((at.value - value).abs() < 1e-6, "{} where {value} is the field's", at.value);
            }
        }
    }
}

#[test]
fn no_ray_goes_through_more_cells_than_the_bound_of_its_view() {
    use depthleap::math::ray::{Lens, ViewRays};
    for name in ["tets-cube:5", "tets-ball:4", "tets-torus:3"] {
        let mesh = mesh(name);
        for lens in [Lens::Perspective, Lens::Orthographic] {
            let (base, right, down) =
                (DVec3::new(-0.5, 0.25, -1.0), DVec3::new(0.02, 0.0, -0.01), DVec3::new(0.002, -0.02, -0.006));
            let origin = if lens == Lens::Perspective { DVec3::new(0.3, -0.1, 2.0) } else { DVec3::new(0.1, 0.6, 1.5) };
            let rays = ViewRays {
                lens,
                origin,
                base: base - 20.0 * (right + down) * f64::from(u8::from(lens == Lens::Perspective)),
                right,
                down,
                near: 0.01,
            };
            let most = (0..1600u32).map(|i| mesh.ways(&rays.of(i % 40, i / 40), rays.near).len() as u32).max().unwrap();
            let bound = mesh.most_cells(&rays);
            assert!(most > 5 && most <= bound, "{name}: {most} cells, and the bound is {bound}");
            assert!(bound < 8 * most + 8, "{name}: {most} cells, and the bound is {bound}");
        }
    }
}
