//! Where a ray crosses some values: the roots of the cubics in its cells.

use glam::DVec3;

use super::ExactIntegrator;

/// A place at which a ray crosses a value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// Volume units from the begin of the ray.
    pub t: f64,
    /// Which of the values.
    pub level: usize,
    /// Whether it comes to be at least that; else it comes to be less.
    pub rises: bool,
    /// The change of the value over a volume unit there.
    pub slope: f64,
    /// The gradient of the interpolant, volume space; that of the cell that the ray comes into.
    pub gradient: DVec3,
}

impl ExactIntegrator<'_> {
    /// Every place of `entry + t * direction`, t from 0 to `length`, at which the value comes to be at least one of the rising `levels`,
    /// or less than it, in their order; a value that is only touched is not crossed. Lengths are in volume units, `direction` has length 1.
    pub fn crossings(&self, entry: DVec3, direction: DVec3, length: f64, levels: &[f64]) -> Vec<Crossing> {
        let voxel = self.field.voxel();
        let line = self.line(entry, direction);
        let cuts = self.plane_cuts(&line, length);
        let (mut within, mut inside) = (None, Vec::new());
        let mut crossings = Vec::new();
        for (a, b) in cuts.windows(2).map(|pair| (pair[0], pair[1])).filter(|(a, b)| a < b) {
            let Some(cell) = self.cell(&line, a, b) else { continue };
            let cubic = cell.cubic();
            inside.clear();
            cubic.cut(levels, &mut inside);
            for pair in inside.windows(2).filter(|pair| pair[0] < pair[1]) {
                // Between cuts no value is crossed.
                let value = cubic.at(0.5 * (pair[0] + pair[1]));
                let around = levels.partition_point(|level| *level <= value);
                let s = pair[0];
                let crossing = |level: usize, rises: bool| Crossing {
                    t: a + s * (b - a),
                    level,
                    rises,
                    slope: cubic.slope(s) / (b - a),
                    gradient: cell.gradient(s) / voxel,
                };
                let before = within.replace(around).unwrap_or(around);
                crossings.extend((before..around).map(|level| crossing(level, true)));
                crossings.extend((around..before).rev().map(|level| crossing(level, false)));
            }
        }
        crossings
    }
}
