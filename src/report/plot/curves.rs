//! Curves over two logarithmic axes, in panels below each other that share the axis along the bottom, and the other one where they
//! show the same: a panel for each question, with no more curves than can be told apart by colour and mark.

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, VPos};

use super::{Area, Drawn, FONT_SIZE, GRID, INK, Ticks, WIDTH, color, ink, ink_at, shape, svg};
use crate::error::Result;

/// Of the width, what legends take.
const LEGEND_WIDTH: u32 = 310;
const LEGEND_LINE: i32 = 20;
/// Where the first entry of a legend stands, below the panel's title.
const LEGEND_TOP: i32 = 52;
/// Characters of a legend's line.
const LEGEND_CHARACTERS: usize = 36;
/// Pixels between dashes.
const DASH_GAP: u32 = 4;
/// The least height of a panel.
const PANEL: u32 = 380;

/// A mark of a curve; numbers are above 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlotPoint {
    pub x: f64,
    pub y: f64,
    /// Least and greatest x of what was measured.
    pub range: Option<[f64; 2]>,
    pub ring: bool,
}

/// A curve.
#[derive(Clone, Debug, PartialEq)]
pub struct PlotSeries {
    pub label: String,
    pub points: Vec<PlotPoint>,
    /// Pixels of a dash, where it is a line to compare with, without marks.
    pub dash: Option<u32>,
}

/// Curves that are held against each other.
#[derive(Clone, Debug, PartialEq)]
pub struct Panel {
    pub title: String,
    /// What stands along the axis on the left. Panels with the same have the same range.
    pub y: &'static str,
    pub series: Vec<PlotSeries>,
}

/// Along one axis: the decades shown, and where ticks stand.
type Decades = (std::ops::Range<f64>, Vec<f64>);

/// `x`: what stands along the axis at the bottom of every panel.
///
/// # Errors
/// When the drawing fails, which only a fault of this program explains.
pub fn panels_svg(panels: &[Panel], x: &'static str) -> Result<String> {
    let all = panels.iter().flat_map(marks);
    let along_x = decades(all.flat_map(|p| [p.x].into_iter().chain(p.range.into_iter().flatten())));
    let heights: Vec<u32> = panels.iter().map(height).collect();
    svg(heights.iter().sum(), |area| {
        let mut rest = area.clone();
        for (panel, height) in panels.iter().zip(&heights) {
            let (upper, lower) = rest.split_vertically(*height);
            let (plot, key) = upper.split_horizontally(WIDTH - LEGEND_WIDTH);
            let alike = panels.iter().filter(|other| other.y == panel.y).flat_map(marks);
            draw(&plot, panel, x, [&along_x, &decades(alike.map(|p| p.y))])?;
            legend(&key, &panel.series)?;
            rest = lower;
        }
        Ok(())
    })
}

fn marks(panel: &Panel) -> impl Iterator<Item = &PlotPoint> {
    panel.series.iter().flat_map(|series| &series.points)
}

fn height(panel: &Panel) -> u32 {
    let lines: usize = panel.series.iter().map(|series| lines_of(&series.label).len()).sum();
    PANEL.max((LEGEND_TOP + LEGEND_LINE * (lines as i32 + 1)) as u32)
}

/// Ticks at powers of ten, or of two where all fits into two decades.
fn decades(values: impl Iterator<Item = f64>) -> Decades {
    let logs: Vec<f64> = values.map(f64::log10).filter(|log| log.is_finite()).collect();
    let least = logs.iter().copied().fold(f64::INFINITY, f64::min);
    let most = logs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let (low, high) = (least - 0.08, most + 0.08);
    let unit = if high - low > 2.2 { 1.0 } else { 2f64.log10() };
    let ticks = ((low / unit).ceil() as i32..=(high / unit).floor() as i32).map(|i| f64::from(i) * unit).collect();
    (low..high.max(low + 0.1), ticks)
}

/// Logarithms so near to a whole number are those of powers of ten, but for rounding.
const TEN_EXACTLY: f64 = 1e-9;

