//! Plots as SVG text. Colours are those of Okabe and Ito (Color Universal Design, 2008), which the common kinds of
//! colour blindness tell apart; a plot never says by colour alone what its legend does not name.

mod changes;
mod cost;
pub mod curves;
mod fragments;
mod growth;
mod times;

use std::ops::Range;

use plotters::coord::Shift;
use plotters::coord::ranged1d::{DefaultFormatting, KeyPointHint};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

pub use changes::changes_svg;
pub use cost::cost_svg;
pub use fragments::{fragments_svg, orbit_svg};
pub use growth::growth_svg;
pub use times::times_svg;

use crate::error::{Error, Result};

/// Pixels; what a column of text is wide.
const WIDTH: u32 = 900;
/// Of the width, what the legend on the right takes.
const LEGEND_WIDTH: u32 = 260;
/// plotters writes 1/1.24 of a size, so this is a text of 13 pixels.
const FONT_SIZE: u32 = 16;
const FONT: &str = "sans-serif";
const INK: RGBColor = RGBColor(0x22, 0x22, 0x22);
const GRID: RGBColor = RGBColor(0xdd, 0xdd, 0xdd);

/// Yellow last: it is weak on white.
const PALETTE: [RGBColor; 8] = [
    RGBColor(0x00, 0x72, 0xb2),
    RGBColor(0xd5, 0x5e, 0x00),
    RGBColor(0x00, 0x9e, 0x73),
    RGBColor(0xe6, 0x9f, 0x00),
    RGBColor(0xcc, 0x79, 0xa7),
    RGBColor(0x56, 0xb4, 0xe9),
    RGBColor(0x00, 0x00, 0x00),
    RGBColor(0xf0, 0xe4, 0x42),
];

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Drawn<'a> = Result<(), DrawingAreaErrorKind<<SVGBackend<'a> as DrawingBackend>::ErrorType>>;

fn color(i: usize) -> RGBColor {
    PALETTE[i % PALETTE.len()]
}

/// Past the last colour they begin again, and lines are told apart by their marks.
fn cycle(i: usize) -> usize {
    i / PALETTE.len()
}

fn ink(size: u32) -> TextStyle<'static> {
    TextStyle::from((FONT, size).into_font()).color(&INK)
}

fn ink_at(size: u32, h: HPos, v: VPos) -> TextStyle<'static> {
    ink(size).pos(Pos::new(h, v))
}

/// Ticks along an axis that begins at 0, about.
const TICKS: usize = 8;

/// An axis from 0 on, with ticks at 1, 2 or 5 times a power of ten.
fn ticks(end: f64) -> Ticks {
    let least = end / TICKS as f64;
    let decade = 10f64.powf(least.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0].map(|factor| factor * decade).into_iter().find(|step| *step >= least);
    let step = step.unwrap_or(least);
    Ticks { range: 0.0..end, at: (0..=(end / step) as u32).map(|i| f64::from(i) * step).collect() }
}

/// A drawing of that height, on white.
fn svg(height: u32, draw: impl for<'a> FnOnce(&Area<'a>) -> Drawn<'a>) -> Result<String> {
    let mut text = String::new();
    {
        let area = SVGBackend::with_string(&mut text, (WIDTH, height)).into_drawing_area();
        area.fill(&WHITE)
            .and_then(|()| draw(&area))
            .and_then(|()| area.present())
            .map_err(|e| Error::output("plot", format!("cannot be drawn ({e})"), "use the CSV file instead"))?;
    }
    Ok(text)
}

/// A mark of a series at a place in pixels.
fn mark<'a>(area: &Area<'a>, at: (i32, i32), i: usize, radius: i32) -> Drawn<'a> {
    match cycle(i) {
        0 => area.draw(&Circle::new(at, radius, color(i).filled())),
        1 => area.draw(&TriangleMarker::new(at, radius + 2, color(i).filled())),
        _ => area.draw(&Cross::new(at, radius, color(i).stroke_width(2))),
    }
}

/// How many curves of one panel have a colour and a mark of their own.
pub const DISTINCT: usize = PALETTE.len();

/// A mark at a place in pixels, another for each of [`DISTINCT`] curves.
fn shape<'a>(area: &Area<'a>, (x, y): (i32, i32), i: usize) -> Drawn<'a> {
    const R: i32 = 5;
    let (filled, line) = (color(i).filled(), color(i).stroke_width(2));
    let corners = |corners: &[(i32, i32)]| corners.iter().map(|(a, b)| (x + a, y + b)).collect::<Vec<_>>();
    let square = corners(&[(-R + 1, -R + 1), (R - 1, -R + 1), (R - 1, R - 1), (-R + 1, R - 1), (-R + 1, -R + 1)]);
    match i % DISTINCT {
        0 => area.draw(&Circle::new((x, y), R - 1, filled)),
        1 => area.draw(&Polygon::new(corners(&[(0, -R), (R, R - 1), (-R, R - 1)]), filled)),
        2 => area.draw(&Polygon::new(square, filled)),
        3 => area.draw(&Polygon::new(corners(&[(0, -R - 1), (R + 1, 0), (0, R + 1), (-R - 1, 0)]), filled)),
        4 => area.draw(&Polygon::new(corners(&[(0, R), (R, -R + 1), (-R, -R + 1)]), filled)),
        5 => area.draw(&Cross::new((x, y), R, line)),
        6 => area.draw(&Circle::new((x, y), R, line)),
        _ => area.draw(&PathElement::new(square, line)),
    }
}

/// An axis with ticks at the given places. The first place may be the larger one: then it runs backwards.
#[derive(Clone)]
struct Ticks {
    range: Range<f64>,
    at: Vec<f64>,
}

impl Ranged for Ticks {
    type FormatOption = DefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, limit: (i32, i32)) -> i32 {
        let part = (value - self.range.start) / (self.range.end - self.range.start);
        limit.0 + (part * f64::from(limit.1 - limit.0)).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, _: Hint) -> Vec<f64> {
        self.at.clone()
    }

    fn range(&self) -> Range<f64> {
        self.range.clone()
    }
}
