//! Stiff and extreme scenes, each with the picture it must give: from a closed form, the exact integral or the same sum in
//! f64. See [`battery()`] and [`judge()`].

mod battery;
mod case;
mod device;
pub mod judge;
mod page;
mod record;
mod run;
mod text;

use super::folder::{KeptResults, Page, Pages};
use crate::error::Result;
use crate::provenance::{self, DocumentFormat};

pub use battery::battery;
pub use case::{Expect, StabilityCase, Tolerance};
pub use device::OnDevice;
pub use judge::{Integrator, Outcome, Rendered, StabilityVerdict, judge};
pub use page::page;
pub use record::{CaseRecord, FORMAT, Stability};
pub use run::{keep, run};
pub use text::{line, text};

/// `stability.html`.
pub const PAGES: Pages = Pages { json: "stability.json", make };

fn make(kept: &KeptResults) -> Result<Vec<Page>> {
    let expected = DocumentFormat {
        what: "a result of stability",
        version: FORMAT,
        remedies: ["give one that `stability` wrote", "read it with the program that wrote it, or run it again"],
    };
    let found = provenance::read(&kept.name, &kept.text, &expected)?;
    Ok(vec![Page::new("stability.html", page(&found))])
}
