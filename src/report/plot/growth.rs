//! Time of a frame against the segments that show something, a mark for each scene and a line for each method.

use plotters::prelude::*;

use super::fragments::beside_legend;
use super::{Area, Drawn, FONT_SIZE, GRID, INK, color, ink, mark, ticks};
use crate::error::Result;
use crate::measure::record::Clock;
use crate::report::growth::{Growth, Line};
use crate::report::number::thousands;

const HEIGHT: u32 = 480;

/// How much longer an axis is than to its last mark.
const ROOM: f64 = 1.05;

/// # Errors
/// When the drawing fails, which only a fault of this program explains.
pub fn growth_svg(growth: &Growth) -> Result<String> {
    let labels: Vec<String> = growth.rows.iter().map(|row| row.label.clone()).collect();
    beside_legend(HEIGHT, &labels, |panel| draw(panel, growth))
}

fn draw<'a>(area: &Area<'a>, growth: &Growth) -> Drawn<'a> {
    let segments: Vec<f64> = growth.scenes.iter().map(|(_, segments)| *segments as f64).collect();
    let last = segments.last().copied().unwrap_or(1.0);
    let times = growth.rows.iter().flat_map(|row| row.times.iter().copied());
    let clock = match growth.clock {
        Clock::Cpu => "CPU time of a frame, ms",
        Clock::Gpu => "device time of a frame, ms",
        Clock::Wall => "wall time of a frame, ms",
    };
    let [x, y] = [last, times.fold(0.0, f64::max)].map(|top| ticks(top.max(f64::MIN_POSITIVE) * ROOM));
    let mut chart =
        ChartBuilder::on(area).margin(10).x_label_area_size(44).y_label_area_size(64).build_cartesian_2d(x, y)?;
    chart
        .configure_mesh()
        .disable_x_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(GRID)
        .axis_style(INK)
        .label_style(ink(FONT_SIZE))
        .x_label_formatter(&|segments| thousands(segments.round() as u64))
        .x_desc("segments that show something")
        .y_desc(clock)
        .axis_desc_style(ink(FONT_SIZE))
        .draw()?;
    let pixels = area.strip_coord_spec();
    let (left, upper) = pixels.get_base_pixel();
    for (i, row) in growth.rows.iter().enumerate() {
        let Line { base, each, .. } = row.line;
        // Only between scenes, and where it tells of a time.
        let none = -base / each;
        let first = if each > 0.0 { segments[0].max(none) } else { segments[0] };
        let end = if each < 0.0 { last.min(none) } else { last };
        let at = |segments: f64| (segments, base + each * segments);
        chart.draw_series(LineSeries::new([at(first), at(end)], color(i).stroke_width(2)))?;
        for point in segments.iter().copied().zip(row.times.iter().copied()) {
            let (x, y) = chart.backend_coord(&point);
            mark(&pixels, (x - left, y - upper), i, 4)?;
        }
    }
    Ok(())
}
