//! How cells are cut into tetrahedra, and what is mended of a mesh or refused.

use std::collections::HashSet;

use depthleap::scene::Tetrahedra;
use depthleap::scene::tetrahedra::cut::{CellKind, Cutter, HEXAHEDRON, PYRAMID, TETRAHEDRON, VOXEL, WEDGE};
use depthleap::scene::tetrahedra::{Grid, builtin};

use crate::random::Random;
use crate::{looked_at, made, of, random_line, six_volumes, walked, warped};

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
