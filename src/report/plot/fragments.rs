//! Fragments in every pass, one line a method: where in the frame the work is saved.

use std::collections::BTreeMap;

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, VPos};

use super::{Area, Drawn, FONT_SIZE, GRID, INK, LEGEND_WIDTH, Ticks, WIDTH, color, ink, ink_at, mark, svg};
use crate::error::Result;
use crate::measure::record::{OrbitFrame, Run};
use crate::report::comparison::{RunGroup, label};
use crate::report::number::thousands;

const HEIGHT: u32 = 640;
/// Pixels from line to line of a legend, and down to its first one.
const LEGEND_LINE: i32 = 22;
const LEGEND_TOP: i32 = 66;
/// Pixels that the legend of a chart of lines takes besides, whose labels have settings in them.
const LONGER_LABELS: u32 = 60;
/// Radius of a mark.
const MARK: i32 = 4;

struct Series<'a> {
    label: String,
    /// Main and intermediate, in the order of the passes.
    counts: [&'a [u64]; 2],
}

/// Two panels, main passes above intermediate passes. `None` where no run has a pass.
///
/// # Errors
/// When the drawing fails, which only a fault of this program explains.
pub fn fragments_svg(group: &RunGroup) -> Result<Option<String>> {
    panels(&series(group), "pass")
}

/// The same for the frames of an orbit. `None` where no run has one.
///
/// # Errors
/// As [`fragments_svg`].
pub fn orbit_svg(group: &RunGroup) -> Result<Option<String>> {
    let counts = |run: &Run| {
        let frames = run.orbit.as_deref()?;
        let of = |get: fn(&OrbitFrame) -> u64| frames.iter().map(get).collect::<Vec<u64>>();
        Some((label(run), [of(|frame| frame.main), of(|frame| frame.intermediate)]))
    };
    let counts: Vec<(String, [Vec<u64>; 2])> = group.runs.iter().filter_map(|(_, run)| counts(run)).collect();
    let series: Vec<Series> = counts
        .iter()
        .map(|(label, [main, intermediate])| Series { label: label.clone(), counts: [main, intermediate] })
        .collect();
    panels(&series, "frame")
}

/// `of` is what stands along the axis.
fn panels(series: &[Series], of: &str) -> Result<Option<String>> {
    if series.iter().all(|s| s.counts.iter().all(|c| c.is_empty())) {
        return Ok(None);
    }
    let legend_height = 70 + LEGEND_LINE as u32 * series.len() as u32;
    svg(HEIGHT.max(legend_height), |area| {
        let (panels, key) = area.split_horizontally(WIDTH - LEGEND_WIDTH);
        let (upper, lower) = panels.split_vertically(area.dim_in_pixel().1 / 2);
        panel(&upper, "Main passes", series, 0, of)?;
        panel(&lower, "Intermediate passes", series, 1, of)?;
        legend(&key, &series.iter().map(|s| s.label.clone()).collect::<Vec<_>>())
    })
    .map(Some)
}

/// Forms of culling give the same counts, and are then one line; where they do not, each is drawn under its name.
fn series<'a>(group: &RunGroup<'a>) -> Vec<Series<'a>> {
    let mut by_label: BTreeMap<String, Vec<&Run>> = BTreeMap::new();
    let mut order: Vec<String> = Vec::new();
    for (_, run) in &group.runs {
        let label = label(run);
        let same = by_label.entry(label.clone()).or_default();
        if same.is_empty() {
            order.push(label);
        }
        if same.iter().all(|other| other.fragments != run.fragments) {
            same.push(run);
        }
    }
    let named = |label: &String| {
        let runs = by_label[label].clone();
        let several = runs.len() > 1;
        let label = label.clone();
        runs.into_iter().map(move |run| {
            let form = run.form().filter(|_| several).map(|f| format!(", {f}")).unwrap_or_default();
            let counts = [&run.fragments.main_per_pass[..], &run.fragments.intermediate_per_pass[..]];
            Series { label: format!("{label}{form}"), counts }
        })
    };
    order.iter().flat_map(named).collect()
}

/// The place of a count on the axis: its decade, 1 at 1. Counts are whole, so nothing lies between 0 and 1, and 0 can
/// stand one decade below 1 without hiding anything.
fn decade(count: u64) -> f64 {
    if count == 0 { 0.0 } else { 1.0 + (count as f64).log10() }
}

/// The inverse at whole decades.
fn decade_label(decade: f64) -> String {
    match decade.round() as u32 {
        0 => "0".to_string(),
        d => 10_u64.checked_pow(d - 1).map(thousands).unwrap_or_default(),
    }
}

