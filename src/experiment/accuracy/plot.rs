//! Error against time and against the step, both logarithmic; a panel for each question, so that every curve can be told
//! apart.

use super::way::Way;
use super::{Accuracy, Curve, Point};
use crate::error::Result;
use crate::report::plot::DISTINCT;
use crate::report::plot::curves::{AxisTitles, Panel, PlotPoint, PlotSeries, panels_svg};

/// Panels of one plot; very many curves are several plots.
const PANELS: usize = 8;

/// Curves that answer one question together.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Question {
    pub title: String,
    /// Places among the curves, each with its label here.
    pub curves: Vec<(usize, String)>,
}

/// What the curves may be held against each other for: the methods, in each way of sampling that several were run in; the
/// ways of sampling; the formats that voxels and colours are kept in. Every curve stands somewhere, and no question has more
/// of them than can be told apart.
pub fn questions(curves: &[Curve]) -> Vec<Question> {
    let mut asked = Vec::new();
    for variation in distinct(curves, |curve| &curve.variation) {
        let title = if variation.is_empty() { "Methods" } else { &format!("Methods, {variation}") };
        ask(&mut asked, title, curves, |curve| (curve.variation == *variation).then(|| curve.method.clone()));
    }
    for method in distinct(curves, |curve| &curve.method) {
        let shown = |i: usize| asked.iter().any(|question| question.curves.iter().any(|(at, _)| *at == i));
        let all_shown = (0..curves.len()).filter(|i| curves[*i].method == *method).all(shown);
        // The first method stands for those that were run in no other ways.
        if !all_shown || curves[0].method == *method {
            ways(&mut asked, curves, method);
        }
    }
    let shown: Vec<usize> = asked.iter().flat_map(|question| question.curves.iter().map(|(i, _)| *i)).collect();
    let others: Vec<(usize, String)> =
        (0..curves.len()).filter(|i| !shown.contains(i)).map(|i| (i, curves[i].name())).collect();
    put(&mut asked, "Others", &others);
    asked
}

/// The ways of sampling of one method, and the formats it keeps voxels and colours in.
fn ways(asked: &mut Vec<Question>, curves: &[Curve], method: &str) {
    let of = |curve: &Curve| (curve.method == *method).then(|| Way::of(&curve.settings));
    let name = |curve: &Curve| {
        if curve.variation.is_empty() { "as the scene is sampled".to_owned() } else { curve.variation.clone() }
    };
    let Some(own) = curves.iter().find_map(of) else { return };
    let formats = |way: Way| (way.accumulate, way.texture);
    let sampled = |way: Way| Way { accumulate: own.accumulate, texture: own.texture, ..way };
    ask(asked, &format!("Ways of sampling, {method}"), curves, |curve| {
        of(curve).filter(|way| formats(*way) == formats(own)).map(|_| name(curve))
    });
    let all: Vec<Way> = curves.iter().filter_map(of).collect();
    let several = |way: Way| all.iter().any(|other| sampled(*other) == sampled(way) && formats(*other) != formats(way));
    let title = format!("Formats of voxels and colours, {method}");
    let kept: Vec<(usize, Way)> =
        curves.iter().enumerate().filter_map(|(i, curve)| Some((i, of(curve).filter(|way| several(*way))?))).collect();
    let labelled = |these: Vec<usize>| these.into_iter().map(|i| (i, name(&curves[i]))).collect::<Vec<_>>();
    if kept.len() <= DISTINCT {
        put(asked, &title, &labelled(kept.iter().map(|(i, _)| *i).collect()));
        return;
    }
    let mut done: Vec<Way> = Vec::new();
    for (_, way) in &kept {
        if !done.contains(&sampled(*way)) {
            done.push(sampled(*way));
            let these = kept.iter().filter(|(_, other)| sampled(*other) == sampled(*way)).map(|(i, _)| *i);
            put(asked, &title, &labelled(these.collect()));
        }
    }
}

/// Asks a question of the curves that have a label for it, where there are several.
fn ask(asked: &mut Vec<Question>, title: &str, curves: &[Curve], label: impl Fn(&Curve) -> Option<String>) {
    let found: Vec<(usize, String)> =
        curves.iter().enumerate().filter_map(|(i, curve)| Some((i, label(curve)?))).collect();
    if found.len() > 1 {
        put(asked, title, &found);
    }
}

