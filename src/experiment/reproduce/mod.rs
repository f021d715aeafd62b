//! The thesis' tables, theirs beside ours, and pictures like its figures.

mod data;
pub mod embedded;
mod embedded_rows;
mod figures;
mod page;
mod paper_row;
pub mod papers;
mod record;
mod rows;
mod run;
mod spreadsheet;
mod text;

use super::folder::{KeptResults, Page, Pages};
use crate::error::Result;
use crate::provenance::{self, DocumentFormat};

pub use embedded_rows::{EmbeddedLine, embedded_lines, embedded_verdict};
pub use page::page;
pub use record::{FORMAT, FigureRecord, ReproducedSet, Reproduction, Variant};
pub use rows::{FragmentLine, lines, verdict};
pub use run::{Counted, CountedSet, ReproduceJob, keep};
pub use spreadsheet::csv;
pub use text::text;

/// `reproduce.html` and `reproduce.csv`.
pub const PAGES: Pages = Pages { json: "reproduce.json", make };

fn make(kept: &KeptResults) -> Result<Vec<Page>> {
    let expected = DocumentFormat {
        what: "a result of reproduce",
        version: FORMAT,
        remedies: ["give one that `reproduce` wrote", "read it with the program that wrote it, or count again"],
    };
    let found = provenance::read(&kept.name, &kept.text, &expected)?;
    Ok(vec![Page::new("reproduce.html", page(&found, kept.pictures)), Page::new("reproduce.csv", csv(&found)?)])
}
