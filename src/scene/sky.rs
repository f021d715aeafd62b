//! A sky that surfaces reflect where nothing else is around them.

use glam::DVec3;

/// Linear colours of the sky above and at the horizon, and of the ground there and below.
const ZENITH: [f64; 3] = [0.1, 0.25, 0.65];
const HORIZON: [f64; 3] = [0.75, 0.85, 0.95];
const FAR_GROUND: [f64; 3] = [0.4, 0.36, 0.3];
const NADIR: [f64; 3] = [0.12, 0.1, 0.08];

/// Half of the height, as a sine, over which ground becomes sky.
const HAZE: f64 = 0.04;

/// Where the sun stands, its colour, and how fast its light fades about it: by e at the cosine 1 - 1 / [`SUN_FALL`].
const SUN: DVec3 = DVec3::new(0.48, 0.64, 0.6);
const SUN_COLOR: [f64; 3] = [3.0, 2.7, 2.2];
const SUN_FALL: f64 = 150.0;

/// The linear colour of the sky in a direction of volume space, of length 1; up is +y.
pub fn sky(direction: DVec3) -> [f64; 3] {
    let mix = |a: [f64; 3], b: [f64; 3], w: f64| -> [f64; 3] { std::array::from_fn(|c| a[c] + w * (b[c] - a[c])) };
    let up = direction.y;
    // Square roots would have an edge at the horizon: what fades has a slope everywhere.
    let fading = |height: f64| 1.0 - (1.0 - height.clamp(0.0, 1.0)).powi(3);
    let above = mix(HORIZON, ZENITH, fading(up));
    let below = mix(FAR_GROUND, NADIR, fading(-up));
    let t = (0.5 + 0.5 * up / HAZE).clamp(0.0, 1.0);
    let clear = t * t * (3.0 - 2.0 * t);
    let base = mix(below, above, clear);
    let sun = clear * (SUN_FALL * (direction.dot(SUN) - 1.0)).exp();
    std::array::from_fn(|c| base[c] + sun * SUN_COLOR[c])
}
