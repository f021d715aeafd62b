//! The curves as a table and as rows for a spreadsheet.

use std::fmt::Write;

use super::{Accuracy, Curve, Point, answers};
use crate::error::Result;
use crate::report::number::{error, milliseconds, thousands};
use crate::report::table::{Column, Table, TextLayout};

/// The pictures of a curve, a row each.
pub(super) fn table(curve: &Curve) -> Table {
    let heads = ["step", "largest error", "rmse", "PSNR / dB", "SSIM", "time / ms", "samples"];
    let mut table = Table::new(heads.map(Column::numbers).to_vec());
    curve.points.iter().for_each(|point| table.row(cells(point)));
    table
}

fn cells(point: &Point) -> [String; 7] {
    let number = |value: Option<f64>, digits: usize| value.map_or("-".to_owned(), |v| format!("{v:.digits$}"));
    let front = if point.pareto { " *" } else { "" };
    [
        format!("{}", point.step),
        error(point.max),
        error(point.rmse),
        number(point.psnr, 1),
        number(point.ssim, 4),
        point.ms.map_or("-".to_owned(), |ms| format!("{} ± {}{front}", milliseconds(ms[0]), milliseconds(ms[3]))),
        thousands(point.samples),
    ]
}

/// `order 1.02 over steps 2 to 0.125 (theory: 1)`.
pub(super) fn order(curve: &Curve) -> String {
    let theory = curve.expected.map_or("theory gives none".to_owned(), |order| format!("theory: {order}"));
    match &curve.order {
        Some(fit) => format!(
            "order {:.2} over steps {} to {} ({theory})",
            fit.order,
            rounded(fit.steps[0]),
            rounded(fit.steps[1])
        ),
        None => format!("no order: the error does not fall with the step ({theory})"),
    }
}

fn rounded(step: f64) -> f64 {
    (step * 1e6).round() / 1e6
}

/// Everything, for a terminal.
pub fn text(found: &Accuracy) -> String {
    let mut out = format!("{}\n{}\n{}, {}\n", found.scene, found.view, found.device, found.driver);
    // Writing to a string cannot fail.
    for curve in &found.curves {
        let _ = writeln!(out, "\n{}: {}", curve.name(), order(curve));
        out += &table(curve).text(&TextLayout { indent: 2, ..TextLayout::default() });
        curve.remarks.iter().for_each(|remark| {
            let _ = writeln!(out, "  - {remark}");
        });
    }
    out.push('\n');
    found.remarks.iter().chain(&answers(&found.curves)).for_each(|line| {
        let _ = writeln!(out, "{line}");
    });
    out
}

/// One row a picture; an empty field is a `null` of the JSON.
///
/// # Errors
/// When a row cannot be written, which only a fault of this program explains.
pub fn csv(found: &Accuracy) -> Result<String> {
    let head = "method,variation,step,samples_per_pass,error_max,error_rmse,error_psnr,ssim,ms,ms_min,ms_max,ms_mad,ms_n,samples,pareto,order,expected_order";
    let mut table = Table::new(head.split(',').map(Column::words).collect());
    let some = |value: Option<f64>| value.map(|v| v.to_string()).unwrap_or_default();
    for curve in &found.curves {
        for point in &curve.points {
            let ms = |i: usize| some(point.ms.map(|ms| ms[i]));
            table.row([
                curve.method.clone(),
                curve.variation.clone(),
                point.step.to_string(),
                point.samples_per_pass.to_string(),
                some(point.max),
                some(point.rmse),
                some(point.psnr),
                some(point.ssim),
                ms(0),
                ms(1),
                ms(2),
                ms(3),
                point.timed.to_string(),
                point.samples.to_string(),
                point.pareto.to_string(),
                some(curve.order.map(|fit| fit.order)),
                some(curve.expected),
            ]);
        }
    }
    table.csv()
}