/// Puts a question, in as many parts as it needs.
fn put(asked: &mut Vec<Question>, title: &str, curves: &[(usize, String)]) {
    let parts = curves.chunks(DISTINCT);
    let several = parts.len() > 1;
    for (i, part) in parts.enumerate() {
        let title = if several { format!("{title} ({})", i + 1) } else { title.to_owned() };
        asked.push(Question { title, curves: part.to_vec() });
    }
}

/// The values of a field in the order of their first curves.
fn distinct<'a>(curves: &'a [Curve], of: impl Fn(&'a Curve) -> &'a String) -> Vec<&'a String> {
    let mut values: Vec<&String> = Vec::new();
    for value in curves.iter().map(of) {
        if !values.contains(&value) {
            values.push(value);
        }
    }
    values
}

/// Error against the time of a frame; whiskers from the least to the greatest time, rings around what no other picture
/// beats.
///
/// # Errors
/// When the drawing fails, which only a fault of this program explains.
pub fn time_svgs(found: &Accuracy) -> Result<Vec<String>> {
    let panels = panels(found, |point| {
        let [median, least, most, _] = point.ms?;
        Some(PlotPoint { x: median, y: point.rmse?, range: Some([least, most]), ring: point.pareto })
    });
    svgs(&panels, AxisTitles { x: "time of a frame / ms", y: "root mean squared error" })
}

/// Error against the step, with lines of the first and the second order beside. Curves that are the same are one.
///
/// # Errors
/// As [`time_svgs`].
pub fn step_svgs(found: &Accuracy) -> Result<Vec<String>> {
    let mut panels = panels(found, |point| Some(PlotPoint { x: point.step, y: point.rmse?, range: None, ring: false }));
    for panel in &mut panels {
        panel.series = merged(std::mem::take(&mut panel.series));
        let orders = orders(&panel.series);
        panel.series.extend(orders);
    }
    svgs(&panels, AxisTitles { x: "step / voxels", y: "root mean squared error" })
}

fn svgs(panels: &[Panel], axes: AxisTitles) -> Result<Vec<String>> {
    panels.chunks(PANELS).map(|panels| panels_svg(panels, axes)).collect()
}

/// The questions that any curve has a point for.
fn panels(found: &Accuracy, of: impl Fn(&Point) -> Option<PlotPoint>) -> Vec<Panel> {
    let series = |(i, label): (usize, String)| PlotSeries {
        label,
        points: found.curves[i].points.iter().filter_map(&of).filter(|p| p.x > 0.0 && p.y > 0.0).collect(),
        dash: None,
    };
    let panel = |question: Question| Panel {
        title: question.title,
        series: question.curves.into_iter().map(series).filter(|series| !series.points.is_empty()).collect(),
    };
    questions(&found.curves).into_iter().map(panel).filter(|panel| !panel.series.is_empty()).collect()
}

/// Series with the same points as one, under the names of all.
fn merged(all: Vec<PlotSeries>) -> Vec<PlotSeries> {
    let mut merged: Vec<PlotSeries> = Vec::new();
    for series in all {
        match merged.iter_mut().find(|other| other.points == series.points) {
            Some(other) => other.label = format!("{} = {}", other.label, series.label),
            None => merged.push(series),
        }
    }
    merged
}

/// Lines of the first and the second order, from the best picture of the longest step.
fn orders(series: &[PlotSeries]) -> Vec<PlotSeries> {
    let points = || series.iter().flat_map(|series| &series.points);
    let longest = points().map(|p| p.x).fold(0.0, f64::max);
    let best = points().filter(|p| p.x == longest).map(|p| p.y).fold(f64::INFINITY, f64::min);
    let least = points().map(|p| p.x).fold(f64::INFINITY, f64::min);
    if !best.is_finite() || least >= longest {
        return Vec::new();
    }
    let line = |order: i32, dash: u32| {
        let at = |x: f64| PlotPoint { x, y: best * (x / longest).powi(order), range: None, ring: false };
        PlotSeries { label: format!("order {order}"), points: [longest, least].map(at).to_vec(), dash: Some(dash) }
    };
    vec![line(1, 8), line(2, 3)]
}
