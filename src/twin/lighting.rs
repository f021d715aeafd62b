//! Twin of `glsl/lighting.frag`: the exact place of a surface, its normal, and its colour in all lights [Thesis ch. 5 §3.2].

use glam::DVec3;

use super::phong::{PLACE_ROUNDING, Shaded};
use super::{Effect, MetSurface, Pixel, Twin};
use crate::math::blend::Blend;
use crate::projection::{first_met, on_surface};
use crate::scene::light::LitPoint;
use crate::scene::settings::{Refine, Shows};
use crate::truth::exact::ExactIntegrator;

/// Colours that f32 may be off by more than this are left undecided.
pub(super) const LOOSE: f64 = 1e-3;

/// What f32 takes from a component of a vector that is made of length 1.
const UNIT_ROUNDING: f64 = 5e-7;

/// Puts the lit colour of the surface that the ray has met under what is in front of it.
pub fn lighting(twin: &Twin, pixel: &mut Pixel, _: u32) -> Effect {
    let [front, back, _, met] = pixel.hit;
    if met == 0.0 {
        return Effect::Discarded;
    }
    let (mut place, level) = twin.met(pixel, [front, back]);
    place.rounding += pixel.cut;
    twin.put_surface(pixel, place, level);
    Effect::Silent
}

/// A place on a ray, in steps, and how far one that is found in f32 may be from it.
#[derive(Clone, Copy, Debug)]
pub(super) struct RoundedPlace {
    pub steps: f64,
    pub rounding: f64,
}

impl Twin<'_> {
    /// Puts what shows of a surface that is met there under what the pixel has.
    pub(super) fn put_surface(&self, pixel: &mut Pixel, place: RoundedPlace, level: usize) {
        let unlit = self.scene.surface.as_ref().map(|surface| surface.levels[level]);
        let (color, opacity) = unlit.map_or(([0.0; 3], 0.0), |level| (level.color, level.opacity));
        let shown = |steps: f64| match self.scene.settings.surface.shows {
            Shows::Color => self.reflecting(pixel, self.shaded(pixel, steps, color, self.lights)),
            Shows::Position => self.shown_place(pixel, steps),
            Shows::Normal => self.shown_normal(pixel, steps),
        };
        let shaded = shown(place.steps);
        // A place that is off has another normal.
        let moved = [-place.rounding, place.rounding].map(|by| shown(place.steps + by).color);
        let apart = |other: &[f64; 3]| (0..3).map(|c| (other[c] - shaded.color[c]).abs()).fold(0.0, f64::max);
        let rounding = moved.iter().map(apart).fold(shaded.rounding, f64::max);
        // What stands in front takes its part of what may be off.
        let part = opacity * (1.0 - pixel.accumulated[3]);
        pixel.rounding += part * rounding;
        pixel.surface.get_or_insert(MetSurface { steps: place.steps, level, normal: shaded.normal });
        pixel.undecided |= part > 0.0 && (shaded.turns || rounding > LOOSE);
        let [r, g, b] = shaded.color.map(|c| c * opacity);
        pixel.accumulated = Blend::Over.apply(pixel.accumulated, [r, g, b, opacity]);
    }

    /// A place of a surface as it is shown, in volume space.
    fn shown_place(&self, pixel: &Pixel, steps: f64) -> Shaded {
        let extent = self.scene.field.extent();
        let place = (self.position_at(pixel, steps) - 0.5) * extent;
        let rounding = PLACE_ROUNDING * extent.max_element();
        let unlit = self.shaded(pixel, steps, [0.0; 3], &[]);
        Shaded { color: place.to_array(), rounding, turns: false, ..unlit }
    }

    /// The normal of a surface as it is shown: of length 1 and turned to the eye, or 0.
    fn shown_normal(&self, pixel: &Pixel, steps: f64) -> Shaded {
        let unlit = self.shaded(pixel, steps, [0.0; 3], &[]);
        let point = LitPoint { place: DVec3::ZERO, normal: unlit.normal, view: -pixel.direction };
        let normal = point.turned();
        // Seen from the side, f32 may turn it the other way.
        let beside = normal.is_some_and(|normal| normal.dot(point.view).abs() < 2.0 * unlit.angle + UNIT_ROUNDING);
        let (shown, rounding) = (normal.unwrap_or_default(), 2.0 * unlit.angle + UNIT_ROUNDING);
        Shaded { color: shown.to_array(), rounding, turns: unlit.turns || beside, ..unlit }
    }

    /// The surface that is met first between two places, one in front of it and one on it, or twice where the ray begins; the number
    /// of the surface. Undecided where f32 may find another surface.
    fn met(&self, pixel: &mut Pixel, [front, back]: [f64; 2]) -> (RoundedPlace, usize) {
        let (before, behind) = (self.value_at(pixel, front), self.value_at(pixel, back));
        let near = |bound: &f64| (before.value - bound).abs() < before.rounding;
        pixel.undecided |= self.surface_values.iter().flatten().any(near);
        let at = |steps: f64, rounding: f64| RoundedPlace { steps, rounding };
        let cut = self.cut_rounding(pixel) / self.voxels_in_step(pixel);
        if let Some(level) = on_surface(self.surface_values, before.value) {
            return (at(front, cut), level);
        }
        let Some((level, value)) = first_met(self.surface_values, before.value, behind.value) else {
            // No hit is stored without a surface.
            return (at(back, cut), 0);
        };
        let change = (behind.value - before.value).abs();
        let place = match self.scene.settings.surface.refine {
            Refine::None => at(back, cut),
            Refine::Linear => {
                let share = ((value - before.value) / (behind.value - before.value)).clamp(0.0, 1.0);
                let off = 2.0 * before.rounding.max(behind.rounding) / change;
                at(front + share * (back - front), off * (back - front) + cut)
            }
            Refine::Exact => self.root(pixel, [front, back], value, before.value < value),
        };
        (at(place.steps, place.rounding.min(back - front)), level)
    }

    /// The first place between two others at which the interpolant is not below a value, or not above it where it falls.
    fn root(&self, pixel: &Pixel, [front, back]: [f64; 2], value: f64, rises: bool) -> RoundedPlace {
        let (field, step) = (&self.scene.field, self.step_length());
        let entry = (pixel.entry - 0.5) * field.extent();
        let values = if rises { [value, f64::INFINITY] } else { [f64::NEG_INFINITY, value] };
        let integrator = ExactIntegrator::new(field, &self.scene.transfer);
        let begin = entry + front * step * pixel.direction;
        let found = integrator.first_within(begin, pixel.direction, (back - front) * step, &[values]);
        let steps = found.map_or(back, |found| front + found.t / step);
        let slope = found.map_or(0.0, |found| found.slope.abs() * step);
        let rounding = self.value_at(pixel, steps).rounding;
        let cut = self.cut_rounding(pixel) / self.voxels_in_step(pixel);
        RoundedPlace { steps, rounding: if slope > 0.0 { 2.0 * rounding / slope + cut } else { back - front } }
    }
}
