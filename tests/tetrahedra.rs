//! Meshes of tetrahedra: how they are put together, and the way of rays through them, of which none is lost and none comes twice.

mod random;

use std::collections::HashSet;
use std::f64::consts::PI;

use depthleap::math::ray::ViewRay;
use depthleap::scene::Tetrahedra;
use depthleap::scene::tetrahedra::cut::{CellKind, Cutter, HEXAHEDRON, PYRAMID, TETRAHEDRON, VOXEL, WEDGE};
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

/// A kind, its corners, its volume, and how many tetrahedra it may become.
type CutKind<'a> = (&'a CellKind, &'a [[f64; 3]], f64, &'a [usize]);

#[test]
fn kinds_of_cells_are_cut_into_their_volume() {
    let square = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    let up = square.map(|[x, y, _]| [x, y, 1.0]);
    let ring: Vec<[f64; 3]> = square.into_iter().chain(up).collect();
    let along: Vec<[f64; 3]> = [0, 1, 3, 2, 4, 5, 7, 6].map(|i| ring[i]).to_vec();
    let apex: Vec<[f64; 3]> = square.into_iter().chain([[0.5, 0.5, 1.0]]).collect();
    let wedge: Vec<[f64; 3]> = [0, 1, 3, 4, 5, 7].map(|i| ring[i]).to_vec();
    let corner: Vec<[f64; 3]> = [0, 1, 3, 4].map(|i| ring[i]).to_vec();
    let kinds: [CutKind; 5] = [
        (&HEXAHEDRON, &ring, 1.0, &[6, 5]),
        (&VOXEL, &along, 1.0, &[6, 5]),
        (&PYRAMID, &apex, 1.0 / 3.0, &[2]),
        (&WEDGE, &wedge, 0.5, &[3]),
        (&TETRAHEDRON, &corner, 1.0 / 6.0, &[1]),
    ];
    for (kind, points, volume, cells) in kinds {
        // Whatever numbers the corners have.
        for turn in 0..points.len() as u32 {
            let numbers: Vec<u32> = (0..points.len() as u32).map(|i| (i * 3 + turn) % points.len() as u32).collect();
            let distinct: HashSet<u32> = numbers.iter().copied().collect();
            let numbers = if distinct.len() == points.len() { numbers } else { (0..points.len() as u32).collect() };
            let mut placed = vec![[0.0; 3]; points.len()];
            numbers.iter().zip(points).for_each(|(number, point)| placed[*number as usize] = *point);
            let mut cutter = Cutter::new("test");
            cutter.add(kind, &numbers).unwrap();
            assert!(cells.contains(&cutter.cells.len()), "{}: {} cells", kind.name, cutter.cells.len());
            let mesh = made(&of(&placed, &cutter.cells));
            let found = six_volumes(&mesh).map(f64::abs).sum::<f64>() / 6.0;
            assert!((found - volume).abs() < 1e-6, "{}: {found}", kind.name);
        }
    }
}

#[test]
fn cells_beside_each_other_are_cut_alike() {
    let mesh = made(&warped());
    // Twelve boxes and triangles two a face: nothing within is on the boundary.
    assert_eq!(mesh.boundary.len(), 6 * 25 * 2);
    assert_eq!(mesh.cells.len(), 125 * 6);
}

const CORNERS: [[f64; 3]; 6] =
    [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 1.0, 1.0], [0.2, 0.2, 0.9]];

