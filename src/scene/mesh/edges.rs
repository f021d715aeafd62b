//! Edges at which a mesh is open.

use rayon::prelude::*;

/// An edge that is gone along in one direction more often than in the other: the surface ends there, or is turned over.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OpenEdge {
    /// One of the triangles that it belongs to, by its number.
    pub triangle: u32,
    /// Which side of that triangle it is: 0 is from its first corner to its second one.
    pub side: usize,
    /// How much more often.
    pub excess: u32,
}

/// An edge of a triangle.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Side {
    /// The numbers of its two places, the lesser one first.
    places: (u32, u32),
    /// 1 where the triangle goes along it from the lesser number to the greater one, else -1.
    direction: i32,
    triangle: u32,
    side: usize,
}

/// The open edges of triangles, which go from corner to corner; corners at one place are one.
pub fn open_edges(triangles: &[[u32; 3]], corners: &[[f32; 3]]) -> Vec<OpenEdge> {
    let places = places(corners);
    let sides_of = |(number, triangle): (usize, &[u32; 3])| {
        let ends = triangle.map(|corner| places[corner as usize]);
        [0, 1, 2].map(|side| {
            let (from, to) = (ends[side], ends[(side + 1) % 3]);
            let direction = if from < to { 1 } else { -1 };
            Side { places: (from.min(to), from.max(to)), direction, triangle: number as u32, side }
        })
    };
    let sides = triangles.iter().enumerate().flat_map(sides_of);
    let mut sides: Vec<Side> = sides.filter(|side| side.places.0 != side.places.1).collect();
    sides.par_sort_unstable();
    let open = |of_one: &[Side]| {
        let excess = of_one.iter().map(|side| side.direction).sum::<i32>().unsigned_abs();
        (excess > 0).then(|| OpenEdge { triangle: of_one[0].triangle, side: of_one[0].side, excess })
    };
    sides.chunk_by(|a, b| a.places == b.places).filter_map(open).collect()
}

/// A number for each corner, the same for those that lie at one place.
fn places(corners: &[[f32; 3]]) -> Vec<u32> {
    // Adding 0 makes one of the two zeros.
    let key = |i: &u32| corners[*i as usize].map(|c| (c + 0.0).to_bits());
    let mut order: Vec<u32> = (0..corners.len() as u32).collect();
    order.par_sort_unstable_by_key(key);
    let mut places = vec![0; corners.len()];
    for (number, alike) in order.chunk_by(|a, b| key(a) == key(b)).enumerate() {
        alike.iter().for_each(|corner| places[*corner as usize] = number as u32);
    }
    places
}
