//! Signals and thin structures: a Gaussian, a torus, the signal of Marschner and Lobb, shells, jets.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::{DVec2, DVec3};

use super::profile::{bump, bump_slope};

/// Standard deviation of the round Gaussian.
pub const GAUSSIAN_SIGMA: f64 = 0.3;

pub fn gaussian(p: DVec3) -> f64 {
    (-0.5 * p.length_squared() / GAUSSIAN_SIGMA.powi(2)).exp()
}

/// Radius of the ring in the plane y = 0 about which the torus lies, and the standard deviation of its value from there.
const RING_RADIUS: f64 = 0.55;
const RING_SIGMA: f64 = 0.14;

/// The way to a point from the nearest one of the ring. On the axis, where all of the ring is as near, it has no direction across.
fn from_ring(p: DVec3) -> DVec3 {
    let across = DVec3::new(p.x, 0.0, p.z);
    let outward = across.try_normalize().unwrap_or(DVec3::ZERO);
    (across.length() - RING_RADIUS) * outward + DVec3::new(0.0, p.y, 0.0)
}

/// Its iso-surfaces are tori, of a radius sigma sqrt(-2 ln v) for the value v.
pub fn torus(p: DVec3) -> f64 {
    let across = DVec2::new(p.x, p.z).length() - RING_RADIUS;
    (-0.5 * (across * across + p.y * p.y) / RING_SIGMA.powi(2)).exp()
}

pub fn torus_gradient(p: DVec3) -> DVec3 {
    -from_ring(p) / RING_SIGMA.powi(2) * torus(p)
}

/// Frequency f_M and amplitude alpha of the signal's ripple, as Marschner and Lobb (An Evaluation of
/// Reconstruction Filters for Volume Rendering, VIS 1994) chose them.
const ML_FREQUENCY: f64 = 6.0;
const ML_ALPHA: f64 = 0.25;

/// (1 - sin(pi z / 2) + alpha (1 + rho(r))) / (2 (1 + alpha)) with rho(r) = cos(2 pi f_M cos(pi r / 2)) and r the
/// distance from the z axis.
pub fn marschner_lobb(p: DVec3) -> f64 {
    let r = p.truncate().length();
    let ripple = (TAU * ML_FREQUENCY * (FRAC_PI_2 * r).cos()).cos();
    (1.0 - (FRAC_PI_2 * p.z).sin() + ML_ALPHA * (1.0 + ripple)) / (2.0 * (1.0 + ML_ALPHA))
}

pub fn marschner_lobb_gradient(p: DVec3) -> DVec3 {
    let r = p.truncate().length();
    let (sin, cos) = (FRAC_PI_2 * r).sin_cos();
    let slope = PI * PI * ML_FREQUENCY * sin * (TAU * ML_FREQUENCY * cos).sin();
    // The ripple is even in r, so its slope on the axis is 0.
    let across = p.truncate().try_normalize().unwrap_or(DVec2::ZERO) * (ML_ALPHA * slope);
    across.extend(-FRAC_PI_2 * (FRAC_PI_2 * p.z).cos()) / (2.0 * (1.0 + ML_ALPHA))
}

/// Radius and peak value of each shell: the brighter one lies inside the dimmer.
const SHELLS: [(f64, f64); 3] = [(0.3, 1.0), (0.55, 0.75), (0.8, 0.5)];
const SHELL_HALF_WIDTH: f64 = 0.07;

pub fn shells(p: DVec3) -> f64 {
    let r = p.length();
    SHELLS.iter().map(|(radius, peak)| peak * bump(((r - radius) / SHELL_HALF_WIDTH).powi(2))).sum()
}

pub fn shells_gradient(p: DVec3) -> DVec3 {
    let r = p.length();
    let slope = SHELLS.iter().map(|(radius, peak)| {
        let t = (r - radius) / SHELL_HALF_WIDTH;
        peak * bump_slope(t * t) * 2.0 * t / SHELL_HALF_WIDTH
    });
    p.try_normalize().unwrap_or(DVec3::ZERO) * slope.sum::<f64>()
}

const WINDING_JETS: usize = 5;
/// Turn of the winding jets along z, radians per unit.
const JET_TURN: f64 = 1.6;
/// Jets end at this |z|.
const JET_END: f64 = 0.9;

/// Centre of a jet at height z and its derivative: jet 0 is the axis, the others wind around it on a cone.
fn jet_centre(jet: usize, z: f64) -> (DVec2, DVec2) {
    if jet == 0 {
        return (DVec2::ZERO, DVec2::ZERO);
    }
    let (radius, opening) = (0.4 + 0.25 * z, 0.25);
    let outward = DVec2::from_angle(TAU * jet as f64 / WINDING_JETS as f64 + JET_TURN * z);
    (radius * outward, opening * outward + radius * JET_TURN * outward.perp())
}

/// Radius of every jet at height z and its derivative.
fn jet_radius(z: f64) -> (f64, f64) {
    (0.1 + 0.03 * z, 0.03)
}

/// The share of a jet's value left at height z and its derivative: whole in the middle, 0 at the ends.
fn jet_fade(z: f64) -> (f64, f64) {
    let u = z / JET_END;
    (bump(u.powi(4)), bump_slope(u.powi(4)) * 4.0 * u.powi(3) / JET_END)
}

/// Horizontal circles about each centre. Near the nozzle at -z the jets come close but do not overlap.
pub fn jets(p: DVec3) -> f64 {
    let (radius, _) = jet_radius(p.z);
    let across = |jet| bump((p.truncate() - jet_centre(jet, p.z).0).length_squared() / (radius * radius));
    (0..=WINDING_JETS).map(across).sum::<f64>() * jet_fade(p.z).0
}

pub fn jets_gradient(p: DVec3) -> DVec3 {
    let ((radius, widening), (fade, fading)) = (jet_radius(p.z), jet_fade(p.z));
    let one = |jet| {
        let (centre, leaning) = jet_centre(jet, p.z);
        let d = p.truncate() - centre;
        let s = d.length_squared() / (radius * radius);
        let s_across = 2.0 * d / (radius * radius);
        let s_along = -s_across.dot(leaning) - 2.0 * s * widening / radius;
        (bump_slope(s) * fade * s_across).extend(bump_slope(s) * fade * s_along + bump(s) * fading)
    };
    (0..=WINDING_JETS).map(one).sum()
}
