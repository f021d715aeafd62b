//! `depthleap reproduce`: the papers' tables, theirs beside ours.

use std::path::PathBuf;

use clap::Args;

use super::open::DeviceOptions;
use super::output::{self, Progress};
use crate::error::Result;
use crate::experiment::Host;
use crate::experiment::folder::write_pages;
use crate::experiment::reproduce::{PAGES, ReproduceJob, keep, text};
use crate::measure::write;

/// The papers' tables, theirs beside ours
///
/// Counts the fragments of the thesis' Tables 1 and 2 of chapters 5 and 6 and of chapter 7 with its volumes, views and steps,
/// and prints its numbers beside ours, with the ratios to block skipping; of chapter 6, polygons in the volume, with those to
/// the same without. What the thesis leaves open is swept, one choice at a time. Volumes that are not there are named; none
/// stands in for another but a foot in chapter 6, which is named as such. Where a volume is
/// there, draws scenes like the thesis' figures too. Writes
/// reproduce.html, reproduce.json, reproduce.csv and pictures/.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  depthleap reproduce --data volumes -o out
  depthleap reproduce --data volumes --quick -o out
  depthleap reproduce -o out                         the papers' numbers alone")]
pub struct ReproduceCommand {
    /// Folder with the volumes, by their names: engine_256cube.nrrd, fuel.nrrd, foot_cadaver.nrrd; mri_head.nrrd and
    /// aneurism.nrrd are shown besides
    #[arg(long, value_name = "DIR")]
    data: Option<PathBuf>,
    /// Folder for the files; made where it is missing
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
    /// Leave out the sweep over what the thesis leaves open
    #[arg(long)]
    quick: bool,
    #[command(flatten)]
    device: DeviceOptions,
}

impl ReproduceCommand {
    pub fn run(&self) -> Result<()> {
        write::check_folder(&self.output)?;
        let job = ReproduceJob { data: self.data.clone(), quick: self.quick };
        let progress = Progress::new();
        let counted = job.run(&Host {
            open: &|| self.device.open(),
            close: &|checked| self.device.close(checked),
            say: &|what| progress.say(what),
        })?;
        drop(progress);
        let found = keep(&self.output, counted)?;
        let written = write_pages(&self.output, &[&PAGES])?;
        write::write_standard_output(format!("{}\n{}", text(&found), output::reports(&written)).as_bytes())
    }
}
