//! Vertices as a line sees them: how far beside it, and at which parameter of it.
//!
//! All cells see a vertex at the same place across a line, rounded once, and on which side of an edge the line passes is decided exactly
//! for these places: of the four faces of a cell, whatever it looks like, a line passes through two or none. So cells that a line passes
//! through are chains from one face of the boundary to another; none is lost and none comes twice, on edges and in vertices either.
//! Where a line meets an edge or a vertex to the last bit, vertices count as moved across it by amounts that are smaller than anything,
//! that of the lower number by more, along the first axis by more than along the second [Edelsbrunner and Mücke 1990].
//!
//! Places across the line are those of Woop, Benthin and Wald (Watertight Ray/Triangle Intersection, JCGT 2013). Twin:
//! `glsl/shared/seen.glsl`, whose axes are those of the picture.

use glam::DVec3;

/// A line, by what places across it follow from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    pub origin: DVec3,
    /// Axes: two across, and the one along which the direction is longest, so that they turn as the three of space do, seen along the line.
    axes: [usize; 3],
    /// What a unit along the third axis is along the others.
    shear: [f64; 2],
    /// The direction along the third axis.
    along: f64,
}

/// A vertex as a line sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seen {
    /// The number of the vertex.
    pub number: u32,
    pub place: [f64; 2],
    /// The parameter of the line.
    pub depth: f64,
}

impl Line {
    /// The line through `origin` along `direction`, which has a length.
    pub fn new(origin: DVec3, direction: DVec3) -> Self {
        let size = direction.abs();
        let third = (0..3).fold(0, |most, axis| if size[axis] > size[most] { axis } else { most });
        let (mut first, mut second) = ((third + 1) % 3, (third + 2) % 3);
        if direction[third] < 0.0 {
            (first, second) = (second, first);
        }
        let along = direction[third];
        let shear = [direction[first] / along, direction[second] / along];
        Self { origin, axes: [first, second, third], shear, along }
    }

    /// The vertex of a number at a point.
    pub fn sees(&self, number: u32, point: DVec3) -> Seen {
        let arm = point - self.origin;
        let [first, second, third] = self.axes.map(|axis| arm[axis]);
        let place = [first - self.shear[0] * third, second - self.shear[1] * third];
        Seen { number, place, depth: third / self.along }
    }
}

/// The product of two numbers and what rounding took from it.
fn product(a: f64, b: f64) -> [f64; 2] {
    let rounded = a * b;
    [rounded, a.mul_add(b, -rounded)]
}

/// Twice the area of the triangle from the line to two vertices, above 0 where they go round to the left; a few units in the last place
/// from the exact one.
pub fn area(a: &Seen, b: &Seen) -> f64 {
    let ([p, rest_of_p], [q, rest_of_q]) = (product(a.place[0], b.place[1]), product(a.place[1], b.place[0]));
    (p - q) + (rest_of_p - rest_of_q)
}

/// Whether two vertices go round a line to the left.
pub fn left(a: &Seen, b: &Seen) -> bool {
    // By the numbers, so that both directions of an edge give opposite answers.
    if a.number > b.number {
        return !left(b, a);
    }
    let ([p, rest_of_p], [q, rest_of_q]) = (product(a.place[0], b.place[1]), product(a.place[1], b.place[0]));
    // Products are rounded in their order.
    if p != q {
        return p > q;
    }
    if rest_of_p != rest_of_q {
        return rest_of_p > rest_of_q;
    }
    // What the area grows by as `a` moves along each axis, then as `b` does; as both do it falls.
    let moved = [b.place[1], -b.place[0], -a.place[1], a.place[0]];
    moved.into_iter().find(|by| *by != 0.0).is_some_and(|by| by > 0.0)
}

/// Whether the line passes through a triangle, and whether its corners go round to the left.
pub fn through([a, b, c]: [&Seen; 3]) -> Option<bool> {
    let first = left(a, b);
    (left(b, c) == first && left(c, a) == first).then_some(first)
}

/// Weights of the corners of a triangle that the line passes through, for the point where it does.
pub fn weights(corners: [&Seen; 3]) -> [f64; 3] {
    let [a, b, c] = corners;
    let areas = [area(b, c), area(c, a), area(a, b)];
    let sum: f64 = areas.iter().sum();
    let weights = areas.map(|area| area / sum);
    // Corners on one line with this one: it passes between two of them, or through one.
    if weights.iter().all(|weight| (0.0..=1.0).contains(weight)) { weights } else { on_edge(corners) }
}

/// The same where the corners stand in a row across the line: of the edge that it passes nearest to the middle of.
fn on_edge(corners: [&Seen; 3]) -> [f64; 3] {
    let length = |seen: &Seen| seen.place[0].hypot(seen.place[1]);
    let apart = |i: usize| {
        let (a, b) = (corners[i].place, corners[(i + 1) % 3].place);
        a[0] * b[0] + a[1] * b[1]
    };
    let from = (0..3).fold(0, |least, i| if apart(i) < apart(least) { i } else { least });
    let to = (from + 1) % 3;
    let (a, b) = (length(corners[from]), length(corners[to]));
    let mut weights = [0.0; 3];
    weights[from] = if a + b > 0.0 { b / (a + b) } else { 0.5 };
    weights[to] = 1.0 - weights[from];
    weights
}
