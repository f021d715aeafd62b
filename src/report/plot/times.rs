//! Time of each run: its groups of passes on the device, or CPU time where the device has no timestamps.

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, VPos};

use super::{Area, Drawn, FONT_SIZE, GRID, INK, LEGEND_WIDTH, Ticks, WIDTH, color, ink, ink_at, svg};
use crate::error::Result;
use crate::measure::record::Run;
use crate::measure::timing::Timing;
use crate::report::comparison::{RunGroup, label_with_form};
use crate::report::number::milliseconds;

const BAR: u32 = 30;
const LEGEND_LINE: i32 = 22;

/// The stacked parts of one bar and the time of the whole.
struct Bar {
    label: String,
    /// Place of the group in the legend, and its median in milliseconds.
    parts: Vec<(usize, f64)>,
    total: Timing,
}

/// Horizontal bars, one a run, in milliseconds. Device times and CPU times are never in one plot: where any run has
/// device times, runs without are not drawn, and the table says why. `None` where nothing was timed.
///
/// # Errors
/// When the drawing fails, which only a fault of this program explains.
pub fn times_svg(group: &RunGroup) -> Result<Option<String>> {
    let (groups, bars, axis) = device_bars(group).unwrap_or_else(|| host_bars(group));
    if bars.is_empty() {
        return Ok(None);
    }
    let height = (70 + BAR * bars.len() as u32).max(110 + LEGEND_LINE as u32 * groups.len() as u32);
    svg(height, |area| {
        let (panel, key) = area.split_horizontally(WIDTH - LEGEND_WIDTH);
        draw(&panel, &bars, axis)?;
        legend(&key, &groups)
    })
    .map(Some)
}

type Bars = (Vec<String>, Vec<Bar>, &'static str);

fn device_bars(group: &RunGroup) -> Option<Bars> {
    let mut groups: Vec<String> = Vec::new();
    let mut bars = Vec::new();
    for (_, run) in &group.runs {
        let Some((times, total)) = run.gpu_ms.as_ref().and_then(|t| Some((t, *t.total()?))) else { continue };
        let mut parts = Vec::new();
        for (name, timing) in times.groups() {
            let place = groups.iter().position(|g| g == name).unwrap_or_else(|| {
                groups.push(name.to_string());
                groups.len() - 1
            });
            parts.push((place, timing.value));
        }
        bars.push(Bar { label: label_with_form(run), parts, total });
    }
    (!bars.is_empty()).then_some((groups, bars, "device time of a frame / ms"))
}

fn host_bars(group: &RunGroup) -> Bars {
    let bar = |run: &Run| {
        let total = run.host.cpu?;
        Some(Bar { label: label_with_form(run), parts: vec![(0, total.value)], total })
    };
    let bars = group.runs.iter().filter_map(|(_, run)| bar(run)).collect();
    (vec!["CPU time".to_string()], bars, "CPU time of a frame, all threads / ms")
}

fn draw<'a>(area: &Area<'a>, bars: &[Bar], axis: &str) -> Drawn<'a> {
    let extent = |b: &Bar| b.parts.iter().map(|p| p.1).sum::<f64>().max(b.total.range()[1]);
    let longest = bars.iter().map(extent).filter(|x| x.is_finite()).fold(0.0, f64::max);
    // Room for the number behind the longest bar.
    let right = if longest > 0.0 { 1.16 * longest } else { 1.0 };
    let rows = bars.len();
    let centres: Vec<f64> = (0..rows).map(|i| i as f64 + 0.5).collect();
    let mut chart = ChartBuilder::on(area)
        .margin(10)
        .x_label_area_size(44)
        .y_label_area_size(230)
        .build_cartesian_2d(0.0..right, Ticks { range: rows as f64..0.0, at: centres })?;
    chart
        .configure_mesh()
        .disable_y_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(GRID)
        .axis_style(INK)
        .label_style(ink(FONT_SIZE))
        .x_labels(8)
        .y_label_formatter(&|y| bars.get(y.floor().max(0.0) as usize).map(|b| b.label.clone()).unwrap_or_default())
        .x_desc(axis)
        .axis_desc_style(ink(FONT_SIZE))
        .draw()?;
    for (i, bar) in bars.iter().enumerate() {
        let (upper, centre, lower) = (i as f64 + 0.2, i as f64 + 0.5, i as f64 + 0.8);
        let mut left = 0.0;
        for &(group, ms) in &bar.parts {
            let corners = [(left, upper), (left + ms, lower)];
            chart.draw_series([Rectangle::new(corners, color(group).filled())])?;
            left += ms;
        }
        let [least, most] = bar.total.range();
        let median = bar.total.value;
        let line = |from: (f64, f64), to: (f64, f64), width| PathElement::new([from, to], INK.stroke_width(width));
        chart.draw_series([
            line((least, centre), (most, centre), 1),
            line((least, centre - 0.12), (least, centre + 0.12), 1),
            line((most, centre - 0.12), (most, centre + 0.12), 1),
            line((median, upper - 0.06), (median, lower + 0.06), 2),
        ])?;
        let style = ink_at(FONT_SIZE, HPos::Left, VPos::Center);
        let (x, y) = chart.backend_coord(&(most.max(left), centre));
        let (base_x, base_y) = area.get_base_pixel();
        let at = (x - base_x + 8, y - base_y);
        area.draw(&Text::new(milliseconds(median), at, style))?;
    }
    Ok(())
}

fn legend<'a>(area: &Area<'a>, groups: &[String]) -> Drawn<'a> {
    let text = |text: &str, y: i32| Text::new(text.to_string(), (44, y), ink_at(FONT_SIZE, HPos::Left, VPos::Center));
    let mut y = 24;
    for (i, group) in groups.iter().enumerate() {
        area.draw(&Rectangle::new([(10, y - 7), (34, y + 7)], color(i).filled()))?;
        area.draw(&text(group, y))?;
        y += LEGEND_LINE;
    }
    area.draw(&PathElement::new([(22, y - 8), (22, y + 8)], INK.stroke_width(2)))?;
    area.draw(&text("whole frame, median", y))?;
    y += LEGEND_LINE;
    for (from, to) in [((10, y), (34, y)), ((10, y - 4), (10, y + 4)), ((34, y - 4), (34, y + 4))] {
        area.draw(&PathElement::new([from, to], INK.stroke_width(1)))?;
    }
    area.draw(&text("smallest to largest", y))
}
