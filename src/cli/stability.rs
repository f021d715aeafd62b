//! `depthleap stability`: stiff and extreme cases.

use std::path::PathBuf;

use clap::Args;

use super::open::DeviceOptions;
use super::options::method_parser;
use super::output::{self, Progress};
use crate::error::{Error, Result};
use crate::experiment::Host;
use crate::experiment::folder::write_pages;
use crate::experiment::stability::{PAGES, StabilityCase, StabilityVerdict, battery, keep, run, text};
use crate::measure::write;
use crate::method;
use crate::scene::settings::MethodName;

/// Stiff and extreme cases, each held against what it must give
///
/// Optical depths from 1e-9 to 1e6 a step, transfer functions narrower than it, voxels that are no numbers, boxes of one
/// voxel, eyes on corners and 5000 volumes away, thresholds that are met to the bit, thousands of passes in 16 bits of depth,
/// and what skipping may jump over: by every method, against closed forms, the exact integral or the same samples in f64.
/// Needs no data. Ends with exit code 5 where any case is wrong. Writes stability.json and stability.html.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  depthleap stability -o out
  depthleap stability --case corner --method rc,nn-omni -o out
  depthleap stability --list")]
pub struct StabilityCommand {
    /// Folder for the files; made where it is missing
    #[arg(short, long, value_name = "DIR", required_unless_present = "list")]
    output: Option<PathBuf>,
    /// Only cases whose group or name has this in it
    #[arg(long, value_name = "TEXT")]
    case: Option<String>,
    /// Only these render methods, with commas between [default: all]
    #[arg(long, value_name = "NAME,...", value_delimiter = ',', value_parser = method_parser())]
    method: Vec<MethodName>,
    /// Say which cases there are, and run none
    #[arg(long)]
    list: bool,
    #[command(flatten)]
    device: DeviceOptions,
}

impl StabilityCommand {
    pub fn run(&self) -> Result<()> {
        let cases = self.cases()?;
        let Some(folder) = self.output.as_ref().filter(|_| !self.list) else {
            let lines: Vec<String> = cases
                .iter()
                .map(|case| format!("{}: {} (held against {})\n", case.group, case.name, case.expect.words()))
                .collect();
            return write::write_standard_output(lines.concat().as_bytes());
        };
        write::check_folder(folder)?;
        let methods =
            if self.method.is_empty() { &method::METHODS.map(|method| method.name())[..] } else { &self.method };
        let progress = Progress::new();
        let found = run(
            &cases,
            methods,
            &Host {
                open: &|| self.device.open(),
                close: &|checked| self.device.close(checked),
                say: &|what| progress.say(what),
            },
        )?;
        drop(progress);
        keep(folder, &found)?;
        let written = write_pages(folder, &[&PAGES])?;
        write::write_standard_output(format!("{}{}", text(&found), output::reports(&written)).as_bytes())?;
        match found.count(StabilityVerdict::Wrong) {
            0 => Ok(()),
            wrong => Err(Error::check(
                format!("stability on {}", found.device),
                format!("{wrong} of {} cases are wrong", found.cases.len()),
                format!("see {}", folder.join("stability.html").display()),
            )),
        }
    }

    fn cases(&self) -> Result<Vec<StabilityCase>> {
        let mut cases = battery();
        if let Some(part) = &self.case {
            let part = part.to_lowercase();
            cases.retain(|case| format!("{}: {}", case.group, case.name).to_lowercase().contains(&part));
            if cases.is_empty() {
                let remedy = "see them all with --list";
                return Err(Error::usage("--case", format!("no case has {part} in its name"), remedy));
            }
        }
        Ok(cases)
    }
}
