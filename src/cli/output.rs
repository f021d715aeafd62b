//! Where commands write: files and standard output, checked before any work is done for nothing.

use std::collections::BTreeSet;
use std::path::Path;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};

use crate::error::{Error, Result, shown};
use crate::experiment::folder::Written;
use crate::measure::Run;
use crate::measure::write::{check_file, is_standard_output, write_standard_error};

/// Whether all of `outputs` can be written, and no two of them to standard output.
///
/// # Errors
/// When one cannot be.
pub fn check(outputs: &[&Path]) -> Result<()> {
    if outputs.iter().filter(|o| is_standard_output(o)).count() > 1 {
        let names: Vec<_> = outputs.iter().map(|o| o.display().to_string()).collect();
        let problem = "cannot take both the picture and the JSON";
        return Err(Error::usage(
            format!("standard output ({})", names.join(", ")),
            problem,
            "give one of them the name of a file",
        ));
    }
    outputs.iter().filter(|o| !is_standard_output(o)).try_for_each(|o| check_file(o))
}

/// Says what may make the runs' pictures mislead, on standard error, each thing once.
pub fn warn(runs: &[Run]) {
    let mut said = BTreeSet::new();
    for run in runs {
        say("warning", &run.scene, run.warnings.iter().filter(|warning| said.insert((&run.scene, *warning))));
    }
}

/// Says what is to be known of a scene on standard error, one line each: `warning: fuel: ...`.
pub fn say<'a>(what: &str, scene: &str, texts: impl IntoIterator<Item = &'a String>) {
    for text in texts {
        write_standard_error(&format!("{what}: {}\n", shown(&format!("{scene}: {text}").replace('\n', "\\n"))));
    }
}

/// Where the pages are, a line each; pictures that are missing in them are named on standard error.
pub fn reports(written: &Written) -> String {
    for missing in &written.missing {
        write_standard_error(&format!("warning: picture {}\n", shown(&missing.replace('\n', "\\n"))));
    }
    written.reports.iter().map(|report| format!("Report: {}\n", report.display())).collect()
}

/// What is being done, on a terminal; nothing on a pipe. Gone when dropped.
pub struct Progress(ProgressBar);

impl Progress {
    pub fn new() -> Self {
        let bar = ProgressBar::new_spinner();
        if let Ok(style) = ProgressStyle::with_template("{spinner} {elapsed} {msg}") {
            bar.set_style(style);
        }
        bar.enable_steady_tick(Duration::from_millis(200));
        Self(bar)
    }

    pub fn say(&self, what: &str) {
        self.0.set_message(what.to_owned());
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}
