//! Error against time and against the step, both logarithmic; a panel for each question, so that every curve can be told
//! apart. Of surfaces the errors of places, of normals and of colours have panels of their own.

use super::fit::is_beaten;
use super::question::{About, Question, questions};
use super::{Accuracy, Curve, Point};
use crate::error::Result;
use crate::report::plot::curves::{Panel, PlotPoint, PlotSeries, panels_svg};

/// Panels of one plot; very many curves are several plots.
const PANELS: usize = 8;

/// What an error is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Of {
    Picture,
    Places,
    Normals,
    Colors,
}

impl Of {
    /// Those that some curves have.
    fn all(curves: &[Curve]) -> &'static [Self] {
        match curves.iter().flat_map(|curve| &curve.points).any(|point| point.surface.is_some()) {
            true => &[Self::Places, Self::Normals, Self::Colors],
            false => &[Self::Picture],
        }
    }

    fn error(self, point: &Point) -> Option<f64> {
        match self {
            Self::Picture => point.rmse,
            Self::Places => point.surface?.position,
            Self::Normals => point.surface?.normal,
            Self::Colors => point.surface?.color,
        }
    }

    /// What stands along the axis.
    fn axis(self) -> &'static str {
        match self {
            Self::Picture => "root mean squared error",
            Self::Places => "rms error of places / volume units",
            Self::Normals => "rms error of normals / radians",
            Self::Colors => "rms error of colours",
        }
    }

    /// The title of a question's panel.
    fn title(self, title: &str) -> String {
        match self {
            Self::Picture => title.to_owned(),
            Self::Places => format!("Places: {title}"),
            Self::Normals => format!("Normals: {title}"),
            Self::Colors => format!("Colours: {title}"),
        }
    }

    /// Whether the answer to a question shows in it: gradients move no place, and methods, which all meet the same places, show in
    /// places and colours.
    fn answers(self, question: &Question) -> bool {
        match self {
            Self::Picture | Self::Colors => true,
            Self::Places => question.about != About::Gradients,
            Self::Normals => question.about != About::Methods,
        }
    }
}

/// Error against the time of a frame; whiskers from the least to the greatest time, rings around what no other picture
/// beats.
///
/// # Errors
/// When the drawing fails, which only a fault of this program explains.
pub fn time_svgs(found: &Accuracy) -> Result<Vec<String>> {
    let points = || found.curves.iter().flat_map(|curve| &curve.points);
    let panels = panels(found, |of| {
        let all: Vec<(f64, f64)> = points().filter_map(|point| point.time().zip(of.error(point))).collect();
        move |point: &Point| {
            let ([median, least, most, _], error) = (point.ms?, of.error(point)?);
            let ring = !is_beaten((median, error), &all);
            Some(PlotPoint { x: median, y: error, range: Some([least, most]), ring })
        }
    });
    svgs(&panels, "time of a frame / ms")
}

/// Whether a point is one of a kind.
type PointKind = fn(&Point) -> bool;

/// Error against the step, and of shells against the inverse of their number, of tables against the distance of nodes, of adaptive steps
/// against their tolerance, with lines of the first and the second order beside.
/// Curves that are the same are one.
///
/// # Errors
/// As [`time_svgs`].
pub fn step_svgs(found: &Accuracy) -> Result<Vec<String>> {
    let mut plots = Vec::new();
    let kinds: [(PointKind, &str); 4] = [
        (|point| point.shells.is_none() && point.table.is_none() && point.tolerance.is_none(), "step / voxels"),
        (|point| point.shells.is_some(), "1 / number of shells"),
        (|point| point.table.is_some(), "distance of nodes, in parts of an axis"),
        (|point| point.tolerance.is_some(), "tolerance"),
    ];
    for (is_shown, x) in kinds {
        let mut panels = panels(found, |of| {
            move |point: &Point| {
                let y = of.error(point).filter(|_| is_shown(point))?;
                Some(PlotPoint { x: point.tolerance.unwrap_or(point.step), y, range: None, ring: false })
            }
        });
        for panel in &mut panels {
            panel.series = merged(std::mem::take(&mut panel.series));
            let orders = orders(&panel.series);
            panel.series.extend(orders);
        }
        plots.extend(svgs(&panels, x)?);
    }
    Ok(plots)
}

fn svgs(panels: &[Panel], x: &'static str) -> Result<Vec<String>> {
    panels.chunks(PANELS).map(|panels| panels_svg(panels, x)).collect()
}

/// The questions that any curve has a point for, of every kind of error: `of` gives the points of one.
fn panels<P: Fn(&Point) -> Option<PlotPoint>>(found: &Accuracy, of: impl Fn(Of) -> P) -> Vec<Panel> {
    let questions = questions(&found.curves);
    let mut panels = Vec::new();
    for kind in Of::all(&found.curves) {
        let mark = of(*kind);
        let series = |(i, label): &(usize, String)| PlotSeries {
            label: label.clone(),
            points: found.curves[*i].points.iter().filter_map(&mark).filter(|p| p.x > 0.0 && p.y > 0.0).collect(),
            dash: None,
        };
        let panel = |question: &Question| Panel {
            title: kind.title(&question.title),
            y: kind.axis(),
            series: question.curves.iter().map(series).filter(|series| !series.points.is_empty()).collect(),
        };
        let answered = questions.iter().filter(|question| kind.answers(question));
        panels.extend(answered.map(panel).filter(|panel| !panel.series.is_empty()));
    }
    panels
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
