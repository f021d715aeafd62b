//! Twin of `glsl/shared/crossings.glsl`: surfaces that let something through, wherever a ray crosses them [Stegmaier05 §6].

use super::lighting::RoundedPlace;
use super::surface::RoundedValue;
use super::{Effect, Pixel, Twin};
use crate::projection::surfaces_around;
use crate::scene::settings::Refine;
use crate::truth::exact::ExactIntegrator;

/// A place where a ray crosses a surface, and the value that it has there.
struct Crossing {
    place: RoundedPlace,
    level: usize,
    value: f64,
}

impl Twin<'_> {
    /// All surfaces on the part of the ray that is drawn, in the order in which it crosses them, until it is saturated.
    pub(super) fn crossings_on_ray(&self, pixel: &mut Pixel) -> Effect {
        let (first, end) = self.samples_of_part(pixel);
        if first >= end {
            return Effect::Silent;
        }
        let before = pixel.accumulated;
        let begin = self.stretch_after(pixel, first)[0];
        let mut front = self.value_at(pixel, begin);
        let within = self.around(pixel, front);
        if pixel.section == 0 && within > 0 && !self.saturated(pixel) && self.is_kept(pixel, begin) {
            self.put_surface(pixel, self.as_placed(pixel, begin), within - 1);
        }
        let mut i = first;
        while i < end && !self.saturated(pixel) {
            let free = self.free_samples_from(pixel, i);
            if free > 0 {
                i += free;
                front = self.value_at(pixel, self.stretch_after(pixel, i.min(end - 1))[0]);
                continue;
            }
            let stretch = self.stretch_after(pixel, i);
            let back = self.value_at(pixel, stretch[1]);
            self.cross_step(pixel, i, stretch, [front, back]);
            front = back;
            i += 1;
        }
        if pixel.accumulated == before { Effect::Silent } else { Effect::Contributed }
    }

    /// Joins the step after sample `i` with what the pixel has: surfaces, and the volume in front of them, between and behind.
    fn cross_step(&self, pixel: &mut Pixel, i: u32, stretch: [f64; 2], [front, back]: [RoundedValue; 2]) {
        let mut from = (stretch[0], front.value);
        let shows = self.scene.surfaces_in_volume() && self.is_kept(pixel, self.steps_to(i));
        for crossing in self.crossings_kept(pixel, stretch, [front, back]) {
            if self.saturated(pixel) {
                return;
            }
            let to = (crossing.place.steps, crossing.value);
            if shows {
                self.show_between(pixel, i, from, to, crossing.place.rounding);
            }
            from = to;
            if self.saturated(pixel) {
                return;
            }
            self.put_surface(pixel, crossing.place, crossing.level);
        }
        if shows && !self.saturated(pixel) {
            self.show_between(pixel, i, from, (stretch[1], back.value), 0.0);
        }
    }

    /// Puts the volume between two places of a step, each with its value, under what the pixel has.
    fn show_between(&self, pixel: &mut Pixel, i: u32, from: (f64, f64), to: (f64, f64), rounding: f64) {
        let part = self.shade_part(pixel, i, (to.0 - from.0).max(0.0), [from.1, to.1]);
        let whole = self.shade_part(pixel, i, 1.0, [from.1, to.1]);
        // A surface that is found elsewhere cuts the step elsewhere.
        pixel.rounding += 2.0 * rounding.min(1.0) * whole[3];
        pixel.accumulated = self.projection.blend.apply(pixel.accumulated, part);
    }

    /// Within how many surfaces a value is; undecided where f32 may find others.
    fn around(&self, pixel: &mut Pixel, sample: RoundedValue) -> usize {
        pixel.undecided |= self.surface_values.iter().any(|[from, _]| (sample.value - from).abs() < sample.rounding);
        surfaces_around(self.surface_values, sample.value)
    }

    /// The surfaces that are crossed on what is kept of a stretch, in their order, behind the innermost that the ray comes into it within.
    fn crossings_kept(&self, pixel: &mut Pixel, stretch: [f64; 2], [front, back]: [RoundedValue; 2]) -> Vec<Crossing> {
        let Some(part) = self.kept_part(pixel, stretch) else { return Vec::new() };
        let [begin, end] = part.between;
        if !part.enters {
            let cut = end < stretch[1];
            let back = if cut { self.value_beside_cut(pixel, end, part.rounding) } else { back };
            return self.crossings_between(pixel, part.between, [front, back]);
        }
        let front = self.value_beside_cut(pixel, begin, part.rounding);
        let within = self.around(pixel, front);
        let mut crossings = Vec::new();
        if within > 0 {
            let place = RoundedPlace { steps: begin, rounding: part.rounding + self.as_placed(pixel, begin).rounding };
            crossings.push(Crossing { place, level: within - 1, value: front.value });
        }
        crossings.extend(self.crossings_between(pixel, part.between, [front, back]));
        crossings
    }

    /// The surfaces that are crossed on a stretch, in their order.
    fn crossings_between(&self, pixel: &mut Pixel, stretch: [f64; 2], values: [RoundedValue; 2]) -> Vec<Crossing> {
        let [within, to] = values.map(|value| self.around(pixel, value));
        if self.scene.settings.surface.refine == Refine::Exact {
            return self.roots(pixel, stretch, [within, to]);
        }
        let [front, back] = values;
        let share = |level: usize| match self.scene.settings.surface.refine {
            Refine::None => 1.0,
            _ => ((self.surface_values[level][0] - front.value) / (back.value - front.value)).clamp(0.0, 1.0),
        };
        let off = match self.scene.settings.surface.refine {
            Refine::None => 0.0,
            _ => 2.0 * front.rounding.max(back.rounding) / (back.value - front.value).abs(),
        };
        let length = stretch[1] - stretch[0];
        let rounding = (off * length).min(length) + self.as_placed(pixel, stretch[1]).rounding;
        let at = |level: usize| RoundedPlace { steps: stretch[0] + share(level) * length, rounding };
        let value = |level: usize| match self.scene.settings.surface.refine {
            Refine::None => back.value,
            _ => self.surface_values[level][0],
        };
        let crossing = |level: usize| Crossing { place: at(level), level, value: value(level) };
        if to >= within { (within..to).map(crossing).collect() } else { (to..within).rev().map(crossing).collect() }
    }

    /// The roots of the interpolant on a stretch, from within so many surfaces to within others.
    fn roots(&self, pixel: &mut Pixel, [front, back]: [f64; 2], [within, to]: [usize; 2]) -> Vec<Crossing> {
        let (field, step) = (&self.scene.field, self.step_length());
        let begin = (pixel.entry - 0.5) * field.extent() + front * step * pixel.direction;
        let levels: Vec<f64> = self.surface_values.iter().map(|[from, _]| *from).collect();
        let integrator = ExactIntegrator::new(field, &self.scene.transfer);
        let (direction, length) = (pixel.direction, (back - front) * step);
        let cut = self.as_placed(pixel, front).rounding;
        let rounding = self.value_at(pixel, 0.5 * (front + back)).rounding;
        // Where a value that is off by its rounding is crossed another number of times, f32 may cross it so often too.
        let times = |by: f64| {
            let moved: Vec<f64> = levels.iter().map(|level| level + by).collect();
            integrator.crossings(begin, direction, length, &moved).len()
        };
        let found = integrator.crossings(begin, direction, length, &levels);
        pixel.undecided |= [-rounding, rounding].into_iter().any(|by| times(by) != found.len());
        let mut at = within;
        let mut crossings = Vec::new();
        for crossing in found {
            let slope = crossing.slope.abs() * step;
            let off = if slope > 0.0 { 2.0 * rounding / slope + cut } else { back - front };
            let place = RoundedPlace { steps: front + crossing.t / step, rounding: off.min(back - front) };
            at = if crossing.rises { crossing.level + 1 } else { crossing.level };
            crossings.push(Crossing { place, level: crossing.level, value: levels[crossing.level] });
        }
        // What the interpolant and the value at the end of the step see differently, f32 cannot decide either.
        pixel.undecided |= at != to;
        crossings
    }
}
