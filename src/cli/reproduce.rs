//! `depthleap reproduce`: the papers' tables, theirs beside ours.

use std::path::PathBuf;

use clap::Args;
use clap::builder::{PossibleValue, PossibleValuesParser};

use super::open::DeviceOptions;
use super::output::{self, Progress};
use crate::error::Result;
use crate::experiment::Host;
use crate::experiment::folder::write_pages;
use crate::experiment::reproduce::rates::RATE_TABLES;
use crate::experiment::reproduce::{PAGES, Part, ReproduceJob, TimingPlan, keep, text};
use crate::measure::write;

/// Directions and frames that are timed by default: few, since a frame takes seconds on a device that is a CPU, and no fewer,
/// since the median of two is their mean.
const DIRECTIONS: u32 = 3;
const REPEATS: u32 = 3;

/// The papers' tables, theirs beside ours
///
/// Counts the fragments of the thesis' Tables 1 and 2 of chapters 5 and 6 and of chapter 7 with its volumes, views and steps,
/// and prints its numbers beside ours, with the ratios to block skipping; of chapter 6, polygons in the volume, with those to
/// the same without. What the thesis leaves open is swept, one choice at a time. Volumes that are not there are named; none
/// stands in for another but a foot in chapter 6, which is named as such. Where a volume is there, draws scenes like the
/// papers' figures too. Times the single pass and slices on the volumes of Stegmaier05's Table 1, slices and ray casters on
/// those of KW03's, and emissive shells on those of Heidrich95's, from several directions, and shows frames per second and
/// their ratios beside the papers', and what early ray termination gains and loses. Writes reproduce.html, reproduce.json,
/// reproduce.csv, reproduce-rates.csv and pictures/.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  depthleap reproduce --data volumes -o out
  depthleap reproduce --data volumes --quick -o out
  depthleap reproduce --data volumes --parts times --directions 12 --repeats 5 -o out
  depthleap reproduce --data volumes --parts times --papers heidrich95 -o out
  depthleap reproduce -o out                         the papers' numbers alone")]
pub struct ReproduceCommand {
    /// Folder with the volumes, by their names: engine_256cube.nrrd, fuel.nrrd, foot_cadaver.nrrd; mri_head.nrrd and
    /// aneurism.nrrd are shown besides; buckyball.nrrd, engine.nrrd, ct_head.nrrd, neghip.nrrd
    /// and mra_tof.nrrd are timed
    #[arg(long, value_name = "DIR")]
    data: Option<PathBuf>,
    /// Folder for the files; made where it is missing
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
    /// Leave out the sweep over what the papers leave open
    #[arg(long)]
    quick: bool,
    /// What to do; frames that are timed take long on a device that is a CPU
    #[arg(long, value_enum, value_name = "PART,...", value_delimiter = ',', default_value = "counts,times,figures")]
    parts: Vec<Part>,
    /// Papers whose frames are timed [default: all of them]
    #[arg(long, value_name = "PAPER,...", value_delimiter = ',', value_parser = papers(), ignore_case = true)]
    papers: Option<Vec<String>>,
    /// Directions that frames are timed from, once around the volume
    #[arg(long, value_name = "N", default_value_t = DIRECTIONS, value_parser = clap::value_parser!(u32).range(1..=360))]
    directions: u32,
    /// Frames timed from each direction, of which the median counts
    #[arg(long, value_name = "N", default_value_t = REPEATS, value_parser = clap::value_parser!(u32).range(1..=1000))]
    repeats: u32,
    #[command(flatten)]
    device: DeviceOptions,
}

/// The names of papers that publish frame rates.
fn papers() -> PossibleValuesParser {
    PossibleValuesParser::new(RATE_TABLES.map(|table| PossibleValue::new(table.paper)))
}

impl ReproduceCommand {
    pub fn run(&self) -> Result<()> {
        write::check_folder(&self.output)?;
        let timing = TimingPlan {
            papers: self.papers.clone(),
            sizes: None,
            directions: self.directions,
            repeats: self.repeats as usize,
            sweep: !self.quick,
        };
        let job = ReproduceJob { data: self.data.clone(), parts: self.parts.clone(), quick: self.quick, timing };
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
