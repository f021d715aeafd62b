//! The surface of a mesh: how far a point is from it, and how often it winds around the point.

use std::f64::consts::PI;
use std::ops::Range;

use glam::DVec3;

use super::far::Far;
use crate::math::bvh::{Bounds, Hierarchy};
use crate::math::triangle::Triangle;
use crate::scene::mesh::OpenEdge;

/// How often a surface winds around the points of a ball.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Winding {
    /// Its winding number at the ball's centre: 1 within a closed mesh whose fronts are outside.
    pub number: f64,
    /// What it is off by elsewhere in the ball at the most.
    pub change: f64,
}

/// Triangles in a hierarchy, in the unit of the voxels.
#[derive(Clone, Debug)]
pub struct Skin {
    hierarchy: Hierarchy,
    /// In the order of the hierarchy's leaves.
    triangles: Vec<Triangle>,
    /// Of each triangle, the length of the open edges that it stands for.
    open: Vec<f64>,
    /// What each node of the hierarchy is from far away.
    far: Vec<Far>,
}

impl Skin {
    /// Triangles by their numbers, and the edges at which they are open. Those without an area take part in no distance.
    pub fn new(triangles: Vec<Triangle>, open_edges: &[OpenEdge]) -> Self {
        let boxes: Vec<Bounds> = triangles.iter().map(|triangle| Bounds::around(triangle.corners)).collect();
        let hierarchy = Hierarchy::new(&boxes);
        let mut open = vec![0.0; triangles.len()];
        for edge in open_edges {
            let number = edge.triangle as usize;
            open[number] += f64::from(edge.excess) * triangles[number].side(edge.side);
        }
        let in_order = |number: &u32| *number as usize;
        let open: Vec<f64> = hierarchy.order().iter().map(|number| open[in_order(number)]).collect();
        let triangles: Vec<Triangle> = hierarchy.order().iter().map(|number| triangles[in_order(number)]).collect();
        let leaf = |bounds: Bounds, places: Range<usize>| Far::of(bounds, &triangles[places.clone()], &open[places]);
        let far = hierarchy.gathered(leaf, Far::joined);
        Self { hierarchy, triangles, open, far }
    }

    /// The triangle nearest to a point, by its place in the hierarchy, and its distance; none where none is nearer than `limit`.
    /// `near`: the place of one that may be near, which spares time.
    pub fn nearest(&self, point: DVec3, limit: f64, near: Option<usize>) -> Option<(usize, f64)> {
        let limit = limit * limit;
        let squared = |place: usize, limit: f64| match &self.triangles[place] {
            triangle if triangle.has_area() => triangle.squared_distance(point, limit),
            _ => f64::INFINITY,
        };
        let near = near.map(|place| (place, squared(place, limit))).filter(|(_, squared)| *squared < limit);
        let limit = near.map_or(limit, |(_, squared)| squared);
        let found = self.hierarchy.nearest(point, limit, &squared).or(near);
        found.map(|(place, squared)| (place, squared.sqrt()))
    }

    /// The winding number in a ball about a point. `distance`: how far the surface is from the point at the least, more than the
    /// ball's radius; of a ball of radius 0 any.
    pub fn winding(&self, point: DVec3, radius: f64, distance: f64) -> Winding {
        // The gradient of the number is a line integral along the open edges, as the magnetic field of a current that flows in them
        // is [Biot and Savart]: of a length L that is nowhere nearer than d it is at most L / (4 pi d^2).
        let change = |open: f64, bounds: Bounds| {
            if open == 0.0 || radius == 0.0 {
                return 0.0;
            }
            let away = bounds.squared_distance(point).sqrt().max(distance) - radius;
            radius * open / (4.0 * PI * away * away)
        };
        let opens = |sum: &mut Winding, node: usize, bounds: Bounds| {
            let far = &self.far[node];
            let away = far.middle - point;
            let squared = away.length_squared();
            if squared <= far.squared {
                return true;
            }
            sum.number += far.cover(away, squared);
            sum.change += change(far.open, bounds);
            false
        };
        let leaf = |sum: &mut Winding, places: Range<usize>, bounds: Bounds| {
            sum.number += self.triangles[places.clone()].iter().map(|triangle| triangle.cover(point)).sum::<f64>();
            sum.change += change(self.open[places].iter().sum(), bounds);
        };
        let mut sum = Winding::default();
        self.hierarchy.visit(&mut sum, opens, leaf);
        sum
    }
}
