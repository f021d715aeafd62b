//! Error against run time: pictures of many steps, held against the exact integral, and how fast their error falls.

mod adaptive;
mod cells;
mod check;
mod explain;
mod fit;
mod others;
mod page;
mod plot;
mod question;
mod record;
mod run;
mod shells;
mod surface;
mod text;
mod way;

use super::folder::{KeptResults, Page, Pages};
use crate::error::Result;
use crate::provenance::{self, DocumentFormat};

pub use explain::{expected_order, remarks, remarks_on_all};
pub use fit::{answers, fastest, fit, mark_pareto};
pub use page::page;
pub use plot::{step_svgs, time_svgs};
pub use question::{About, Question, questions};
pub use record::{Accuracy, Curve, FORMAT, Fit, Point, SurfaceError, SurfaceOrders};
pub use run::{AccuracyJob, keep};
pub use surface::{SurfacePictures, surface_error};
pub use text::{csv, text};

/// `accuracy.html`, `accuracy.csv`, and the plots as SVG.
pub const PAGES: Pages = Pages { json: "accuracy.json", make };

fn make(kept: &KeptResults) -> Result<Vec<Page>> {
    let expected = DocumentFormat {
        what: "a result of accuracy",
        version: FORMAT,
        remedies: ["give one that `accuracy` wrote", "read it with the program that wrote it, or measure again"],
    };
    let found: Accuracy = provenance::read(&kept.name, &kept.text, &expected)?;
    let mut pages = vec![Page::new("accuracy.html", page(&found, kept.pictures)?)];
    pages.push(Page::new("accuracy.csv", csv(&found)?));
    for (name, plots) in [("error-time", time_svgs(&found)?), ("error-step", step_svgs(&found)?)] {
        for (i, svg) in plots.into_iter().enumerate() {
            let more = if i == 0 { String::new() } else { format!("-{}", i + 1) };
            pages.push(Page::new(format!("{name}{more}.svg"), svg));
        }
    }
    Ok(pages)
}
