//! What a probe found, for a terminal, for a reader, and beside what another one found. Its record is
//! [`Probe`](crate::probe::Probe).

mod compare;
mod page;
mod run;
mod text;

use super::folder::{KeptResults, Page, Pages};
use crate::error::Result;
use crate::probe::record::read;

pub use compare::compare;
pub use page::{page, section};
pub use run::{keep, run};
pub use text::{summary, text};

/// `report.html`; `probe.html` beside the results of a bench, whose report has that name.
pub const PAGES: Pages = Pages { json: "probe.json", make };

fn make(kept: &KeptResults) -> Result<Vec<Page>> {
    let found = read(&kept.text, &kept.name)?;
    let of_a_bench = kept.folder.join(super::BENCH_JSON).exists();
    Ok(vec![Page::new(if of_a_bench { "probe.html" } else { "report.html" }, page(&found))])
}
