//! Where commands write: files and standard output, checked before any work is done for nothing.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};
use serde::Serialize;

use crate::error::{Error, Result, shown};
use crate::measure::Run;
use crate::measure::write::{check_file, is_standard_output, write_standard_error, write_standard_output};
use crate::measure::write_atomically;
use crate::scene::Settings;

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

/// `value` as indented JSON, to a file or, for `-`, to standard output.
///
/// # Errors
/// When it cannot be written.
pub fn write_json(path: &Path, value: &impl Serialize) -> Result<()> {
    let mut json = serde_json::to_vec_pretty(value).map_err(|e| {
        let problem = format!("cannot be written as JSON ({e})");
        Error::output(path.display(), problem, "check paths for names that are not UTF-8")
    })?;
    json.push(b'\n');
    if is_standard_output(path) { write_standard_output(&json) } else { write_atomically(path, &json) }
}

/// `settings` as a file in `folder` has them: relative paths are relative to it, as in a scene file.
pub fn settings_in(folder: &Path, mut settings: Settings) -> Settings {
    for file in [&mut settings.volume.path, &mut settings.transfer.file].into_iter().flatten() {
        if file.is_relative() {
            *file = seen_from(folder, file).unwrap_or_else(|| file.clone());
        }
    }
    settings
}

/// The way from `folder` to `file`, both of which exist.
fn seen_from(folder: &Path, file: &Path) -> Option<PathBuf> {
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let (from, to) = (folder.canonicalize().ok()?, file.canonicalize().ok()?);
    let shared = from.components().zip(to.components()).take_while(|(a, b)| a == b).count();
    let up = from.components().skip(shared).map(|_| Path::new("..").as_os_str());
    let down = to.components().skip(shared).map(|c| c.as_os_str());
    Some(up.chain(down).collect())
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
