//! Twin of `glsl/shared/phong.glsl`, whose formula is [`crate::scene::light::lit_by`]: with the gradient that the shader takes, and how far
//! f32 may be off.

use glam::DVec3;

use super::{Pixel, Twin};
use crate::scene::light::{Light, LightPlace, LitPoint, lit_by};

/// What f32 takes from a colour by a few products, and devices from an exponential: relative.
const COLOR_ROUNDING: f64 = 1e-5;

/// What f32 takes from a cosine of two vectors that are made of length 1.
const COSINE_ROUNDING: f64 = 3e-7;

/// What devices take from a power near 1 by their exponential.
const POWER_ROUNDING: f64 = 4e-6;

/// What f32 takes from a place on a ray, in parts of the volume's longest side.
pub(super) const PLACE_ROUNDING: f64 = 5e-7;

/// A lit colour, and how far f32 may be off at the very place unless it turns.
pub(super) struct Shaded {
    pub color: [f64; 3],
    pub rounding: f64,
    /// Along the gradient, volume space.
    pub normal: DVec3,
    /// How far f32 may turn the normal, in radians.
    pub angle: f64,
    /// Whether f32 may turn the normal the other way, or away from a light, so that the colour is another one.
    pub turns: bool,
}

fn brightest_of(color: [f64; 3]) -> f64 {
    color.into_iter().fold(0.0, f64::max)
}

impl Twin<'_> {
    /// The colour of a surface, or of a sample, `steps` from the entry point, of that colour in no light.
    pub(super) fn shaded(&self, pixel: &Pixel, steps: f64, color: [f64; 3], lights: &[Light]) -> Shaded {
        let (field, position) = (&self.scene.field, self.position_at(pixel, steps));
        let voxel = self.voxel(position);
        let (normal, off) = self.gradient_at(voxel);
        let point = LitPoint { place: (position - 0.5) * field.extent(), normal, view: -pixel.direction };
        // How far the normal may be off, as an angle; one of no length at all has none.
        let angle = if normal == DVec3::ZERO { 0.0 } else { off.length() / normal.length() };
        let mut shaded = self.shaded_point(&point, angle, color, lights);
        shaded.turns |= normal == DVec3::ZERO && off.max_element() > 0.0 && !self.is_flat(voxel);
        shaded
    }

    /// The same of a point whose normal may be off by an angle.
    pub(super) fn shaded_point(&self, point: &LitPoint, angle: f64, color: [f64; 3], lights: &[Light]) -> Shaded {
        let normal = point.normal;
        let (mut unsure, mut less) = (false, 0.0);
        let through = self.scene.translucency().map_or(0.0, |translucency| translucency.part);
        let shaded = lit_by(color, lights, point, through, |light| {
            let found = self.arriving(light, point);
            unsure |= found.unsure;
            less += found.rounding * brightest_of(std::array::from_fn(|c| color[c] * light.diffuse[c]));
            found.arriving
        });
        let mut turns = unsure;
        let mut rounding: f64 = less;
        for light in lights {
            let shown = brightest_of(std::array::from_fn(|c| color[c] * light.diffuse[c]));
            // The way to a light nearby is off by what the place is.
            let near = match light.place {
                LightPlace::Position(at) => PLACE_ROUNDING / at.distance(point.place).max(f64::MIN_POSITIVE),
                LightPlace::Direction(_) => 0.0,
            };
            let angle = angle + near;
            // The steepest slope of cos(x)^n is below the root of n.
            let steepest = light.shininess.sqrt().max(1.0);
            let specular = steepest * angle + light.shininess * COSINE_ROUNDING + POWER_ROUNDING;
            rounding += angle.min(2.0) * shown + brightest_of(light.specular) * specular.min(1.0);
            turns |= normal != DVec3::ZERO && angle > 0.0 && self.turns(light, point, angle);
        }
        let brightest = brightest_of(shaded);
        Shaded { color: shaded, rounding: 2.0 * rounding + COLOR_ROUNDING * brightest, normal, angle, turns }
    }

    /// Whether a normal that is off by that angle may be turned the other way, or away from the light.
    fn turns(&self, light: &Light, point: &LitPoint, angle: f64) -> bool {
        let normal = point.normal.normalize_or_zero();
        let reach = 2.0 * angle + COLOR_ROUNDING;
        let sides = [Some(point.view), light.from(point.place)];
        let beside = sides.into_iter().flatten().any(|way| normal.dot(way).abs() < reach);
        // A light in the point itself may be on any side of it.
        let near = matches!(light.place, LightPlace::Position(at) if at.distance(point.place) < COLOR_ROUNDING);
        beside || near
    }

    /// Whether the field does not change about a place, so that differences are 0 in f32 too.
    fn is_flat(&self, voxel: DVec3) -> bool {
        let field = &self.scene.field;
        let near = |by: f64| field.cell_at(voxel + by);
        let cells = [near(-1.0), near(0.0), near(1.0)];
        let mut values = cells.into_iter().flat_map(|cell| field.corners(cell)).map(|corner| field.values[corner]);
        let first = values.next();
        values.all(|value| Some(value) == first)
    }
}
