//! The thesis' tables, theirs beside ours.

mod page;
pub mod papers;
mod record;
mod rows;
mod run;
mod text;

use super::folder::{KeptResults, Page, Pages};
use crate::error::Result;
use crate::provenance::{self, DocumentFormat};

pub use page::page;
pub use record::{FORMAT, ReproducedSet, Reproduction, Variant};
pub use rows::{FragmentLine, lines, verdict};
pub use run::{CountedSet, ReproduceJob, keep};
pub use text::{csv, text};

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
