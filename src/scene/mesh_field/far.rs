//! Triangles as one sees them from far away: the first three terms of a Taylor series about their middle [Barill18].

use std::f64::consts::PI;

use glam::{DMat3, DVec3};

use crate::math::bvh::Bounds;
use crate::math::triangle::Triangle;

/// Triangles are seen as one from a point that is so many times farther from their middle than any of them is [Barill18, there
/// beta].
const FAR: f64 = 2.5;

/// What triangles are together, as integrals over their area: of the unit normal n, and of the place d about their middle.
#[derive(Clone, Copy, Debug)]
pub struct Far {
    /// Mean of the triangles, each as much as its area.
    pub middle: DVec3,
    /// The square of the distance from which on they are seen as one.
    pub squared: f64,
    /// Length of open edges.
    pub open: f64,
    /// The sum of areas.
    size: f64,
    moments: Moments,
    /// What of the third term goes with the inverse fifth power of the distance, before the product with the way there.
    third: DVec3,
}

/// Of all triangles the integrals of n, of d n, and of d d n / 2.
#[derive(Clone, Copy, Debug)]
struct Moments {
    area: DVec3,
    /// Rows go with d, columns with n.
    first: DMat3,
    /// One for each component of n.
    second: [DMat3; 3],
}

impl Moments {
    const NONE: Self = Self { area: DVec3::ZERO, first: DMat3::ZERO, second: [DMat3::ZERO; 3] };

    /// Of a triangle about a point.
    fn of(triangle: &Triangle, middle: DVec3) -> Self {
        let (area, place) = (triangle.area, triangle.middle() - middle);
        let corners = triangle.corners.map(|corner| outer(corner - middle, corner - middle));
        // The mean of d d over a triangle; its corners' sum is three times their mean.
        let square = (corners.into_iter().fold(9.0 * outer(place, place), |sum, one| sum + one)) * (1.0 / 12.0);
        Self { area, first: outer(place, area), second: area.to_array().map(|n| square * (0.5 * n)) }
    }

    /// About a point from which the one that they are about lies at `by`.
    fn moved(&self, by: DVec3) -> Self {
        let columns = [self.first.x_axis, self.first.y_axis, self.first.z_axis];
        let second = [0, 1, 2].map(|n| {
            let mixed = outer(by, columns[n]);
            self.second[n] + 0.5 * (mixed + mixed.transpose() + outer(by, by) * self.area[n])
        });
        Self { area: self.area, first: self.first + outer(by, self.area), second }
    }

    fn plus(self, other: Self) -> Self {
        Self {
            area: self.area + other.area,
            first: self.first + other.first,
            second: [0, 1, 2].map(|n| self.second[n] + other.second[n]),
        }
    }
}

impl Far {
    /// What triangles in a box are, with open edges of such lengths.
    pub fn of(bounds: Bounds, triangles: &[Triangle], open: &[f64]) -> Self {
        let size: f64 = triangles.iter().map(|triangle| triangle.area.length()).sum();
        let weighted: DVec3 = triangles.iter().map(|triangle| triangle.area.length() * triangle.middle()).sum();
        let middle = if size > 0.0 { weighted / size } else { bounds.middle() };
        let moments = triangles.iter().map(|triangle| Moments::of(triangle, middle)).fold(Moments::NONE, Moments::plus);
        Self::with(bounds, middle, size, moments, open.iter().sum())
    }

    /// What two parts in a box are together.
    pub fn joined(bounds: Bounds, one: Self, other: Self) -> Self {
        let size = one.size + other.size;
        let weighted = one.size * one.middle + other.size * other.middle;
        let middle = if size > 0.0 { weighted / size } else { bounds.middle() };
        let [a, b] = [&one, &other].map(|part| part.moments.moved(part.middle - middle));
        Self::with(bounds, middle, size, a.plus(b), one.open + other.open)
    }

    fn with(bounds: Bounds, middle: DVec3, size: f64, moments: Moments, open: f64) -> Self {
        let [x, y, z] = moments.second;
        let third = 2.0 * (x.x_axis + y.y_axis + z.z_axis) + DVec3::new(trace(x), trace(y), trace(z));
        Self { middle, squared: FAR * FAR * bounds.squared_reach(middle), open, size, moments, third }
    }

    /// The part of all directions that they cover from where their middle is `away`, whose square is given too; as
    /// [`Triangle::cover`].
    ///
    /// The integral of n . g(r + d), where g(r) = r / |r|^3, by powers of d.
    pub fn cover(&self, away: DVec3, squared: f64) -> f64 {
        let Moments { area, first, second: [x, y, z] } = self.moments;
        let form = |matrix: DMat3| away.dot(matrix * away);
        let cubic = away.dot(DVec3::new(form(x), form(y), form(z)));
        let linear = area.dot(away) + trace(first);
        let over_square = 3.0 * (form(first) + self.third.dot(away));
        let cover = linear - (over_square - 15.0 * cubic / squared) / squared;
        cover / (4.0 * PI * squared * squared.sqrt())
    }
}

fn trace(matrix: DMat3) -> f64 {
    matrix.x_axis.x + matrix.y_axis.y + matrix.z_axis.z
}

/// The matrix whose product with v is a (b . v).
fn outer(a: DVec3, b: DVec3) -> DMat3 {
    DMat3::from_cols(a * b.x, a * b.y, a * b.z)
}