#[test]
fn inverted_and_doubled_cells_and_points_at_one_place_are_mended() {
    let inverted = made(&of(&CORNERS[..4], &[[0, 2, 1, 3]]));
    assert!(six_volumes(&inverted).all(|volume| volume > 0.0));
    let doubled = of(&CORNERS[..4], &[[0, 1, 2, 3], [2, 1, 0, 3]]).cleaned().unwrap();
    assert_eq!(doubled.cells.len(), 1);
    assert_eq!(doubled.notes, ["1 cells that came twice were left out"]);
    let mut apart = of(
        &[CORNERS[0], CORNERS[1], CORNERS[2], CORNERS[3], CORNERS[1], CORNERS[2], CORNERS[3], CORNERS[4]],
        &[[0, 1, 2, 3], [4, 5, 6, 7]],
    );
    apart.values = vec![0.0, 1.0, 2.0, 3.0, 1.0, 2.0, 3.0, 4.0];
    let merged = apart.clone().cleaned().unwrap();
    assert_eq!((merged.points.len(), merged.cells.len()), (5, 2));
    assert_eq!(made(&merged).boundary.len(), 6);
    // Points of other values are other points: the field jumps between them.
    apart.values[4] = 9.0;
    assert_eq!(apart.cleaned().unwrap().points.len(), 6);
}

#[test]
fn flat_cells_go_with_their_neighbours() {
    // A square cut along one diagonal below and along the other above, and the flat cell between.
    let points =
        [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0], [0.5, 0.5, -1.0], [0.5, 0.5, 1.0]];
    let cells = [[0, 1, 2, 4], [0, 2, 3, 4], [0, 1, 3, 5], [1, 2, 3, 5], [0, 1, 2, 3]];
    let mesh = made(&of(&points, &cells));
    assert_eq!(mesh.boundary.len(), 8);
    for i in 0..4000 {
        let (origin, direction) = random_line(&mut Random(i));
        assert_eq!(walked(&mesh, origin, direction), looked_at(&mesh, origin, direction));
    }
}

fn refused(grid: &Grid) -> String {
    Tetrahedra::new(grid, &vec![0.0; grid.values.len()]).unwrap_err().to_string()
}

/// Columns of flat cells whose only solid neighbour comes last.
#[test]
fn flat_cells_in_a_row_are_taken_as_the_solid_one_behind_them() {
    let count = 20_000u32;
    let mut points: Vec<[f64; 3]> = (0..count + 3).map(|i| [f64::from(i), f64::from(i % 2), 0.0]).collect();
    points.push([f64::from(count), 0.0, 1.0]);
    let mut cells: Vec<[u32; 4]> = (0..count).map(|i| [i, i + 1, i + 2, i + 3]).collect();
    cells.push([count, count + 1, count + 2, count + 3]);
    let mesh = made(&of(&points, &cells));
    assert_eq!(mesh.cells.len(), count as usize + 1);
}

#[test]
fn what_cannot_be_mended_is_refused_by_its_numbers() {
    let three = of(&CORNERS, &[[0, 1, 2, 3], [0, 1, 2, 4], [0, 1, 2, 5]]);
    assert!(refused(&three).contains("cells 0, 1 and 2, which share one face"), "{}", refused(&three));
    // Both above the face they share.
    let overlap = of(&CORNERS, &[[0, 1, 2, 3], [0, 1, 2, 5]]);
    assert!(
        refused(&overlap).contains("cells 0 and 1, which lie on one side of the face they share"),
        "{}",
        refused(&overlap)
    );
    let flat = of(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.1], [0.0, 1.0, 0.0], [1.0, 1.0, 0.1]], &[[0, 1, 2, 3]]);
    assert!(refused(&flat).contains("no volume"), "{}", refused(&flat));
    let mut nowhere = of(&CORNERS[..4], &[[0, 1, 2, 3]]);
    nowhere.points[2][1] = f64::NAN;
    assert!(nowhere.cleaned().unwrap_err().to_string().contains("the point 2"));
    for name in ["tets-cube:0", "tets-cube:1000000", "tets-ball:x", "tets-torus:-1"] {
        let message = builtin::mesh(name).unwrap().unwrap_err().to_string();
        assert!(message.starts_with(&format!("builtin:{name}: has no size that it can be made in")), "{message}");
    }
    assert!(builtin::mesh("shells:8").is_none());
}
