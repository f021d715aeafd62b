//! Error against time and against the step, both logarithmic.

use super::{Accuracy, Curve, Point};
use crate::error::Result;
use crate::report::plot::curves::{Axis, Series, curves_svg};

/// Error against the time of a frame, one curve a method; whiskers from the least to the greatest time, rings around what
/// no other picture beats.
///
/// # Errors
/// When the drawing fails, which only a fault of this program explains.
pub fn time_svg(found: &Accuracy) -> Result<Option<String>> {
    let series = series(found, |point| {
        let ms = point.ms?;
        Some(((ms[0], point.rmse?), Some([ms[1], ms[2]]), point.pareto))
    });
    curves_svg(&series, Axis { x: "time of a frame / ms", y: "root mean squared error" })
}

/// Error against the step, with lines of the first and the second order beside.
///
/// # Errors
/// As [`time_svg`].
pub fn step_svg(found: &Accuracy) -> Result<Option<String>> {
    let mut series = series(found, |point| Some(((point.step, point.rmse?), None, false)));
    let points = || series.iter().flat_map(|s| s.points.iter().map(|p| p.0));
    // From the best picture of the longest step.
    let longest = points().map(|p| p.0).fold(0.0, f64::max);
    let best = points().filter(|p| p.0 == longest).map(|p| p.1).fold(f64::INFINITY, f64::min);
    let least = points().map(|p| p.0).fold(f64::INFINITY, f64::min);
    if best.is_finite() && least < longest {
        for order in [1, 2] {
            let at = |x: f64| ((x, best * (x / longest).powi(order)), None, false);
            series.push(Series {
                label: format!("order {order}"),
                points: [longest, least].map(at).to_vec(),
                dashed: true,
            });
        }
    }
    curves_svg(&series, Axis { x: "step / voxels", y: "root mean squared error" })
}

fn series(found: &Accuracy, of: impl Fn(&Point) -> Option<crate::report::plot::curves::Place>) -> Vec<Series> {
    let one = |curve: &Curve| Series {
        label: curve.name(),
        points: curve.points.iter().filter_map(&of).filter(|p| p.0.0 > 0.0 && p.0.1 > 0.0).collect(),
        dashed: false,
    };
    found.curves.iter().map(one).collect()
}
