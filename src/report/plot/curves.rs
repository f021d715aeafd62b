//! Curves over two logarithmic axes.

use plotters::prelude::*;

use super::fragments::legend;
use super::{Area, Drawn, FONT_SIZE, GRID, INK, LEGEND_WIDTH, Ticks, WIDTH, color, ink, mark, svg};
use crate::error::Result;

const HEIGHT: u32 = 520;
const LEGEND_LINE: u32 = 22;

/// Where a mark stands, the range of x that its measurements had, and whether it gets a ring.
pub type Place = ((f64, f64), Option<[f64; 2]>, bool);

/// A curve; numbers are above 0.
#[derive(Clone, Debug)]
pub struct Series {
    pub label: String,
    pub points: Vec<Place>,
    /// A line to compare with, without marks.
    pub dashed: bool,
}

/// What stands along the axes.
#[derive(Clone, Copy, Debug)]
pub struct Axis {
    pub x: &'static str,
    pub y: &'static str,
}

/// `None` where there is no point.
///
/// # Errors
/// When the drawing fails, which only a fault of this program explains.
pub fn curves_svg(series: &[Series], axis: Axis) -> Result<Option<String>> {
    if series.iter().all(|s| s.points.is_empty()) {
        return Ok(None);
    }
    let labels: Vec<String> = series.iter().map(|s| s.label.clone()).collect();
    svg(HEIGHT.max(80 + LEGEND_LINE * labels.len() as u32), |area| {
        let (panel, key) = area.split_horizontally(WIDTH - LEGEND_WIDTH - 100);
        draw(&panel, series, axis)?;
        legend(&key, &labels)
    })
    .map(Some)
}

/// Decades of the values, and where ticks stand: at powers of ten, or of two where all fits into two decades.
fn decades(values: impl Iterator<Item = f64>) -> (std::ops::Range<f64>, Vec<f64>) {
    let logs: Vec<f64> = values.map(f64::log10).filter(|log| log.is_finite()).collect();
    let least = logs.iter().copied().fold(f64::INFINITY, f64::min);
    let most = logs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let (low, high) = (least - 0.08, most + 0.08);
    let unit = if high - low > 2.2 { 1.0 } else { 2f64.log10() };
    let ticks = ((low / unit).ceil() as i32..=(high / unit).floor() as i32).map(|i| f64::from(i) * unit).collect();
    (low..high.max(low + 0.1), ticks)
}

fn number(log: f64) -> String {
    let value = 10f64.powf(log);
    if (0.01..10_000.0).contains(&value) { format!("{}", (value * 1e4).round() / 1e4) } else { format!("1e{log:.0}") }
}

fn draw<'a>(area: &Area<'a>, series: &[Series], axis: Axis) -> Drawn<'a> {
    let all = || series.iter().flat_map(|s| &s.points);
    let (x_range, x_ticks) = decades(all().flat_map(|p| [p.0.0].into_iter().chain(p.1.into_iter().flatten())));
    let (y_range, y_ticks) = decades(all().map(|p| p.0.1));
    let mut chart = ChartBuilder::on(area)
        .margin(10)
        .x_label_area_size(44)
        .y_label_area_size(76)
        .build_cartesian_2d(Ticks { range: x_range, at: x_ticks }, Ticks { range: y_range, at: y_ticks })?;
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(GRID)
        .axis_style(INK)
        .label_style(ink(FONT_SIZE))
        .x_label_formatter(&|log| number(*log))
        .y_label_formatter(&|log| number(*log))
        .x_desc(axis.x)
        .y_desc(axis.y)
        .axis_desc_style(ink(FONT_SIZE))
        .draw()?;
    let pixels = area.strip_coord_spec();
    let (left, upper) = pixels.get_base_pixel();
    for (i, s) in series.iter().enumerate() {
        let logs = |(x, y): (f64, f64)| (x.log10(), y.log10());
        let style = if s.dashed { color(i).mix(0.45).stroke_width(1) } else { color(i).stroke_width(2) };
        chart.draw_series(LineSeries::new(s.points.iter().map(|p| logs(p.0)), style))?;
        for (place, range, ring) in s.points.iter().filter(|_| !s.dashed) {
            if let Some([least, most]) = range {
                let ends = [logs((*least, place.1)), logs((*most, place.1))];
                chart.draw_series([PathElement::new(ends, INK.stroke_width(1))])?;
            }
            let (x, y) = chart.backend_coord(&logs(*place));
            let at = (x - left, y - upper);
            mark(&pixels, at, i, 4)?;
            if *ring {
                pixels.draw(&Circle::new(at, 8, INK.stroke_width(2)))?;
            }
        }
    }
    Ok(())
}
