//! How far a picture may be from that of exact interpolation: a bound from the error of x.
//!
//! Two rays whose samples differ by a little differ by what each sample adds, seen through what lies in front of it. With
//! c the colours, a the opacities of one ray and c', a' those of the other, what lies behind a sample in B:
//! |difference| <= sum of T |c a - c' a' - (a - a') B| <= sum of T (brightest |a - a'| + a' |c - c'|), where T, the light
//! that comes through, is at most 1 and T a' adds up to at most 1.
//!
//! Where a projection shows values, its row says what a difference in every sample becomes.

use std::sync::Arc;

use crate::projection::{self, OfValues};
use crate::scene::gathered::Gathered;
use crate::scene::settings::{Alpha, Last, Shows};
use crate::scene::transfer::Knot;
use crate::scene::{Environment, Scene, Surface};
use crate::twin::fused::blend_rounding;

/// What f32 takes from a sum by each sample.
const SAMPLE_ROUNDING: f64 = 1e-6;

/// A bound of the difference of a channel, premultiplied and linear, between the picture of rays that gather no more than `gathered`
/// and whose x is off by at most `error`, and that of exact interpolation. `ends`: rays may end early.
pub fn pixel_error(scene: &Scene, error: f64, gathered: &Gathered, ends: bool) -> f64 {
    if let Some(values) = &projection::of(&scene.settings).values {
        return value_error(scene, values, error, gathered);
    }
    if scene.effect.is_some() || scene.settings.effects.refraction.is_some() {
        // Nobody knows what an effect, or a ray that bends elsewhere, makes of a difference.
        return if error == 0.0 { 0.0 } else { f64::INFINITY };
    }
    if scene.surface.is_some() || !scene.lights.is_empty() {
        // A ray that misses a surface by a little has none of its colour, and where values hardly change a gradient may point
        // anywhere.
        return if error == 0.0 { 0.0 } else { largest_shown(scene) };
    }
    let sampling = &scene.settings.sampling;
    let brightest = scene.transfer.knots().iter().flat_map(|k| k.color).fold(1.0, f64::max);
    if error == 0.0 || !error.is_finite() {
        return if error == 0.0 { 0.0 } else { brightest };
    }
    let opacity = corrected(scene, change(scene, error, |knot| knot.opacity), gathered);
    let color = (0..3).map(|c| change(scene, error, |knot| knot.color[c])).fold(0.0, f64::max);
    // One ray may end a pass before the other.
    let ended = if ends { 1.0 - sampling.termination } else { 0.0 };
    // A sample on a slice may stand for several steps.
    let parts = match sampling.alpha {
        Alpha::Exponential => gathered.samples.max(gathered.steps - 1.0),
        Alpha::Paper => gathered.samples,
    };
    (brightest * (parts * opacity + ended) + color + brightest * rounding(scene, gathered)).min(brightest)
}

/// The most by which two pixels of a surface or of lit samples may differ.
fn largest_shown(scene: &Scene) -> f64 {
    match (&scene.surface, scene.settings.surface.shows) {
        (Some(_), Shows::Position) => scene.field.extent().max_element().max(1.0),
        // Two opposite ones.
        (Some(_), Shows::Normal) => 2.0,
        _ => brightest_lit(scene),
    }
}

/// The brightest that a surface or a sample of a scene with lights may be, or its opacity.
fn brightest_lit(scene: &Scene) -> f64 {
    let samples = || scene.transfer.knots().iter().map(|knot| knot.color).collect();
    let surfaces = |surface: &Surface| surface.levels.iter().map(|level| level.color).collect();
    let colors: Vec<[f64; 3]> = scene.surface.as_ref().map_or_else(samples, surfaces);
    let lights = scene.shining();
    let channel = |color: &[f64; 3], c: usize| -> f64 {
        lights.iter().map(|light| color[c] * (light.ambient[c] + light.diffuse[c]) + light.specular[c]).sum()
    };
    let lit = colors.iter().flat_map(|color| (0..3).map(|c| channel(color, c))).fold(1.0, f64::max);
    let reflecting = |environment: &Arc<Environment>| {
        let part = environment.reflectivity;
        ((1.0 - part) * lit + part * environment.picture.brightest()).max(1.0)
    };
    scene.environment.as_ref().map_or(lit, reflecting)
}

/// What samples and blending of both pictures take from a sum about 1.
fn rounding(scene: &Scene, gathered: &Gathered) -> f64 {
    let blended = 2.0 * gathered.blends * f64::from(blend_rounding(scene.settings.image.accumulate));
    gathered.samples * SAMPLE_ROUNDING + blended
}

/// The same where values are shown: each sample is off by the error, and what is summed up is rounded.
fn value_error(scene: &Scene, values: &OfValues, error: f64, gathered: &Gathered) -> f64 {
    if error == 0.0 {
        return 0.0;
    }
    let lengths = gathered.steps * scene.settings.step() / scene.transfer.reference;
    let [low, high] = scene.field.extremes().map(|x| f64::from(x).abs());
    (values.magnification)(lengths) * (error + low.max(high) * rounding(scene, gathered))
}

/// The most that a part of the transfer function changes over so much of x, among the values there are.
fn change(scene: &Scene, error: f64, of: impl Fn(&Knot) -> f64) -> f64 {
    let [low, high] = scene.field.extremes().map(f64::from);
    let met = |pair: &&[Knot]| pair[0].x <= high + error && low - error <= pair[1].x;
    let pairs = || scene.transfer.knots().windows(2).filter(met);
    let rise = |pair: &[Knot]| (of(&pair[1]) - of(&pair[0])).abs();
    let steepest = pairs().filter(|pair| pair[0].x < pair[1].x).map(|pair| rise(pair) / (pair[1].x - pair[0].x));
    let jumps: f64 = pairs().filter(|pair| pair[0].x == pair[1].x).map(rise).sum();
    let all: f64 = pairs().map(rise).sum();
    (steepest.fold(0.0, f64::max) * error + jumps).min(all)
}

/// What a change of the opacity for the reference length is for a sample.
fn corrected(scene: &Scene, change: f64, gathered: &Gathered) -> f64 {
    let sampling = &scene.settings.sampling;
    if sampling.alpha == Alpha::Paper || change == 0.0 {
        return change.min(1.0);
    }
    let exponent = scene.settings.step() / scene.transfer.reference;
    let least_clear = 1.0 - scene.transfer.knots().iter().map(|k| k.opacity).fold(0.0, f64::max);
    // The steepest rise of 1 - (1 - a)^t over a, for every exponent t up to that of a whole step.
    let shorter = change * exponent.max(1.0) / least_clear;
    let whole = match exponent {
        exponent if exponent >= 1.0 => exponent * change,
        exponent => change.powf(exponent).min(exponent * least_clear.powf(exponent - 1.0) * change),
    };
    let shorter_than_steps = gathered.samples > gathered.steps;
    let any_length = scene.last() == Last::Partial || sampling.preintegrates() || shorter_than_steps;
    (if any_length { whole.max(shorter) } else { whole }).min(1.0)
}
