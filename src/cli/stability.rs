//! `depthleap stability`: stiff and extreme cases.

use std::path::PathBuf;
use std::time::Instant;

use clap::Args;

use super::open::DeviceOptions;
use super::options::method_parser;
use super::output::{Progress, write_json};
use crate::error::{Error, Result};
use crate::experiment::stability::{
    CaseRecord, FORMAT, OnDevice, Stability as Found, StabilityCase, StabilityVerdict, battery, judge, page, text,
};
use crate::measure::write::{self, write_atomically};
use crate::method;
use crate::provenance::Provenance;
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
pub struct Stability {
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

impl Stability {
    pub fn run(&self) -> Result<()> {
        let cases = self.cases()?;
        let Some(output) = self.output.as_ref().filter(|_| !self.list) else {
            let lines: Vec<String> = cases
                .iter()
                .map(|case| format!("{}: {} (held against {})\n", case.group, case.name, case.expect.words()))
                .collect();
            return write::write_standard_output(lines.concat().as_bytes());
        };
        write::check_folder(output)?;
        let methods =
            if self.method.is_empty() { &method::METHODS.map(|method| method.name())[..] } else { &self.method };
        let checked = self.device.open()?;
        let progress = Progress::new();
        let provenance = Provenance::now(FORMAT);
        let mut records = Vec::with_capacity(cases.len());
        let mut integrator = OnDevice::new(&checked);
        for (i, case) in cases.iter().enumerate() {
            progress.say(&format!("{} of {}: {}", i + 1, cases.len(), case.name));
            let begin = Instant::now();
            let outcomes = judge(case, methods, &mut integrator)?;
            records.push(CaseRecord::new(case, outcomes, begin.elapsed().as_secs_f64() * 1e3));
        }
        drop(progress);
        drop(integrator);
        let info = checked.device.info.clone();
        self.device.close(checked)?;
        let found = Found {
            provenance,
            device: info.name.clone(),
            driver: format!("{} {}", info.driver_name, info.driver_info),
            cases: records,
        };
        write::create_folder(output)?;
        write_json(&output.join("stability.json"), &found)?;
        let report = output.join("stability.html");
        write_atomically(&report, page(&found).as_bytes())?;
        write::write_standard_output(format!("{}Report: {}\n", text(&found), report.display()).as_bytes())?;
        match found.count(StabilityVerdict::Wrong) {
            0 => Ok(()),
            wrong => Err(Error::check(
                format!("stability on {}", found.device),
                format!("{wrong} of {} cases are wrong", found.cases.len()),
                format!("see {}", report.display()),
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
