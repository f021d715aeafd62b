//! What the curves come to: the order in the step, the pictures that nothing beats, and the fastest within an error.

use super::{Curve, Fit, Point};

/// Where no shorter step takes this order from the error, it has come down to what does not fall with the step: rounding, the
/// texture unit, rays that end early. A single halving may take less, where errors of either sign happen to cancel.
const STALLED: f64 = 0.4;

/// Longer steps than this do not meet a cell each.
const LONGEST: f64 = 2.0;

/// The order in the step: the slope of a line through log error over log step, by least squares, from the longest step
/// down to where the error stalls. `points` are steps and errors.
pub fn fit(points: &[(f64, f64)]) -> Option<Fit> {
    let mut sorted: Vec<(f64, f64)> = points
        .iter()
        .filter(|(step, error)| *step > 0.0 && *step <= LONGEST && error.is_finite() && *error > 0.0)
        .map(|(step, error)| (step.ln(), error.ln()))
        .collect();
    sorted.sort_by(|a, b| b.0.total_cmp(&a.0));
    let falls = |at: usize| {
        let (step, error) = sorted[at];
        sorted[at + 1..].iter().any(|(shorter, less)| error - less >= STALLED * (step - shorter))
    };
    let used = &sorted[..(0..sorted.len()).find(|at| !falls(*at)).map_or(0, |at| at + 1)];
    if used.len() < 3 {
        return None;
    }
    let n = used.len() as f64;
    let mean = |of: &dyn Fn(&(f64, f64)) -> f64| used.iter().map(of).sum::<f64>() / n;
    let (x, y) = (mean(&|p| p.0), mean(&|p| p.1));
    let (xy, xx) = (mean(&|p| (p.0 - x) * (p.1 - y)), mean(&|p| (p.0 - x).powi(2)));
    let steps = [used[0].0.exp(), used[used.len() - 1].0.exp()];
    (xx > 0.0).then(|| Fit { order: xy / xx, steps, points: used.len() })
}

/// Marks the points that no other one beats in both time and error.
pub fn mark_pareto(curves: &mut [Curve]) {
    let all: Vec<(f64, f64)> = curves.iter().flat_map(|c| &c.points).filter_map(|p| p.time().zip(p.rmse)).collect();
    for point in curves.iter_mut().flat_map(|c| &mut c.points) {
        let Some(own) = point.time().zip(point.rmse) else { continue };
        point.pareto = !is_beaten(own, &all);
    }
}

/// Whether any of some times and errors is better than this one, in one of the two at least, and worse in neither.
pub fn is_beaten((ms, error): (f64, f64), all: &[(f64, f64)]) -> bool {
    all.iter().any(|(t, e)| (*t < ms && *e <= error) || (*t <= ms && *e < error))
}

/// The fastest picture whose largest error is at most that.
pub fn fastest(curves: &[Curve], error: f64) -> Option<(&Curve, &Point)> {
    let all = curves.iter().flat_map(|curve| curve.points.iter().map(move |point| (curve, point)));
    let good = all.filter(|(_, point)| point.max.is_some_and(|max| max <= error) && point.ms.is_some());
    good.min_by(|a, b| a.1.time().unwrap_or(f64::INFINITY).total_cmp(&b.1.time().unwrap_or(f64::INFINITY)))
}

/// Where shells win: with how many of them they are faster than all rays of no larger rms error, and with how many they are not.
fn shells_beside_rays(curves: &[Curve]) -> Vec<String> {
    let timed = |curve: &Curve| curve.points.iter().filter_map(|p| Some((p.time()?, p.rmse?))).collect::<Vec<_>>();
    let rays: Vec<(f64, f64)> = curves.iter().filter(|curve| !curve.is_of_shells()).flat_map(timed).collect();
    let beside = |point: &Point| {
        let (count, ms, error) = (point.shells?, point.time()?, point.rmse?);
        let best = rays.iter().filter(|(_, other)| *other <= error).map(|(ms, _)| *ms).reduce(f64::min);
        let words = match best {
            Some(best) => format!("{count} ({ms:.1} ms, rays {best:.1} ms)"),
            None => format!("{count} ({ms:.1} ms, no rays come as near)"),
        };
        Some((best.is_none_or(|best| ms < best), words))
    };
    let told = |curve: &Curve| {
        let (won, lost): (Vec<_>, Vec<_>) = curve.points.iter().filter_map(beside).partition(|(wins, _)| *wins);
        let [won, lost] =
            [won, lost].map(|those| those.into_iter().map(|(_, words)| words).collect::<Vec<_>>().join(", "));
        let name = curve.name();
        match (won.is_empty(), lost.is_empty()) {
            (true, true) => None,
            (true, false) => {
                Some(format!("{name} win nowhere: rays of no larger rms error are faster beside {lost} of them."))
            }
            (false, true) => Some(format!("{name} win with all numbers of them, by rms error and time: {won}.")),
            (false, false) => Some(format!("{name} win, by rms error and time, with {won} of them; not with {lost}.")),
        }
    };
    let beside_rays = curves.iter().filter(|curve| curve.is_of_shells() && !rays.is_empty());
    beside_rays.filter_map(told).collect()
}

/// What is asked in one line each: 1/255, which no 8-bit picture shows, and 1/1000.
pub fn answers(curves: &[Curve]) -> Vec<String> {
    let fastest_within =
        [("1/255", 1.0 / 255.0), ("1/1000", 1e-3)].into_iter().map(|(name, error)| match fastest(curves, error) {
            Some((curve, point)) => format!(
                "For an error of at most {name}, {} {} is the fastest: {:.2} ms, largest error {:.1e}.",
                curve.name(),
                match (point.shells, point.table, point.tolerance) {
                    (Some(count), ..) => format!("with {count} of them"),
                    (None, Some(nodes), _) => format!("of {nodes} nodes a side"),
                    (None, None, Some(tolerance)) => format!("with a tolerance of {tolerance:.1e}"),
                    (None, None, None) if curve.is_of_exact_cells() => "integrated exactly".to_owned(),
                    (None, None, None) =>
                        format!("at a step of {} voxel{}", point.step, if point.step == 1.0 { "" } else { "s" }),
                },
                point.time().unwrap_or_default(),
                point.max.unwrap_or_default()
            ),
            None => format!("No run comes within an error of {name}."),
        });
    fastest_within.chain(shells_beside_rays(curves)).collect()
}
