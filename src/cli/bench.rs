//! `depthleap bench`: every method on every scene, with a table, JSON, CSV and the report.

use std::path::PathBuf;
use std::time::SystemTime;

use clap::{Args, ValueEnum};
use indicatif::{ProgressBar, ProgressStyle};

use super::open::DeviceOptions;
use super::options::{BENCH_METHODS, MethodOptions, SceneOptions, scene_name};
use crate::error::Result;
use crate::frame::Verdict;
use crate::measure::error::difference;
use crate::measure::picture::Picture;
use crate::measure::record::{FORMAT, Results};
use crate::measure::report::Difference;
use crate::measure::runner::{Checked, Effort, Measured, Runner};
use crate::measure::{ReportInput, csv, report_html, table, write, write_atomically};
use crate::pass::cull::Form;
use crate::read;
use crate::scene::settings::{Cull, MethodName, MethodSettings, Settings};

/// Every method on every scene: the main job
///
/// Prints a table like the thesis' and writes report.html, results.json and results.csv.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  depthleap bench -o out
  depthleap bench fuel.nrrd aneurism.nrrd --tf ramp -o out
  depthleap bench engine.nrrd --method rc-block,nn-omni --forms all --repeats 9 -o out")]
pub struct Bench {
    /// Scene files, volume files or builtin:NAME:SIZE [default: three built-in volumes]
    #[arg(value_name = "SCENE|VOLUME")]
    scenes: Vec<String>,
    /// Folder for report.html, results.json and results.csv
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
    /// Render methods [default: rc,rc-ert,rc-block,nn-omni]
    #[arg(long, value_delimiter = ',')]
    method: Vec<MethodName>,
    /// The form the options name (or `auto` finds), or every form the device has
    #[arg(long, default_value = "one")]
    forms: Forms,
    /// Frames timed for each method
    #[arg(long, value_name = "N", default_value_t = 5)]
    repeats: usize,
    /// Frames run before any is timed
    #[arg(long, value_name = "N", default_value_t = 1)]
    warmups: usize,
    /// Leave out the f64 reference: no error and no lower bound
    #[arg(long)]
    no_reference: bool,
    #[command(flatten)]
    scene_options: SceneOptions,
    #[command(flatten)]
    method_options: MethodOptions,
    #[command(flatten)]
    device: DeviceOptions,
}

#[derive(Clone, Copy, Debug, PartialEq, ValueEnum)]
enum Forms {
    One,
    All,
}

/// What is run when no scene is given: a surface, thin structures in empty space, solid blocks.
const BUILT_IN: [&str; 3] = ["builtin:shells:96", "builtin:jets:128", "builtin:blocks:96"];

impl Bench {
    pub fn run(&self) -> Result<()> {
        let names: Vec<&str> = match self.scenes.is_empty() {
            true => BUILT_IN.to_vec(),
            false => self.scenes.iter().map(String::as_str).collect(),
        };
        // Every scene is read before the first is run: a wrong name costs nobody minutes.
        let mut scenes = Vec::new();
        for name in names {
            let mut settings = self.scene_options.settings(Some(name))?;
            self.method_options.apply(&mut settings);
            scenes.push(settings);
        }
        for settings in &scenes {
            read::scene(settings)?;
        }
        write::create_folder(&self.output)?;
        let checked = self.device.open()?;
        let progress = progress();
        let effort = Effort { warmups: self.warmups, repeats: self.repeats, reference: !self.no_reference };
        let mut measured = Vec::new();
        for settings in &scenes {
            let methods = self.methods(&checked, settings)?;
            let mut runner = Runner::new(&checked, read::scene(settings)?, scene_name(settings));
            measured.extend(runner.measure(&methods, effort, &|what| progress.set_message(what.to_owned()))?);
        }
        progress.finish_and_clear();
        self.device.close(checked)?;
        self.write(measured)
    }

    /// The methods of one scene, in every form that is asked for.
    fn methods(&self, checked: &Checked, settings: &Settings) -> Result<Vec<MethodSettings>> {
        let names = if self.method.is_empty() { BENCH_METHODS.to_vec() } else { self.method.clone() };
        let mut methods = Vec::new();
        for name in names {
            let base = MethodSettings { name, ..settings.method.clone() };
            if self.forms == Forms::All {
                let forms = Form::all(name).into_iter().filter(|form| available(checked, *form));
                let with = |form: Form| MethodSettings { cull: form.cull, mark: form.mark, ..base.clone() };
                let before = methods.len();
                methods.extend(forms.map(with));
                if methods.len() > before {
                    continue;
                }
            }
            methods.push(base);
        }
        Ok(methods)
    }

    fn write(&self, measured: Vec<Measured>) -> Result<()> {
        let mut runs = Vec::new();
        let (mut pictures, mut differences): (Vec<(usize, Picture)>, Vec<Difference>) = (Vec::new(), Vec::new());
        for (i, one) in measured.into_iter().enumerate() {
            if let Some(reference) = &one.reference {
                let gain = 100.0;
                differences.push(Difference { run: i, gain, picture: difference(&one.picture, reference, gain)? });
            }
            runs.push(one.run);
            pictures.push((i, one.picture));
        }
        let results = Results {
            version: FORMAT,
            program: format!("depthleap {}", env!("CARGO_PKG_VERSION")),
            commit: env!("DEPTHLEAP_COMMIT").to_owned(),
            command: command_line(),
            date: humantime::format_rfc3339_seconds(SystemTime::now()).to_string(),
            runs,
        };
        let input =
            ReportInput { title: "Depthleap bench", results: &results, pictures: &pictures, differences: &differences };
        write_atomically(&self.output.join("results.json"), results.to_json()?.as_bytes())?;
        write_atomically(&self.output.join("results.csv"), csv::csv(&results)?.as_bytes())?;
        let report = self.output.join("report.html");
        write_atomically(&report, report_html(&input)?.as_bytes())?;
        let text = format!("{}\nReport: {}\n", table::table(&results.runs), report.display());
        write::write_standard_output(text.as_bytes())
    }
}

fn available(checked: &Checked, form: Form) -> bool {
    let missing = matches!(checked.check.forms.get(&form), Some(Verdict::Missing(_)));
    !missing && (form.cull != Cull::Bounds || checked.device.info.depth_bounds)
}

/// A spinner on a terminal, nothing on a pipe.
fn progress() -> ProgressBar {
    let bar = ProgressBar::new_spinner();
    if let Ok(style) = ProgressStyle::with_template("{spinner} {elapsed} {msg}") {
        bar.set_style(style);
    }
    bar.enable_steady_tick(std::time::Duration::from_millis(200));
    bar
}

/// The command line without the program's folder, words quoted where they need it.
fn command_line() -> String {
    let quoted = |word: String| {
        let plain = !word.is_empty() && word.chars().all(|c| c.is_alphanumeric() || "-_./,:=+".contains(c));
        if plain { word } else { format!("'{word}'") }
    };
    let words = std::env::args().skip(1).map(quoted);
    std::iter::once("depthleap".to_owned()).chain(words).collect::<Vec<_>>().join(" ")
}
