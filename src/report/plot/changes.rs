//! How far neighbouring pictures of an orbit are from each other, one line a method: where slices come from another stack, the
//! picture pops.

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, VPos};

use super::fragments::{legend, legend_line};
use super::{FONT_SIZE, GRID, INK, LEGEND_WIDTH, WIDTH, color, ink, ink_at, svg, ticks};
use crate::error::Result;
use crate::measure::record::OrbitFrame;
use crate::report::comparison::{RunGroup, label};

const HEIGHT: u32 = 460;
/// Radius of the ring around a change of stacks.
const RING: i32 = 6;

/// Root mean square differences to the frame before, by how far the camera has turned. `None` where no run has an orbit of several
/// frames.
///
/// # Errors
/// When the drawing fails, which only a fault of this program explains.
pub fn changes_svg(group: &RunGroup) -> Result<Option<String>> {
    let orbits: Vec<(String, &[OrbitFrame])> =
        group.runs.iter().filter_map(|(_, run)| Some((label(run), run.orbit.as_deref()?))).collect();
    let changes = || orbits.iter().flat_map(|(_, frames)| frames.iter().filter_map(|frame| frame.change));
    let Some(most) = changes().map(|change| change.rms).filter(|rms| rms.is_finite()).reduce(f64::max) else {
        return Ok(None);
    };
    let turned = orbits.iter().flat_map(|(_, frames)| frames.iter().map(|frame| frame.turned)).fold(0.0, f64::max);
    let [x, y] = [turned.max(1.0), most.max(f64::MIN_POSITIVE) * 1.05].map(ticks);
    svg(HEIGHT, |area| {
        let (plot, key) = area.split_horizontally(WIDTH - LEGEND_WIDTH);
        let mut chart = ChartBuilder::on(&plot)
            .margin(10)
            .x_label_area_size(44)
            .y_label_area_size(92)
            .build_cartesian_2d(x.clone(), y.clone())?;
        chart
            .configure_mesh()
            .disable_x_mesh()
            .light_line_style(TRANSPARENT)
            .bold_line_style(GRID)
            .axis_style(INK)
            .label_style(ink(FONT_SIZE))
            .x_label_formatter(&|degrees| format!("{degrees:.0}"))
            .y_label_formatter(&|rms| if *rms == 0.0 { "0".to_owned() } else { format!("{rms:.1e}") })
            .x_desc("degrees")
            .y_desc("rms change to the frame before")
            .axis_desc_style(ink(FONT_SIZE))
            .draw()?;
        for (i, (_, frames)) in orbits.iter().enumerate() {
            let points = frames.iter().filter_map(|frame| Some((frame.turned, frame.change?.rms)));
            chart.draw_series(LineSeries::new(points, color(i).stroke_width(2)))?;
            let rings = pops(frames).filter_map(|pair| Some((pair[1].turned, pair[1].change?.rms)));
            chart.draw_series(rings.map(|at| Circle::new(at, RING, INK.stroke_width(2))))?;
        }
        legend(&key, &orbits.iter().map(|(label, _)| label.clone()).collect::<Vec<_>>())?;
        if orbits.iter().any(|(_, frames)| pops(frames).next().is_some()) {
            let y = legend_line(orbits.len());
            key.draw(&Circle::new((22, y), RING, INK.stroke_width(2)))?;
            let style = ink_at(FONT_SIZE, HPos::Left, VPos::Center);
            key.draw(&Text::new("popping: another stack", (44, y), style))?;
        }
        Ok(())
    })
    .map(Some)
}

/// Neighbouring frames whose slices are of different stacks.
fn pops(frames: &[OrbitFrame]) -> impl Iterator<Item = &[OrbitFrame]> {
    frames.windows(2).filter(|pair| pair[0].stack != pair[1].stack)
}
