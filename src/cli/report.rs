//! `depthleap report`: the pages of a folder of results again.

use std::path::PathBuf;

use clap::Args;

use super::output;
use crate::error::Result;
use crate::experiment::render::render;
use crate::measure::write::write_standard_output;

/// The pages of a folder of results again, from its JSON
///
/// Makes report.html and whatever else `bench`, `probe`, `reproduce`, `accuracy` and `stability` write beside their JSON:
/// pages, plots and CSV. Needs no device and no volume: numbers come from the JSON, pictures from the folder pictures/.
/// One that is missing is named in the page and on standard error. Use it where JSON and pictures were copied from another
/// machine, where a newer version of this program has better pages, or where `probe` ran after `bench`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  depthleap report out
  depthleap report out && xdg-open out/report.html")]
pub struct ReportCommand {
    /// Folder that `bench`, `probe`, `reproduce`, `accuracy` or `stability` wrote
    #[arg(value_name = "DIR")]
    folder: PathBuf,
}

impl ReportCommand {
    /// # Errors
    /// When the folder has no results, they cannot be read, or a page cannot be written.
    pub fn run(&self) -> Result<()> {
        let written = render(&self.folder)?;
        write_standard_output(output::reports(&written).as_bytes())
    }
}
