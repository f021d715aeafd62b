//! Twin of `glsl/shared/light_path.glsl`: what becomes of light on its way to a place of a surface [Stegmaier05 §6].

use glam::DVec3;

use super::Twin;
use super::surface::RoundedValue;
use crate::math::interpolate::{nearest, trilinear};
use crate::projection::surfaces_around;
use crate::scene::light::{Arriving, Light, LitPoint};
use crate::scene::settings::Filter;

/// What f32 takes from a point between a surface and a light, in parts of the volume's longest side.
const POINT_ROUNDING: f64 = 1e-6;

/// Light that arrives, and what f32 may find instead.
pub(super) struct RoundedArriving {
    pub arriving: Arriving,
    /// Whether f32 may find another shadow.
    pub unsure: bool,
    /// How far it may be off in what comes through.
    pub rounding: f64,
}

impl Twin<'_> {
    /// What arrives at a point of a light, by all that stands in its way.
    pub(super) fn arriving(&self, light: &Light, point: &LitPoint) -> RoundedArriving {
        let mut all = RoundedArriving { arriving: Arriving::WHOLE, unsure: false, rounding: 0.0 };
        let Some(way) = light.from(point.place) else { return all };
        let reach = light.distance(point.place);
        if let (Some(bias), Some(normal)) = (self.scene.shadow_bias(), point.turned())
            && normal.dot(way) > 0.0
        {
            (all.arriving.clear, all.unsure) = self.clear_to_light(point.place + bias * normal, way, reach);
        }
        if let Some(translucency) = self.scene.translucency() {
            let (inside, off) = self.inside_to_light(point.place, way, reach);
            all.arriving.through = (-translucency.absorption * inside).exp();
            // Devices take some more from an exponential of a large number.
            const EXPONENT_ROUNDING: f64 = 1e-6;
            let exponent = translucency.absorption * (off + EXPONENT_ROUNDING * inside);
            all.rounding = translucency.part * all.arriving.through * exponent.exp_m1();
        }
        all
    }

    /// The value at a point of volume space.
    fn value_at_point(&self, point: DVec3) -> RoundedValue {
        let field = &self.scene.field;
        let voxel = self.voxel(point / field.extent() + 0.5);
        let off = POINT_ROUNDING / field.voxel().min_element();
        if self.scene.settings.sampling.filter == Filter::Nearest {
            let value = nearest(&field.values, field.dims(), voxel);
            let unsure = self.nearest_undecided(voxel, value, off);
            let rounding = if unsure { f64::INFINITY } else { self.value_rounding(value, voxel, 0.0) };
            return RoundedValue { value, rounding };
        }
        let value = trilinear(&field.values, field.dims(), voxel);
        RoundedValue { value, rounding: self.value_rounding(value, voxel, off) }
    }

    /// Places a step apart from the begin to the end of a way of that length, without the begin.
    fn places_on(&self, length: f64) -> impl Iterator<Item = f64> + use<> {
        let step = self.step_length();
        let whole = (length / step).ceil().max(0.0) as u64;
        (1..=whole).map(move |n| (n as f64 * step).min(length))
    }

    /// What surfaces leave of light on a way, and whether f32 may find another number of them.
    fn clear_to_light(&self, begin: DVec3, way: DVec3, reach: f64) -> (f64, bool) {
        let levels = self.scene.surface.iter().flat_map(|surface| &surface.levels);
        let opacities: Vec<f64> = levels.map(|level| level.opacity).collect();
        // By values as they are, and by the least and the greatest that f32 may find: where rounding moves a crossing from one step to
        // the next, it is still one.
        let around = |at: f64| {
            let sample = self.value_at_point(begin + at * way);
            [0.0, -sample.rounding, sample.rounding].map(|by| surfaces_around(self.surface_values, sample.value + by))
        };
        let (mut within, mut clear) = (around(0.0), [1.0; 3]);
        for at in self.places_on(self.scene.way_out(begin, way, reach)) {
            let to = around(at);
            for (clear, (from, to)) in clear.iter_mut().zip(within.into_iter().zip(to)) {
                *clear *= opacities[from.min(to)..from.max(to)].iter().map(|opacity| 1.0 - opacity).product::<f64>();
            }
            within = to;
        }
        let [clear, least, greatest] = clear;
        (clear, least != clear || greatest != clear)
    }

    /// How far light goes within the outermost surface on a way, in volume units, and how far f32 may be off.
    fn inside_to_light(&self, begin: DVec3, way: DVec3, reach: f64) -> (f64, f64) {
        let [level, _] = self.surface_values[0];
        let (mut inside, mut off, mut from) = (0.0, 0.0, 0.0);
        let mut front = self.value_at_point(begin);
        for at in self.places_on(self.scene.way_out(begin, way, reach)) {
            let back = self.value_at_point(begin + at * way);
            let (a, b) = (front.value - level, back.value - level);
            let part = match (a >= 0.0, b >= 0.0) {
                (true, true) => 1.0,
                (false, false) => 0.0,
                (true, false) => a / (a - b),
                (false, true) => b / (b - a),
            };
            inside += (at - from) * part;
            // A way that crosses the surface, or hardly does, crosses it elsewhere.
            let rounding = front.rounding.max(back.rounding);
            if a.abs().min(b.abs()) < rounding || (a >= 0.0) != (b >= 0.0) {
                off += (at - from) * (2.0 * rounding / (b - a).abs()).min(1.0);
            }
            (front, from) = (back, at);
        }
        (inside, off)
    }
}
