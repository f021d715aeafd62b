//! `depthleap compare`: what differs between two results.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;

use super::output;
use crate::error::{Error, Result};
use crate::experiment::compare::{compare, text};
use crate::measure::record::FORMAT;
use crate::measure::write::{is_standard_output, write_json, write_standard_output};
use crate::measure::{Results, Run};
use crate::provenance::Provenance;
use crate::read;

/// What differs between two results: devices, drivers, commits
///
/// Counts are compared exactly; they do not depend on a device's speed. Times are shown with their ratio, and whether they differ
/// by more than their spread. Settings that differ are named. The exit code is 1 where counts differ or a run is missing.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  depthleap compare before after                  two folders of `bench`
  depthleap compare old/results.json new/results.json --json -
  depthleap compare a.json b.json                 two files of `render --json`")]
pub struct CompareCommand {
    /// Folder of `bench`, its results.json, or a file of `render --json`
    #[arg(value_name = "A")]
    a: PathBuf,
    /// Folder or file that is compared with the first
    #[arg(value_name = "B")]
    b: PathBuf,
    /// Write what differs as JSON, to standard output for -
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
}

/// The exit code of results whose counts differ.
const DIFFERENT: u8 = 1;

impl CompareCommand {
    /// # Errors
    /// When a file cannot be read or written.
    pub fn run(&self) -> Result<ExitCode> {
        let outputs: Vec<&Path> = self.json.iter().map(PathBuf::as_path).collect();
        output::check(&outputs)?;
        let found = compare(&results(&self.a)?, &results(&self.b)?);
        if let Some(file) = &self.json {
            write_json(file, &found)?;
        }
        if !self.json.as_deref().is_some_and(is_standard_output) {
            write_standard_output(text(&found).as_bytes())?;
        }
        Ok(if found.same_counts() { ExitCode::SUCCESS } else { ExitCode::from(DIFFERENT) })
    }
}

/// The results in a file or a folder; a single run is one of its own.
fn results(path: &Path) -> Result<Results> {
    let file = if path.is_dir() { path.join("results.json") } else { path.to_owned() };
    let name = file.display().to_string();
    let text = read::text(&file)?;
    Results::from_json(&name, &text).or_else(|error| {
        let run = Run::from_json(&name, &text).map_err(|_| Error { remedy: REMEDY.to_owned(), ..error })?;
        // What a run alone does not say.
        let unsaid = || "unknown".to_owned();
        let made =
            Provenance { version: FORMAT, program: unsaid(), commit: unsaid(), command: unsaid(), date: unsaid() };
        Ok(Results { provenance: made, runs: vec![run], pictures: Vec::new() })
    })
}

const REMEDY: &str = "give a folder of `bench`, its results.json, or a file of `render --json`";
