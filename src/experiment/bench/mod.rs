//! Every method on every scene: the table, the rows for spreadsheets and the report. Its record is [`Results`].

mod csv;
mod page;
mod run;
mod scene;
mod text;

use super::folder::{KeptResults, Page, Pages};
use crate::error::Result;
use crate::measure::{Results, Run};
use crate::probe::{self, Probe};

pub use csv::csv;
pub use page::page;
pub use run::{BenchJob, keep};
pub use text::table;

/// `report.html` and `results.csv`.
pub const PAGES: Pages = Pages { json: super::BENCH_JSON, make };

fn make(kept: &KeptResults) -> Result<Vec<Page>> {
    let results = Results::from_json(&kept.name, &kept.text)?;
    let probe = probe_of(kept, &results);
    let report = page(&results, probe.as_ref(), kept.pictures)?;
    Ok(vec![Page::new("report.html", report), Page::new("results.csv", csv(&results)?)])
}

/// What `depthleap probe` left in the same folder, of the same device and driver.
fn probe_of(kept: &KeptResults, results: &Results) -> Option<Probe> {
    let path = kept.folder.join(super::probe::PAGES.json);
    let found = probe::record::read(&std::fs::read_to_string(&path).ok()?, &path.display().to_string()).ok()?;
    let same = |run: &Run| (run.device.as_str(), run.driver.trim()) == (&found.device.name, &found.device.driver);
    results.runs.iter().any(same).then_some(found)
}
