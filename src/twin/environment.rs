//! Twin of `glsl/shared/environment.glsl`, whose formula is that of [`Environment::on`]: with the normal that the shader takes, and
//! how far f32 may be off.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use super::phong::Shaded;
use super::{Pixel, Twin};
use crate::scene::Environment;
use crate::scene::settings::Mapping;

/// What f32 takes from the direction that is reflected and from its place in the picture, as an angle.
const DIRECTION_ROUNDING: f64 = 3e-6;

/// What f32 takes from a colour by mixing texels, and by mixing it with another colour: relative.
const MIX_ROUNDING: f64 = 1e-6;

/// A place that may be so many texels elsewhere may have any colour.
const FAR: f64 = 8.0;

impl Twin<'_> {
    /// A lit colour with what the surface reflects, where the scene has an environment. Whether the normal points to the eye or away
    /// does not matter to it.
    pub(super) fn reflecting(&self, pixel: &Pixel, shaded: Shaded) -> Shaded {
        let Some(environment) = &self.scene.environment else { return shaded };
        let (view, part) = (-pixel.direction, environment.reflectivity);
        let color = environment.on(shaded.color, shaded.normal, view);
        // A normal that is off by an angle reflects what lies twice that away.
        let reach = 2.0 * shaded.angle + DIRECTION_ROUNDING;
        let reflected = environment.reflected(shaded.normal, view);
        let off = reflected.map_or(0.0, |direction| rounding(environment, direction, reach));
        let brightest = color.into_iter().fold(0.0, f64::max);
        let rounding = (1.0 - part) * shaded.rounding + part * off + MIX_ROUNDING * brightest;
        Shaded { color, rounding, ..shaded }
    }
}

/// How far a colour of the environment may be off where its direction is, by that angle: as many texels as its place moves, each
/// time the largest difference of texels beside each other that are within reach.
fn rounding(environment: &Environment, direction: DVec3, angle: f64) -> f64 {
    let size = environment.picture.size.map(|n| n as f64);
    let reach = match environment.mapping {
        Mapping::Latlong => {
            // The nearer to a pole, the more columns are passed.
            let ring = (direction.x.hypot(direction.z) - angle).max(0.0);
            [angle / ring * size[0] / TAU, angle * size[1] / PI]
        }
        Mapping::Sphere => {
            // The cosine of half the angle from +z: at the rim all is behind the ball.
            let half = ((0.5 + 0.5 * direction.z).max(0.0).sqrt() - 0.5 * angle).max(0.0);
            size.map(|n| 0.25 * angle / half * n)
        }
    };
    if !reach.iter().all(|texels| *texels <= FAR) {
        return f64::MAX;
    }
    let place = environment.place(direction);
    let first: [i64; 2] = std::array::from_fn(|axis| (place[axis] - reach[axis]).floor() as i64);
    let last: [i64; 2] = std::array::from_fn(|axis| (place[axis] + reach[axis]).floor() as i64 + 1);
    let mut steepest = [0.0f64; 2];
    for row in first[1]..=last[1] {
        for column in first[0]..=last[0] {
            let here = environment.texel(column, row);
            let beside =
                [(column < last[0]).then_some([column + 1, row]), (row < last[1]).then_some([column, row + 1])];
            for (steepest, at) in steepest.iter_mut().zip(beside) {
                let Some([column, row]) = at else { continue };
                let other = environment.texel(column, row);
                *steepest = (0..3).map(|c| (other[c] - here[c]).abs()).fold(*steepest, f64::max);
            }
        }
    }
    reach[0] * steepest[0] + reach[1] * steepest[1]
}