fn number(log: f64) -> String {
    let value = 10f64.powf(log);
    match value {
        value if (0.01..10_000.0).contains(&value) => format!("{}", (value * 1e4).round() / 1e4),
        _ if (log - log.round()).abs() < TEN_EXACTLY => format!("1e{log:.0}"),
        value => format!("{value:.1e}"),
    }
}

fn draw<'a>(area: &Area<'a>, panel: &Panel, x_title: &str, [x, y]: [&Decades; 2]) -> Drawn<'a> {
    let ticks = |(range, at): &Decades| Ticks { range: range.clone(), at: at.clone() };
    area.draw(&Text::new(panel.title.clone(), (76, 14), ink_at(FONT_SIZE + 3, HPos::Left, VPos::Top)))?;
    let mut chart = ChartBuilder::on(area)
        .margin(10)
        .margin_top(40)
        .x_label_area_size(44)
        .y_label_area_size(76)
        .build_cartesian_2d(ticks(x), ticks(y))?;
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(GRID)
        .axis_style(INK)
        .label_style(ink(FONT_SIZE))
        .x_label_formatter(&|log| number(*log))
        .y_label_formatter(&|log| number(*log))
        .x_desc(x_title)
        .y_desc(panel.y)
        .axis_desc_style(ink(FONT_SIZE))
        .draw()?;
    let logs = |x: f64, y: f64| (x.log10(), y.log10());
    for (i, series) in panel.series.iter().enumerate() {
        let line = series.points.iter().map(|p| logs(p.x, p.y));
        if let Some(dash) = series.dash {
            chart.draw_series(DashedLineSeries::new(line, dash, DASH_GAP, INK.mix(0.6).stroke_width(1)))?;
        } else {
            chart.draw_series(LineSeries::new(line, color(i).stroke_width(2)))?;
        }
    }
    // Marks after all lines, so that none is hidden; in pixels, so that their shape does not follow the axes.
    let pixels = area.strip_coord_spec();
    let (left, upper) = pixels.get_base_pixel();
    for (i, series) in panel.series.iter().enumerate().filter(|(_, series)| series.dash.is_none()) {
        for PlotPoint { x, y, range, ring } in &series.points {
            if let Some([least, most]) = range {
                let whisker = PathElement::new([logs(*least, *y), logs(*most, *y)], INK.stroke_width(1));
                chart.draw_series([whisker])?;
            }
            let (column, row) = chart.backend_coord(&logs(*x, *y));
            let at = (column - left, row - upper);
            shape(&pixels, at, i)?;
            if *ring {
                pixels.draw(&Circle::new(at, 8, INK.stroke_width(2)))?;
            }
        }
    }
    Ok(())
}

fn legend<'a>(area: &Area<'a>, all: &[PlotSeries]) -> Drawn<'a> {
    let mut y = LEGEND_TOP;
    for (i, series) in all.iter().enumerate() {
        if let Some(dash) = series.dash {
            for begin in (8..36).step_by((dash + DASH_GAP) as usize) {
                let ends = [(begin, y), ((begin + dash as i32).min(36), y)];
                area.draw(&PathElement::new(ends, INK.mix(0.6).stroke_width(1)))?;
            }
        } else {
            area.draw(&PathElement::new([(8, y), (36, y)], color(i).stroke_width(2)))?;
            shape(area, (22, y), i)?;
        }
        for line in lines_of(&series.label) {
            area.draw(&Text::new(line, (44, y), ink_at(FONT_SIZE, HPos::Left, VPos::Center)))?;
            y += LEGEND_LINE;
        }
    }
    Ok(())
}

/// A label in lines, broken between words.
fn lines_of(label: &str) -> Vec<String> {
    let mut lines = vec![String::new()];
    for part in label.split_inclusive(' ') {
        match lines.last_mut() {
            Some(line)
                if line.is_empty() || line.chars().count() + part.trim_end().chars().count() <= LEGEND_CHARACTERS =>
            {
                line.push_str(part);
            }
            _ => lines.push(part.to_owned()),
        }
    }
    lines
}