fn panel<'a>(area: &Area<'a>, title: &str, series: &[Series], kind: usize, of: &str) -> Drawn<'a> {
    let counts = || series.iter().flat_map(|s| s.counts[kind].iter().copied());
    let passes = series.iter().map(|s| s.counts[kind].len()).max().unwrap_or(0);
    let bottom = counts().min().map_or(0.0, |least| decade(least).floor());
    let top = counts().max().map_or(1.0, |most| decade(most).ceil()).max(bottom + 1.0);
    let decades: Vec<f64> = (bottom as u32..=top as u32).map(f64::from).collect();
    // Half a pass of room at both sides, so that the first and the last mark are whole.
    let span = -0.5..passes.max(1) as f64 - 0.5;
    let mut chart = ChartBuilder::on(area)
        .caption(title, ink(FONT_SIZE + 3))
        .margin(10)
        .x_label_area_size(44)
        .y_label_area_size(92)
        .build_cartesian_2d(
            Ticks { range: span, at: pass_ticks(passes) },
            Ticks { range: bottom..top + 0.05, at: decades },
        )?;
    chart
        .configure_mesh()
        .disable_x_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(GRID)
        .axis_style(INK)
        .label_style(ink(FONT_SIZE))
        .x_label_formatter(&|pass| format!("{pass:.0}"))
        .y_label_formatter(&|d| decade_label(*d))
        .x_desc(of)
        .y_desc(format!("fragments in the {of}"))
        .axis_desc_style(ink(FONT_SIZE))
        .draw()?;
    let points = |s: &Series| -> Vec<(f64, f64)> {
        s.counts[kind].iter().enumerate().map(|(pass, count)| (pass as f64, decade(*count))).collect()
    };
    for (i, s) in series.iter().enumerate() {
        chart.draw_series(LineSeries::new(points(s), color(i).stroke_width(2)))?;
    }
    // Marks after all lines, so that none is hidden; in pixels, so that their shape does not follow the axes.
    let pixels = area.strip_coord_spec();
    let (left, upper) = pixels.get_base_pixel();
    let every = mark_every(passes, series.len());
    for (i, s) in series.iter().enumerate() {
        for point in points(s).iter().skip(i % every).step_by(every) {
            let (x, y) = chart.backend_coord(point);
            mark(&pixels, (x - left, y - upper), i, MARK)?;
        }
    }
    if bottom == 0.0 && counts().any(|c| c == 0) {
        let (width, _) = area.dim_in_pixel();
        let style = ink_at(FONT_SIZE - 2, HPos::Right, VPos::Top);
        area.draw(&Text::new("logarithmic; 0 stands one decade below 1", (width as i32 - 12, 16), style))?;
    }
    Ok(())
}

/// Where there are passes enough, the lines take turns in marking a pass: the marks of all of them show where they lie
/// on each other.
fn mark_every(passes: usize, lines: usize) -> usize {
    if passes >= 3 * lines { lines.max(passes / 60) } else { 1 }
}

/// At most some twelve passes get a number.
fn pass_ticks(passes: usize) -> Vec<f64> {
    let step = [1, 2, 5, 10, 20, 50, 100, 200, 500].into_iter().find(|s| passes / s <= 12).unwrap_or(passes / 12);
    (0..passes).step_by(step).map(|p| p as f64).collect()
}

/// Where a line of a legend is, pixels from its top.
pub(super) fn legend_line(i: usize) -> i32 {
    LEGEND_TOP + LEGEND_LINE * i as i32
}

/// A line with its mark for each method.
pub(super) fn legend<'a>(area: &Area<'a>, labels: &[String]) -> Drawn<'a> {
    area.draw(&Text::new("method", (8, 40), ink_at(FONT_SIZE, HPos::Left, VPos::Center)))?;
    for (i, label) in labels.iter().enumerate() {
        let y = legend_line(i);
        area.draw(&PathElement::new([(8, y), (36, y)], color(i).stroke_width(2)))?;
        mark(area, (22, y), i, MARK)?;
        area.draw(&Text::new(label.clone(), (44, y), ink_at(FONT_SIZE, HPos::Left, VPos::Center)))?;
    }
    Ok(())
}

/// A chart of lines with its legend on the right, so many pixels high or as high as the legend is.
pub(super) fn beside_legend(
    height: u32,
    labels: &[String],
    draw: impl for<'a> FnOnce(&Area<'a>) -> Drawn<'a>,
) -> Result<String> {
    svg(height.max((LEGEND_TOP + LEGEND_LINE * labels.len() as i32) as u32), |area| {
        let (panel, key) = area.split_horizontally(WIDTH - LEGEND_WIDTH - LONGER_LABELS);
        draw(&panel)?;
        legend(&key, labels)
    })
}
