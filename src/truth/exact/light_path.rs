//! What becomes of light on its way to a point of a surface: by every crossing of the interpolant, and without a bias.

use glam::DVec3;

use super::ExactIntegrator;
use crate::scene::Scene;
use crate::scene::light::{Arriving, Light, LitPoint};

/// A crossing so near to where a way begins is that of the surface there, in parts of the volume's longest side.
const HERE: f64 = 1e-9;

impl ExactIntegrator<'_> {
    /// What arrives at a point of a surface of a light.
    pub(super) fn arriving(&self, scene: &Scene, light: &Light, point: &LitPoint) -> Arriving {
        let mut arriving = Arriving::WHOLE;
        let Some(way) = light.from(point.place) else { return arriving };
        let length = scene.way_out(point.place, way, light.distance(point.place));
        let surfaces: Vec<_> = scene.surface.iter().flat_map(|surface| &surface.levels).collect();
        let levels: Vec<f64> = surfaces.iter().map(|level| level.values[0]).collect();
        if scene.shadow_bias().is_some() {
            let crossings = self.crossings(point.place, way, length, &levels);
            let met = crossings.iter().filter(|crossing| crossing.t > HERE);
            arriving.clear = met.map(|crossing| 1.0 - surfaces[crossing.level].opacity).product();
        }
        if let Some(translucency) = scene.translucency() {
            let inside = self.inside(point.place, way, length, levels[0]);
            arriving.through = (-translucency.absorption * inside).exp();
        }
        arriving
    }

    /// How far a way goes at values of at least that.
    fn inside(&self, begin: DVec3, way: DVec3, length: f64, level: f64) -> f64 {
        let crossings = self.crossings(begin, way, length, &[level]);
        // Without a crossing it is within all along or not at all.
        let middle = || self.first_within(begin + 0.5 * length * way, way, HERE, &[[level, f64::INFINITY]]).is_some();
        let mut within = crossings.first().map_or_else(middle, |first| !first.rises);
        let (mut inside, mut from) = (0.0, 0.0);
        for t in crossings.iter().map(|crossing| crossing.t).chain([length]) {
            inside += if within { t - from } else { 0.0 };
            (within, from) = (!within, t);
        }
        inside
    }
}
