//! `depthleap probe`: what this driver culls before shading, and how fast.

use std::path::PathBuf;

use clap::Args;

use super::open::DeviceOptions;
use super::output::{self, Progress};
use crate::error::{Error, Result};
use crate::experiment::folder::write_pages;
use crate::experiment::probe::{PAGES, compare, keep, run, text};
use crate::measure::write;
use crate::probe::{Probe, known, record};

/// What this driver culls before shading, and how fast
///
/// Draws every mechanism that rejects fragments (depth, depth bounds and stencil test, discard) with every kind of shader
/// that may forbid to do so early, in every depth format: whether picture, depths and counts are right, whether the shader
/// runs for rejected fragments, in which patterns, and how many are rejected in a second. All of it is measured. Writes
/// probe.json and report.html (probe.html beside the results of a bench, whose report shows it when it is made again: `depthleap report DIR`).
/// A copy stays in the cache, where `--method auto` finds it.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  depthleap probe -o out
  depthleap probe --quick -o out
  depthleap probe --device nvidia --compare old/probe.json -o out")]
pub struct ProbeCommand {
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

impl ProbeCommand {
    pub fn run(&self) -> Result<()> {
        write::check_folder(&self.output)?;
        let other = self.compare.as_ref().map(|path| read(path)).transpose()?;
        let opened = self.device.open_unchecked(false)?;
        let progress = Progress::new();
        let found = run(&opened, self.quick, &|what| progress.say(what));
        drop(progress);
        let instance = opened.instance().clone();
        drop(opened);
        let found = found?;
        DeviceOptions::judge(&instance)?;
        keep(&self.output, &found)?;
        known::keep(&found);
        let written = write_pages(&self.output, &[&PAGES])?;
        let mut out = text(&found);
        if let Some(other) = &other {
            out += &format!("\nDifferences\n  {}\n", compare(&found, other).join("\n  "));
        }
        out += &format!("\n{}", output::reports(&written));
        write::write_standard_output(out.as_bytes())
    }
}

fn read(path: &std::path::Path) -> Result<Probe> {
    let name = path.display().to_string();
    let text = std::fs::read_to_string(path)
        .map_err(|e| Error::input(&name, format!("cannot be read ({e})"), "give a probe.json of another run"))?;
    record::read(&text, &name)
}
