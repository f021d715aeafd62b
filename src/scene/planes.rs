//! Clip planes [Thesis §3.1.2], which cut the interval of a ray before anything else looks at it.

use glam::DVec3;

use super::Scene;
use crate::math::polyhedron::HalfSpace;
use crate::math::ray::{ViewRay, cut_interval};

/// Clip planes at the most, as many as graphics libraries promise.
pub const MOST_PLANES: usize = 6;

/// The clip planes of a scene, in the volume's axes, as the half spaces that they keep.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ClipPlanes {
    /// Those that cut something off the volume come first.
    all: Vec<HalfSpace>,
    cutting: usize,
}

impl ClipPlanes {
    /// Of a volume whose box is [-half, half].
    pub fn new(planes: impl IntoIterator<Item = HalfSpace>, half: DVec3) -> Self {
        // The corner that lies deepest below the plane.
        let cuts = |plane: &HalfSpace| plane.height(-half * plane.normal.signum()) < 0.0;
        let (mut all, others): (Vec<_>, Vec<_>) = planes.into_iter().partition(cuts);
        let cutting = all.len();
        all.extend(others);
        Self { all, cutting }
    }

    /// All of them.
    pub fn all(&self) -> &[HalfSpace] {
        &self.all
    }

    /// Those that cut something off the volume.
    pub fn cutting(&self) -> &[HalfSpace] {
        &self.all[..self.cutting]
    }
}

impl Scene {
    /// The clip planes that its frames know: those that cut something off the volume, without the planner all.
    pub fn clip_planes(&self) -> &[HalfSpace] {
        if self.settings.method.planner { self.planes.cutting() } else { self.planes.all() }
    }

    /// How far it is from a point along a unit vector until what is kept of the volume is left, or a light at `reach` is reached; volume
    /// units.
    pub fn way_out(&self, point: DVec3, way: DVec3, reach: f64) -> f64 {
        let half = 0.5 * self.field.extent();
        let faces = (0..3).filter(|axis| way[*axis] != 0.0);
        let faces = faces.map(|axis| (half[axis].copysign(way[axis]) - point[axis]) / way[axis]);
        let planes = self.clip_planes().iter().filter(|plane| plane.normal.dot(way) < 0.0);
        let planes = planes.map(|plane| plane.height(point) / -plane.normal.dot(way));
        faces.chain(planes).fold(reach, f64::min)
    }

    /// The depths between which a ray lies inside the volume's box and all clip planes, and beyond `near`.
    pub fn interval(&self, ray: &ViewRay, near: f64) -> Option<(f64, f64)> {
        cut_interval(ray, 0.5 * self.field.extent(), near, self.clip_planes())
    }
}
