//! Where a ray first has one of some values: the root of the cubic in its cell.

use glam::DVec3;

use super::ExactIntegrator;
use super::cubic::Cubic;
use crate::projection::on_surface;

/// A place at which a ray first has one of some values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FirstPlace {
    /// Volume units from the begin of the ray.
    pub t: f64,
    /// Which of the ranges of values it comes into.
    pub range: usize,
    /// The change of the value over a volume unit there.
    pub slope: f64,
    /// The gradient of the interpolant, volume space; that of the cell that the ray comes into.
    pub gradient: DVec3,
}

impl ExactIntegrator<'_> {
    /// The first place of `entry + t * direction`, t from 0 to `length`, at which the value is in one of `ranges`, closed and rising by
    /// their begins. Lengths are in volume units, `direction` has length 1.
    pub fn first_within(&self, entry: DVec3, direction: DVec3, length: f64, ranges: &[[f64; 2]]) -> Option<FirstPlace> {
        let voxel = self.field.voxel();
        let line = self.line(entry, direction);
        let mut bounds: Vec<f64> = ranges.iter().flatten().copied().filter(|bound| bound.is_finite()).collect();
        bounds.sort_by(f64::total_cmp);
        bounds.dedup();
        let cuts = self.plane_cuts(&line, length);
        let mut inside = Vec::new();
        for (a, b) in cuts.windows(2).map(|pair| (pair[0], pair[1])).filter(|(a, b)| a < b) {
            let Some(cell) = self.cell(&line, a, b) else { continue };
            let cubic = cell.cubic();
            inside.clear();
            cubic.cut(&bounds, &mut inside);
            if let Some((s, range)) = first_in(&cubic, &inside, ranges) {
                let slope = cubic.slope(s) / (b - a);
                return Some(FirstPlace { t: a + s * (b - a), range, slope, gradient: cell.gradient(s) / voxel });
            }
        }
        None
    }
}

/// The first parameter of a cell at which the value is in one of the ranges, given where it turns or crosses a bound.
fn first_in(cubic: &Cubic, cuts: &[f64], ranges: &[[f64; 2]]) -> Option<(f64, usize)> {
    let within = |s: f64| on_surface(ranges, cubic.at(s));
    // Between cuts it is within or not as a whole, and as in the middle.
    cuts.windows(2)
        .filter(|pair| pair[0] < pair[1])
        .find_map(|pair| Some((pair[0], within(0.5 * (pair[0] + pair[1]))?)))
}
