//! The values at which rays are on a surface.

use super::row::ValueSpan;
use crate::scene::Scene;
use crate::scene::texture::TextureMap;

/// Of each surface of a scene the values that are on it, by rising values, in the unit that `map` leads to: numbers of f32, so that
/// shaders know the same. They reach as far beyond those asked for as rounding may move a value, so that a voxel that has the very
/// value is on the surface.
pub fn surface_values(scene: &Scene, map: TextureMap) -> Vec<[f64; 2]> {
    let span = ValueSpan::of(&scene.field, map);
    // Beyond all numbers nothing is rounded.
    let slack = |value: f64| if value.is_finite() { span.slack(value) } else { 0.0 };
    let representable = |value: f64| f64::from(value.clamp(f32::MIN.into(), f32::MAX.into()) as f32);
    let levels = scene.surface.iter().flat_map(|surface| &surface.levels);
    levels
        .map(|level| {
            let [from, to] = level.values.map(|x| map.value(x));
            [representable(from - slack(from)), representable(to + slack(to))]
        })
        .collect()
}

/// Where the interpolant lies that is sought between two values: where a ray comes from outside of all surfaces, the value at which
/// it meets the first; and which one that is. None where `front` is on a surface itself.
pub fn first_met(values: &[[f64; 2]], front: f64, back: f64) -> Option<(usize, f64)> {
    if on_surface(values, front).is_some() {
        return None;
    }
    match front < back {
        true => values.iter().position(|[from, _]| *from > front).map(|at| (at, values[at][0])),
        // Ranges may reach into each other: the one that ends last is met first.
        false => values
            .iter()
            .enumerate()
            .filter(|(_, [_, to])| *to < front)
            .max_by(|(_, a), (_, b)| a[1].total_cmp(&b[1]))
            .map(|(at, [_, to])| (at, *to)),
    }
}

/// Within how many surfaces that are crossed a value is: those whose values it has reached.
pub fn surfaces_around(values: &[[f64; 2]], value: f64) -> usize {
    values.partition_point(|[from, _]| *from <= value)
}

/// The surface that a value is on; the last of several.
pub fn on_surface(values: &[[f64; 2]], value: f64) -> Option<usize> {
    values.iter().rposition(|[from, to]| *from <= value && value <= *to)
}
