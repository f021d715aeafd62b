//! `depthleap probe`: what this driver culls before shading, and how fast.

use std::path::PathBuf;

use clap::Args;

use super::open::DeviceOptions;
use super::output::{Progress, write_json};
use crate::error::{Error, Result};
use crate::experiment::probe::{compare, page, text};
use crate::measure::write::{self, write_atomically};
use crate::probe::record::{self, DeviceRecord, FORMAT, Probe as Record};
use crate::probe::run::{Found, probe};
use crate::provenance::Provenance;

/// What this driver culls before shading, and how fast
///
/// Draws every mechanism that rejects fragments (depth, depth bounds and stencil test, discard) with every kind of shader
/// that may forbid to do so early, in every depth format: whether picture, depths and counts are right, whether the shader
/// runs for rejected fragments, in which patterns, and how many are rejected in a second. All of it is measured. Writes
/// probe.json and report.html (probe.html beside the results of a bench, whose report shows it when the bench is run again).
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  depthleap probe -o out
  depthleap probe --quick -o out
  depthleap probe --device nvidia --compare old/probe.json -o out")]
pub struct Probe {
    /// Folder for the files; made where it is missing
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
    /// One depth format, depths that were copied, one pair of bounds
    #[arg(long)]
    quick: bool,
    /// Say what differs from another probe.json: another device, or another version of the driver
    #[arg(long, value_name = "FILE")]
    compare: Option<PathBuf>,
    #[command(flatten)]
    device: DeviceOptions,
}

impl Probe {
    pub fn run(&self) -> Result<()> {
        write::check_folder(&self.output)?;
        let other = self.compare.as_ref().map(|path| read(path)).transpose()?;
        let opened = self.device.open_unchecked()?;
        let progress = Progress::new();
        let provenance = Provenance::now(FORMAT);
        let found = probe(&opened, self.quick, &|what| progress.say(what));
        drop(progress);
        let device = DeviceRecord::from(&opened.info);
        let instance = opened.instance().clone();
        drop(opened);
        let Found { clock, statistics, work, sides, formats, lines, marks } = found?;
        let record =
            Record { provenance, device, clock, statistics, work, sides, quick: self.quick, formats, lines, marks };
        DeviceOptions::judge(&instance)?;
        write::create_folder(&self.output)?;
        write_json(&self.output.join("probe.json"), &record)?;
        // A bench's report takes the section in when it is made again.
        let of_a_bench = self.output.join("results.json").exists();
        let report = self.output.join(if of_a_bench { "probe.html" } else { "report.html" });
        write_atomically(&report, page(&record).as_bytes())?;
        let mut out = text(&record);
        if let Some(other) = &other {
            out += &format!("\nDifferences\n  {}\n", compare(&record, other).join("\n  "));
        }
        out += &format!("\nReport: {}\n", report.display());
        write::write_standard_output(out.as_bytes())
    }
}

fn read(path: &std::path::Path) -> Result<Record> {
    let name = path.display().to_string();
    let text = std::fs::read_to_string(path)
        .map_err(|e| Error::input(&name, format!("cannot be read ({e})"), "give a probe.json of another run"))?;
    record::read(&text, &name)
}
