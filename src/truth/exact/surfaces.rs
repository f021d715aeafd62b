//! The colours of iso-surfaces that a ray meets, in exact arithmetic.

use glam::DVec3;

use super::ExactIntegrator;
use crate::math::opacity::composite;
use crate::scene::Scene;
use crate::scene::light::{LitPoint, lit_by};
use crate::scene::settings::Shows;

impl ExactIntegrator<'_> {
    /// The colour of the surface that a ray meets first, lit and reflecting by the gradient of the interpolant, or what else the scene
    /// shows of it.
    pub(super) fn surface(&self, scene: &Scene, entry: DVec3, direction: DVec3, length: f64) -> [f64; 4] {
        let levels = scene.surface.iter().flat_map(|surface| &surface.levels);
        let (ranges, colors): (Vec<[f64; 2]>, Vec<[f64; 3]>) = levels.map(|level| (level.values, level.color)).unzip();
        let Some(found) = self.first_within(entry, direction, length, &ranges) else { return [0.0; 4] };
        let point = LitPoint { place: entry + found.t * direction, normal: found.gradient, view: -direction };
        let [r, g, b] = match scene.settings.surface.shows {
            Shows::Color => self.shown_color(scene, colors[found.range], &point),
            Shows::Position => point.place.to_array(),
            Shows::Normal => point.turned().unwrap_or_default().to_array(),
        };
        [r, g, b, 1.0]
    }

    /// The colours of all surfaces that a ray crosses, one behind the other and with the volume between where it is drawn, lit and reflecting as [`Self::surface`] has them. Of those
    /// that it begins within it meets the innermost there.
    pub(super) fn transparent_surfaces(&self, scene: &Scene, entry: DVec3, direction: DVec3, length: f64) -> [f64; 4] {
        let surfaces: Vec<_> = scene.surface.iter().flat_map(|surface| &surface.levels).collect();
        let levels: Vec<f64> = surfaces.iter().map(|level| level.values[0]).collect();
        let mut met: Vec<(f64, usize, DVec3)> = Vec::new();
        let ranges: Vec<[f64; 2]> = surfaces.iter().map(|level| level.values).collect();
        let begin = self.first_within(entry, direction, length, &ranges).filter(|found| found.t == 0.0);
        met.extend(begin.map(|found| (found.t, found.range, found.gradient)));
        let crossings = self.crossings(entry, direction, length, &levels);
        met.extend(crossings.into_iter().map(|crossing| (crossing.t, crossing.level, crossing.gradient)));
        let volume = |from: f64, to: f64| match scene.surfaces_in_volume() {
            true => self.colors_between(entry, direction, [from, to]),
            false => [0.0; 4],
        };
        let (mut pixel, mut from) = ([0.0; 4], 0.0);
        for (t, level, normal) in met {
            let point = LitPoint { place: entry + t * direction, normal, view: -direction };
            let (color, opacity) = (self.shown_color(scene, surfaces[level].color, &point), surfaces[level].opacity);
            let [r, g, b] = color.map(|c| c * opacity);
            pixel = composite(composite(pixel, volume(from, t)), [r, g, b, opacity]);
            from = t;
        }
        composite(pixel, volume(from, length))
    }

    /// A surface of that colour in the lights of the scene, with what it reflects.
    fn shown_color(&self, scene: &Scene, color: [f64; 3], point: &LitPoint) -> [f64; 3] {
        let through = scene.translucency().map_or(0.0, |translucency| translucency.part);
        let lit = lit_by(color, &scene.shining(), point, through, |light| self.arriving(scene, light, point));
        scene.environment.as_ref().map_or(lit, |environment| environment.on(lit, point.normal, point.view))
    }
}
