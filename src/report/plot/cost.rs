//! Time of each method in times of `rc-ert`, by the cost of a sample: where skipping starts to pay.

use plotters::prelude::*;

use super::fragments::beside_legend;
use super::{Area, Drawn, FONT_SIZE, GRID, INK, Ticks, color, ink, mark};
use crate::error::Result;
use crate::report::cost::Sweep;

const HEIGHT: u32 = 420;

/// # Errors
/// When the drawing fails, which only a fault of this program explains.
pub fn cost_svg(sweep: &Sweep) -> Result<String> {
    let labels: Vec<String> = sweep.rows.iter().map(|row| row.label.clone()).collect();
    beside_legend(HEIGHT, &labels, |panel| draw(panel, sweep))
}

fn draw<'a>(area: &Area<'a>, sweep: &Sweep) -> Drawn<'a> {
    let times = sweep.rows.iter().flat_map(|row| row.times.iter().flatten().copied());
    let top = times.filter(|time| time.is_finite()).fold(1.0, f64::max) * 1.05;
    let step = [0.1, 0.2, 0.5, 1.0, 2.0, 5.0].into_iter().find(|step| top / step <= 10.0).unwrap_or(top / 10.0);
    let heights: Vec<f64> = (0..=(top / step) as u32).map(|i| f64::from(i) * step).collect();
    // Costs double, so that they stand side by side.
    let places: Vec<f64> = (0..sweep.costs.len()).map(|i| i as f64).collect();
    let span = -0.3..places.len() as f64 - 0.7;
    let mut chart = ChartBuilder::on(area)
        .margin(10)
        .x_label_area_size(44)
        .y_label_area_size(64)
        .build_cartesian_2d(Ticks { range: span.clone(), at: places }, Ticks { range: 0.0..top, at: heights })?;
    chart
        .configure_mesh()
        .disable_x_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(GRID)
        .axis_style(INK)
        .label_style(ink(FONT_SIZE))
        .x_label_formatter(&|i| sweep.costs.get(i.round() as usize).map(u32::to_string).unwrap_or_default())
        .y_label_formatter(&|time| format!("{time:.1}"))
        .x_desc("extra fetches a sample")
        .y_desc("time, rc-ert = 1")
        .axis_desc_style(ink(FONT_SIZE))
        .draw()?;
    chart.draw_series([PathElement::new([(span.start, 1.0), (span.end, 1.0)], INK.stroke_width(1))])?;
    let pixels = area.strip_coord_spec();
    let (left, upper) = pixels.get_base_pixel();
    for (i, row) in sweep.rows.iter().enumerate() {
        let points: Vec<(f64, f64)> =
            row.times.iter().enumerate().filter_map(|(at, time)| Some((at as f64, (*time)?))).collect();
        chart.draw_series(LineSeries::new(points.iter().copied(), color(i).stroke_width(2)))?;
        for point in &points {
            let (x, y) = chart.backend_coord(point);
            mark(&pixels, (x - left, y - upper), i, 4)?;
        }
    }
    Ok(())
}
