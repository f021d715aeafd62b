//! The 256 ways in which the corners of a cell can lie on both sides of a level, and the triangles of each [Lorensen and Cline 1987].
//!
//! No table is written down: the polygons follow from one rule. On each face, corners above the level that are next to each other are
//! one run, and a segment cuts each run off from the rest, so that on an ambiguous face the two corners above the level are apart. The
//! rule knows nothing but the four corners of the face, so that the cells on both sides of it have the same segments, and every surface
//! is closed. The segments join to loops, which are cut into triangles without a diagonal inside a face of the cell: such a one could
//! be an edge of the neighbour's triangles too.

use std::sync::LazyLock;

/// Corners of a cell: bit a of the number is the side of axis a.
pub const CORNERS: usize = 8;

/// Edges of a cell.
pub const EDGES: usize = 12;

/// Triangles of a case at the most.
pub const MOST_TRIANGLES: usize = 5;

/// An edge of a cell: the axis it goes along and its lower corner.
pub const fn edge(number: usize) -> (usize, usize) {
    let axis = number / 4;
    let (b, c) = ((axis + 1) % 3, (axis + 2) % 3);
    (axis, (number & 1) << b | (number >> 1 & 1) << c)
}

/// The edge between two corners of one side.
fn edge_between(one: usize, other: usize) -> u8 {
    let axis = (one ^ other).trailing_zeros() as usize;
    let (b, c) = ((axis + 1) % 3, (axis + 2) % 3);
    (axis * 4 + (one >> b & 1) + 2 * (one >> c & 1)) as u8
}

/// Triangles of each case, by their edges; the case is a bit for each corner whose value is not below the level. Seen from below the
/// level they go round against the clock, in a right-handed space.
pub static CASES: LazyLock<[Vec<[u8; 3]>; 256]> =
    LazyLock::new(|| std::array::from_fn(|case| loops(case as u8).iter().flat_map(|one| triangles(one)).collect()));

/// The corners of each face, against the clock as seen from outside.
fn faces() -> [[usize; 4]; 6] {
    std::array::from_fn(|face| {
        let (axis, upper) = (face / 2, face % 2);
        let (b, c) = (1 << ((axis + 1) % 3), 1 << ((axis + 2) % 3));
        let base = upper << axis;
        match upper {
            0 => [base, base + c, base + b + c, base + b],
            _ => [base, base + b, base + b + c, base + c],
        }
    })
}

/// The closed polygons of a case, by the edges on which their corners lie.
fn loops(case: u8) -> Vec<Vec<u8>> {
    let above = |corner: usize| case >> corner & 1 == 1;
    let mut next = [None; EDGES];
    for face in faces() {
        let side = |i: usize| (face[i % 4], face[(i + 1) % 4]);
        let crossed = |from_above: bool| {
            move |i: &usize| {
                let (one, other) = (face[i % 4], face[(i + 1) % 4]);
                above(one) == from_above && above(other) != from_above
            }
        };
        // A run begins where its side is crossed upwards, and ends at the first side after that which is crossed downwards.
        for begin in (0..4).filter(crossed(false)) {
            let Some(end) = (begin + 1..begin + 4).find(crossed(true)) else { continue };
            let of = |i: usize| edge_between(side(i).0, side(i).1);
            next[usize::from(of(begin))] = Some(of(end));
        }
    }
    let mut found = Vec::new();
    for first in 0..EDGES {
        let mut polygon = Vec::new();
        let mut at = first;
        while let Some(then) = next[at].take() {
            polygon.push(at as u8);
            at = usize::from(then);
        }
        if !polygon.is_empty() {
            found.push(polygon);
        }
    }
    found
}

/// Whether two edges of a cell lie in one of its faces.
fn share_a_face(one: u8, other: u8) -> bool {
    let of = |edge: u8| {
        let corners = corners_of_edge(edge);
        faces().map(|face| corners.iter().all(|corner| face.contains(corner)))
    };
    of(one).iter().zip(of(other)).any(|(a, b)| *a && b)
}

fn corners_of_edge(number: u8) -> [usize; 2] {
    let (axis, lower) = edge(number.into());
    [lower, lower | 1 << axis]
}

/// A polygon as triangles; nothing where every way to cut it has a diagonal inside a face, which no case has.
fn triangles(polygon: &[u8]) -> Vec<[u8; 3]> {
    cut(polygon).unwrap_or_default()
}

/// Cuts off the triangle on the side from the last corner to the first one, then what is left on both sides of it.
fn cut(polygon: &[u8]) -> Option<Vec<[u8; 3]>> {
    let last = match polygon.len() {
        0..3 => return Some(Vec::new()),
        corners => corners - 1,
    };
    (1..last).find_map(|apex| {
        let inside = |one: usize, other: usize| other - one < 2 || !share_a_face(polygon[one], polygon[other]);
        if !inside(0, apex) || !inside(apex, last) {
            return None;
        }
        let mut all = cut(&polygon[..=apex])?;
        all.push([polygon[0], polygon[apex], polygon[last]]);
        all.extend(cut(&polygon[apex..])?);
        Some(all)
    })
}
