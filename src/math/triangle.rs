//! A triangle as points around it see it: how far away it is, and how much of all directions it covers.

use glam::DVec3;

/// A triangle whose height is this small a part of its longest side is, to what f64 can tell, its edges alone: its normal has no
/// digits left.
const THIN: f64 = 1e-8;

/// A triangle in space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Triangle {
    /// Counter-clockwise as seen from the front.
    pub corners: [DVec3; 3],
    /// On the front, as long as the triangle's area.
    pub area: DVec3,
    /// The unit normal on the front; 0 where the triangle is too thin to have one.
    normal: DVec3,
}

impl Triangle {
    pub fn new(corners: [DVec3; 3]) -> Self {
        let [a, b, c] = corners;
        let area = 0.5 * (b - a).cross(c - a);
        let longest = [b - a, c - b, a - c].map(DVec3::length_squared).into_iter().fold(0.0, f64::max);
        let is_thin = area.length() <= THIN * longest;
        Self { corners, area, normal: if is_thin { DVec3::ZERO } else { area.normalize() } }
    }

    /// Whether it is more than a line or a point.
    pub fn has_area(&self) -> bool {
        self.area != DVec3::ZERO
    }

    /// The length of a side, which leads from the corner of its number, 0 to 2, to the next one.
    pub fn side(&self, number: usize) -> f64 {
        self.corners[number].distance(self.corners[(number + 1) % 3])
    }

    /// The mean of the corners.
    pub fn middle(&self) -> DVec3 {
        self.corners.iter().sum::<DVec3>() / 3.0
    }

    /// The square of a point's distance from the nearest point of the triangle. Where it is not below `limit`, what is given is
    /// some number that is not below `limit` either.
    pub fn squared_distance(&self, point: DVec3, limit: f64) -> f64 {
        let [a, b, c] = self.corners.map(|corner| corner - point);
        let height = self.normal.dot(a);
        // 0 where there is no normal.
        let to_plane = height * height;
        if to_plane >= limit {
            return to_plane;
        }
        // The point's foot lies on the inner side of each edge, whose ends are seen from the point.
        let inner = |from: DVec3, to: DVec3| self.normal.dot(from.cross(to)) >= 0.0;
        if self.normal != DVec3::ZERO && inner(a, b) && inner(b, c) && inner(c, a) {
            return to_plane;
        }
        to_edge(a, b).min(to_edge(b, c)).min(to_edge(c, a))
    }

    /// The part of all directions that the triangle covers as seen from a point, from -1/2 to 1/2: above 0 where its back is seen,
    /// 0 where the point is one of its corners [van Oosterom and Strackee 1983].
    pub fn cover(&self, point: DVec3) -> f64 {
        let [a, b, c] = self.corners.map(|corner| corner - point);
        let [la, lb, lc] = [a, b, c].map(DVec3::length);
        let across = a.dot(b.cross(c));
        let along = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
        across.atan2(along) / std::f64::consts::TAU
    }
}

/// The square of the origin's distance from an edge.
fn to_edge(from: DVec3, to: DVec3) -> f64 {
    let along = to - from;
    let length = along.length_squared();
    let part = if length > 0.0 { (-from.dot(along) / length).clamp(0.0, 1.0) } else { 0.0 };
    (from + part * along).length_squared()
}
