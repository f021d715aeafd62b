//! The papers' tables, theirs beside ours, and pictures like their figures.

mod data;
pub mod embedded;
mod embedded_rows;
mod figures;
mod page;
mod paper_row;
pub mod papers;
pub mod rates;
mod record;
mod rows;
mod run;
mod spreadsheet;
pub mod stated;
mod stated_run;
pub mod termination;
mod termination_run;
mod termination_table;
mod text;

use super::folder::{KeptResults, Page, Pages};
use crate::error::Result;
use crate::provenance::{self, DocumentFormat};

pub use embedded_rows::{EmbeddedLine, embedded_lines, embedded_verdict};
pub use page::page;
pub use rates::{TimingPlan, rates_csv, time_rates};
pub use record::{FORMAT, FigureRecord, ReproducedSet, Reproduction, StatedRecord, TimedRecord, Variant};
pub use rows::{FragmentLine, lines, verdict};
pub use run::{Counted, CountedSet, Part, ReproduceJob, TimedSets, keep};
pub use spreadsheet::csv;
pub use termination_run::{SEMI_TRANSPARENT, time_termination};
pub use text::text;

/// `reproduce.html`, `reproduce.csv` and `reproduce-rates.csv`.
pub const PAGES: Pages = Pages { json: "reproduce.json", make };

fn make(kept: &KeptResults) -> Result<Vec<Page>> {
    let expected = DocumentFormat {
        what: "a result of reproduce",
        version: FORMAT,
        remedies: ["give one that `reproduce` wrote", "read it with the program that wrote it, or count again"],
    };
    let found = provenance::read(&kept.name, &kept.text, &expected)?;
    Ok(vec![
        Page::new("reproduce.html", page(&found, kept.pictures)),
        Page::new("reproduce.csv", csv(&found)?),
        Page::new("reproduce-rates.csv", rates_csv(&found)?),
    ])
}
