//! Built-in meshes of tetrahedra with known fields.

use std::collections::HashMap;
use std::f64::consts::TAU;

use glam::DVec3;

use super::{Grid, MOST_CELLS};
use crate::error::{Error, Result};

/// A built-in mesh.
pub struct BuiltinMesh {
    pub name: &'static str,
    /// One line for help and reports.
    pub about: &'static str,
    cells: fn(usize) -> usize,
    make: fn(usize) -> Pieces,
}

/// Points, their values, cells.
type Pieces = (Vec<DVec3>, Vec<f64>, Vec<[u32; 4]>);

/// Every built-in mesh.
pub static MESHES: [BuiltinMesh; 3] = [
    BuiltinMesh {
        name: "tets-cube",
        about: "a cube of SIZE^3 boxes of six cells; a value that rises linearly along its diagonal",
        cells: |n| 6 * n.saturating_pow(3),
        make: cube,
    },
    BuiltinMesh {
        name: "tets-ball",
        about: "a ball of 8 SIZE^3 cells; a value that falls with the distance from its middle",
        cells: |n| 8 * n.saturating_pow(3),
        make: ball,
    },
    BuiltinMesh {
        name: "tets-torus",
        about: "a ring of square section, 4 SIZE boxes around and SIZE^2 across, of six cells; a value that rises and falls around",
        cells: |n| 24 * n.saturating_pow(3),
        make: torus,
    },
];

/// Boxes along a side where a specification names none.
const DEFAULT_SIZE: usize = 16;

/// Axes in each of their orders: the corners that a tetrahedron of a box goes by, from its lowest corner to its highest, an axis at a time
/// [Kuhn 1960].
const ORDERS: [[usize; 3]; 6] = [[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [2, 1, 0], [1, 0, 2]];

/// The mesh `NAME` or `NAME:SIZE`; none where the name is not that of a mesh.
///
/// # Errors
/// When the size is not one, or there would be more cells than can be.
pub fn mesh(spec: &str) -> Option<Result<Grid>> {
    let spec = spec.strip_prefix("builtin:").unwrap_or(spec);
    let (name, size) = spec.split_once(':').map_or((spec, None), |(name, size)| (name, Some(size)));
    let builtin = MESHES.iter().find(|mesh| mesh.name == name)?;
    let label = format!("builtin:{spec}");
    let sound = |n: &usize| *n > 0 && (builtin.cells)(*n) <= MOST_CELLS;
    let size = size.map_or(Some(DEFAULT_SIZE), |size| size.parse().ok()).filter(sound);
    Some(match size {
        Some(size) => {
            let (points, values, cells) = (builtin.make)(size);
            let points = points.into_iter().map(|point| point.to_array()).collect();
            Ok(Grid { name: label, points, values, cells, notes: Vec::new() })
        }
        None => {
            let remedy = format!(
                "give one whole number from 1 on, with which there are at most {MOST_CELLS} cells: {}",
                builtin.about
            );
            Err(Error::usage(label, "has no size that it can be made in", remedy))
        }
    })
}

/// The cells of a box, by the number of each corner.
fn of_box(low: [usize; 3], number: impl Fn([usize; 3]) -> u32) -> impl Iterator<Item = [u32; 4]> {
    ORDERS.into_iter().map(move |axes| {
        let mut at = low;
        let mut corners = [number(at); 4];
        for (corner, axis) in corners[1..].iter_mut().zip(axes) {
            at[axis] += 1;
            *corner = number(at);
        }
        corners
    })
}

/// Places of a lattice of so many boxes, the first fastest.
fn places([x, y, z]: [usize; 3]) -> impl Iterator<Item = [usize; 3]> {
    (0..z).flat_map(move |k| (0..y).flat_map(move |j| (0..x).map(move |i| [i, j, k])))
}

fn cube(n: usize) -> Pieces {
    let side = n + 1;
    let points: Vec<DVec3> =
        places([side; 3]).map(|at| DVec3::from_array(at.map(|i| i as f64 / n as f64)) - 0.5).collect();
    let number = |[i, j, k]: [usize; 3]| ((k * side + j) * side + i) as u32;
    let cells = places([n; 3]).flat_map(|low| of_box(low, number)).collect();
    let values = points.iter().map(|p| (p.x + p.y + p.z) / 3.0 + 0.5).collect();
    (points, values, cells)
}

/// Eight corners of an octahedron, each cut into n^3 cells, blown up to a ball: no cell has two faces on the sphere.
fn ball(n: usize) -> Pieces {
    let mut points = Vec::new();
    let mut numbers: HashMap<[i64; 3], u32> = HashMap::new();
    let mut cells = Vec::new();
    for octant in 0..8 {
        let signs: [i64; 3] = [0, 1, 2].map(|axis| if octant >> axis & 1 == 0 { 1 } else { -1 });
        // Of a box lattice the part in which coordinates do not rise is a tetrahedron, whose corners go to the middle and three axes.
        let inside = |at: &[usize; 3]| at[0] >= at[1] && at[1] >= at[2];
        for low in places([n; 3]) {
            for axes in ORDERS {
                let mut at = low;
                let mut corners = [at; 4];
                for (corner, axis) in corners[1..].iter_mut().zip(axes) {
                    at[axis] += 1;
                    *corner = at;
                }
                if !corners.iter().all(inside) {
                    continue;
                }
                cells.push(corners.map(|[i, j, k]| {
                    let place = [i - j, j - k, k].map(|c| c as i64);
                    let key = [0, 1, 2].map(|axis| signs[axis] * place[axis]);
                    *numbers.entry(key).or_insert_with(|| {
                        let flat = DVec3::from_array(key.map(|c| c as f64)) / n as f64;
                        let (sum, length) = (flat.abs().element_sum(), flat.length());
                        points.push(if length > 0.0 { 0.5 * flat * sum / length } else { flat });
                        points.len() as u32 - 1
                    })
                }));
            }
        }
    }
    let values = points.iter().map(|point| 1.0 - 2.0 * point.length()).collect();
    (points, values, cells)
}

/// Radius of the middle of the ring, and half of a side of its section.
const RING: f64 = 0.35;
const HALF_SECTION: f64 = 0.15;

fn torus(n: usize) -> Pieces {
    let (around, across) = (4 * n, n + 1);
    let place = |[i, j, k]: [usize; 3]| {
        let part = |i: usize| HALF_SECTION * (2.0 * i as f64 / n as f64 - 1.0);
        let (sin, cos) = (TAU * i as f64 / around as f64).sin_cos();
        let radius = RING + part(j);
        DVec3::new(radius * cos, radius * sin, part(k))
    };
    let points: Vec<DVec3> = places([around, across, across]).map(place).collect();
    let number = |[i, j, k]: [usize; 3]| ((k * across + j) * around + i % around) as u32;
    let cells = places([around, n, n]).flat_map(|low| of_box(low, number)).collect();
    let values = points.iter().map(|p| 0.5 + 0.5 * p.x / p.truncate().length()).collect();
    (points, values, cells)
}
