//! The curves as a table and as rows for a spreadsheet.

use std::fmt::Write;

use super::{Accuracy, Curve, Fit, Point, SurfaceError, answers};
use crate::error::Result;
use crate::report::number::{error, milliseconds, thousands};
use crate::report::table::{Column, Table, TextLayout};

/// The pictures of a curve, a row each.
pub(super) fn table(curve: &Curve) -> Table {
    let heads = ["step", "largest error", "rmse", "PSNR / dB", "SSIM", "time / ms", "samples"];
    let surface = ["places", "normals / rad", "colours", "missed"].map(Column::numbers);
    let has_surface = has_surface(curve);
    let mut columns = heads.map(Column::numbers).to_vec();
    if curve.is_of_shells() {
        columns[0] = Column::numbers("shells");
        columns[6] = Column::numbers("fragments");
    } else if curve.is_of_tables() {
        columns[0] = Column::numbers("nodes");
        columns[6] = Column::numbers("fragments");
    } else if curve.is_of_tolerances() {
        columns[0] = Column::numbers("tolerance");
    } else if curve.is_of_exact_cells() {
        columns[0] = Column::numbers("integral");
        columns[6] = Column::numbers("fragments");
    }
    columns.extend(surface.into_iter().filter(|_| has_surface));
    let mut table = Table::new(columns);
    for point in &curve.points {
        let mut row = cells(point).to_vec();
        if curve.is_of_exact_cells() {
            row[0] = "exact".to_owned();
        }
        row.extend(surface_cells(point.surface.as_ref()).into_iter().filter(|_| has_surface));
        table.row(row);
    }
    table
}

/// Whether anything is known of the surface in a curve's pictures.
fn has_surface(curve: &Curve) -> bool {
    curve.points.iter().any(|point| point.surface.is_some())
}

fn surface_cells(found: Option<&SurfaceError>) -> [String; 4] {
    let missed = found.map_or("-".to_owned(), |one| format!("{} of {}", thousands(one.missed), thousands(one.pixels)));
    let errors =
        [found.and_then(|one| one.position), found.and_then(|one| one.normal), found.and_then(|one| one.color)];
    let [place, normal, color] = errors.map(error);
    [place, normal, color, missed]
}

fn cells(point: &Point) -> [String; 7] {
    let number = |value: Option<f64>, digits: usize| value.map_or("-".to_owned(), |v| format!("{v:.digits$}"));
    let front = if point.pareto { " *" } else { "" };
    [
        match (point.shells.or(point.table), point.tolerance) {
            (Some(count), _) => count.to_string(),
            (None, Some(tolerance)) => error(Some(tolerance)),
            (None, None) => point.step.to_string(),
        },
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
        Some(fit) if curve.is_of_shells() => {
            let [few, many] = fit.steps.map(|part| (1.0 / part).round());
            format!("order {:.2} in 1 / n over {few} to {many} shells ({theory})", fit.order)
        }
        None if curve.is_of_shells() => {
            format!("no order: the error does not fall with the number of shells ({theory})")
        }
        Some(fit) if curve.is_of_tables() => {
            let [few, many] = fit.steps.map(|part| (1.0 / part).round() + 1.0);
            format!("order {:.2} in the distance of nodes, over {few} to {many} a side ({theory})", fit.order)
        }
        _ if curve.is_of_tolerances() => curve.kept_tolerances(),
        _ if curve.is_of_exact_cells() => "each way through a cell is integrated exactly, up to rounding".to_owned(),
        None if curve.is_of_tables() => format!("no order: the error does not fall with the nodes ({theory})"),
        fit => fitted(fit.as_ref(), &theory),
    }
}

/// The orders of a surface's errors, a line each; none where there is no surface.
pub(super) fn surface_orders(curve: &Curve) -> Vec<String> {
    let Some(orders) = &curve.surface else { return Vec::new() };
    let places =
        orders.expected_position.map_or("theory: rounding alone".to_owned(), |order| format!("theory: {order}"));
    let none = "theory gives none";
    [("places", &orders.position, places.as_str()), ("normals", &orders.normal, none), ("colours", &orders.color, none)]
        .map(|(of, fit, theory)| format!("{of}: {}", fitted(fit.as_ref(), theory)))
        .to_vec()
}

fn fitted(fit: Option<&Fit>, theory: &str) -> String {
    match fit {
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
        surface_orders(curve).iter().for_each(|line| {
            let _ = writeln!(out, "  {line}");
        });
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

/// One row a picture; an empty field is a `null` of the JSON. Of surfaces there are more columns, where any curve has one.
///
/// # Errors
/// When a row cannot be written, which only a fault of this program explains.
pub fn csv(found: &Accuracy) -> Result<String> {
    let head = "method,variation,step,samples_per_pass,error_max,error_rmse,error_psnr,ssim,ms,ms_min,ms_max,ms_mad,ms_n,samples,pareto,order,expected_order";
    let of_surface = "position_rmse,normal_rmse,color_rmse,missed,surface_pixels,position_order,normal_order,color_order,expected_position_order";
    let has_surface = found.curves.iter().any(has_surface);
    let has_shells = found.curves.iter().any(Curve::is_of_shells);
    let heads = head.split(',').chain(of_surface.split(',').filter(|_| has_surface));
    let has_tables = found.curves.iter().any(Curve::is_of_tables);
    let has_tolerances = found.curves.iter().any(Curve::is_of_tolerances);
    let heads = heads.chain(has_shells.then_some("shells")).chain(has_tables.then_some("table"));
    let heads = heads.chain(has_tolerances.then_some("tolerance"));
    let mut table = Table::new(heads.map(Column::words).collect());
    let some = |value: Option<f64>| value.map(|v| v.to_string()).unwrap_or_default();
    for curve in &found.curves {
        for point in &curve.points {
            let ms = |i: usize| some(point.ms.map(|ms| ms[i]));
            let mut row = vec![
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
            ];
            row.extend(surface_fields(curve, point).into_iter().filter(|_| has_surface));
            row.extend(has_shells.then(|| point.shells.map(|count| count.to_string()).unwrap_or_default()));
            row.extend(has_tables.then(|| point.table.map(|nodes| nodes.to_string()).unwrap_or_default()));
            row.extend(has_tolerances.then(|| some(point.tolerance)));
            table.row(row);
        }
    }
    table.csv()
}

fn surface_fields(curve: &Curve, point: &Point) -> [String; 9] {
    let some = |value: Option<f64>| value.map(|v| v.to_string()).unwrap_or_default();
    let count = |value: Option<u64>| value.map(|n| n.to_string()).unwrap_or_default();
    let (found, orders) = (point.surface, curve.surface.unwrap_or_default());
    let order = |fit: Option<Fit>| some(fit.map(|fit| fit.order));
    [
        some(found.and_then(|one| one.position)),
        some(found.and_then(|one| one.normal)),
        some(found.and_then(|one| one.color)),
        count(found.map(|one| one.missed)),
        count(found.map(|one| one.pixels)),
        order(orders.position),
        order(orders.normal),
        order(orders.color),
        some(orders.expected_position),
    ]
}
