//! A head: skin with a nose, a skull with sockets, a brain with folds and ventricles.

use std::f64::consts::TAU;

use glam::DVec3;

use super::profile::{Local, ellipsoid};

/// Part of the half axes over which each surface rises.
const RISE: f64 = 0.05;

/// Half axes of the head; it looks along +z and +y is up.
const HEAD: DVec3 = DVec3::new(0.64, 0.84, 0.74);

/// Surfaces of the nested ellipsoids, as parts of the head's half axes.
const SKIN_INSIDE: f64 = 0.94;
const SKULL: [f64; 2] = [0.87, 0.76];
const BRAIN: f64 = 0.7;

const SKIN_DENSITY: f64 = 0.35;
const SKULL_DENSITY: f64 = 1.0;
const BRAIN_DENSITY: f64 = 0.55;

/// Folds of the brain: how much of its density they take, and how many fit into a unit.
const FOLDS: [f64; 2] = [0.3, 2.5];

const NOSE: [DVec3; 2] = [DVec3::new(0.0, -0.08, 0.72), DVec3::new(0.1, 0.16, 0.16)];
/// Centre of the socket at +x, and its half axes; the other one stands at -x.
const SOCKET: [DVec3; 2] = [DVec3::new(0.22, 0.08, 0.58), DVec3::new(0.15, 0.13, 0.15)];
/// As [`SOCKET`], of a ventricle.
const VENTRICLE: [DVec3; 2] = [DVec3::new(0.12, 0.08, 0.0), DVec3::new(0.07, 0.16, 0.26)];

/// The head at p.
pub fn head(p: DVec3) -> Local {
    let nested = |part: f64| ellipsoid(p, DVec3::ZERO, part * HEAD, RISE);
    let [nose, sockets, ventricles] =
        [ellipsoid(p, NOSE[0], NOSE[1], 4.0 * RISE), pair(p, SOCKET, 4.0 * RISE), pair(p, VENTRICLE, 4.0 * RISE)];
    let skin = nested(1.0).or(nose) * nested(SKIN_INSIDE).outside();
    let skull = nested(SKULL[0]) * nested(SKULL[1]).outside() * sockets.outside();
    let brain = nested(BRAIN) * ventricles.outside() * folds(p);
    // The skull takes the place of what it overlaps.
    SKULL_DENSITY * skull + SKIN_DENSITY * (skin * skull.outside()) + BRAIN_DENSITY * (brain * skull.outside())
}

/// An ellipsoid at +x and its mirror image at -x.
fn pair(p: DVec3, [centre, half]: [DVec3; 2], rise: f64) -> Local {
    let mirrored = centre * DVec3::new(-1.0, 1.0, 1.0);
    ellipsoid(p, centre, half, rise).or(ellipsoid(p, mirrored, half, rise))
}

/// From 1 - [`FOLDS`] to 1: a product of sines.
fn folds(p: DVec3) -> Local {
    let [depth, frequency] = FOLDS;
    let along = |axis: DVec3| {
        let (sin, cos) = (TAU * frequency * p.dot(axis)).sin_cos();
        Local { value: sin, gradient: TAU * frequency * cos * axis }
    };
    let waves = along(DVec3::X) * along(DVec3::Y) * along(DVec3::Z);
    // Waves lie from -1 to 1.
    let middle = Local { value: 1.0 - 0.5 * depth, gradient: DVec3::ZERO };
    middle + 0.5 * depth * waves
}
