//! `depthleap render`: one picture, its counts and times.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use clap::Args;

use super::open::DeviceOptions;
use super::options::{SceneOptions, method_or_auto_parser, scene_name};
use super::output::{self, Progress};
use crate::error::{Error, Result};
use crate::experiment::bench::table;
use crate::experiment::folder::settings_in;
use crate::measure::picture::PictureFormat;
use crate::measure::runner::{Effort, Runner};
use crate::measure::write::{write_json, write_standard_error};
use crate::measure::{Measured, Run};
use crate::method;
use crate::read;
use crate::scene::Settings;
use crate::scene::settings::MethodName;

/// One picture, its counts and times
///
/// Writes the picture and prints a table of counts and times to standard error. The picture is what one frame leaves;
/// it is rendered once for the counts and then again for each time.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  depthleap render fuel.nrrd --tf ramp -o fuel.png
  depthleap render scene.toml --method rc-block --json counts.json -o picture.exr
  depthleap render --from counts.json -o again.png
  depthleap render --from out/results.json#3 --viewport 1000x1000 -o large.png
  depthleap render fuel.nrrd --method single-pass --effect tint.glsl -o tinted.png
  depthleap render head.raw --dims 256,256,128 --type u16 -o head.npy
  depthleap render fuel.nrrd -o fuel.png --json - | jq .fragments.main")]
pub struct Render {
    /// Scene file (.toml), volume file, mesh file, builtin:NAME:SIZE or a built-in scene [default: builtin:shells:64]
    #[arg(value_name = "SCENE|VOLUME")]
    scene: Option<OsString>,
    /// Picture: .png (8-bit sRGB over --background), .exr or .npy (float, linear, premultiplied; NPY [height][width][4],
    /// row 0 on top); -.png, -.exr and -.npy write to standard output, - is -.png
    #[arg(short, long, value_name = "FILE", allow_hyphen_values = true)]
    output: PathBuf,
    /// Render method [default: auto]
    #[arg(long, value_name = "NAME", value_parser = method_or_auto_parser())]
    method: Option<MethodName>,
    /// Repeat the run whose settings stand in this JSON of `render` or `bench`, options given here win; FILE#INDEX picks
    /// one of several, counted from 0
    #[arg(long, value_name = "FILE", conflicts_with = "scene")]
    from: Option<PathBuf>,
    /// Write counts, times and settings as JSON, to standard output for -
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Compare with the f64 reference, which also gives the lower bound of main fragments; takes its time
    #[arg(long)]
    reference_error: bool,
    /// Frames timed; 0 measures no times
    #[arg(long, value_name = "N", default_value_t = 1, allow_negative_numbers = true)]
    repeats: usize,
    #[command(flatten)]
    scene_options: SceneOptions,
    #[command(flatten)]
    device: DeviceOptions,
}

impl Render {
    pub fn run(&self) -> Result<()> {
        PictureFormat::of(&self.output)?;
        let outputs: Vec<&Path> = std::iter::once(&self.output).chain(&self.json).map(PathBuf::as_path).collect();
        output::check(&outputs)?;
        let mut settings = match &self.from {
            Some(file) => {
                let mut settings = read::settings_from_json(file)?;
                self.scene_options.apply(&mut settings);
                settings
            }
            None => self.scene_options.settings_left_open(self.scene.as_deref())?,
        };
        settings.method.name = self.method.unwrap_or(settings.method.name);
        let Measured { run, picture, .. } = self.measure(&settings)?;
        picture.write(&self.output, settings.image.background)?;
        if let Some(file) = &self.json {
            let folder = file.parent().unwrap_or(Path::new(""));
            write_json(file, &Run { settings: settings_in(folder, run.settings.clone()), ..run.clone() })?;
        }
        output::say("note", &run.scene, &run.notes);
        output::warn(std::slice::from_ref(&run));
        // The picture may be on standard output.
        write_standard_error(&table(std::slice::from_ref(&run)));
        Ok(())
    }

    fn measure(&self, settings: &Settings) -> Result<Measured> {
        let scene = read::scene(settings)?;
        let opened = match method::of(settings.method.name)?.on_device {
            false => None,
            true => Some(self.device.open_for(scene.effect.is_some())?),
        };
        let effort = Effort { warmups: 1, repeats: self.repeats, reference: self.reference_error };
        let progress = Progress::new();
        let mut runner = Runner::new(opened.as_ref(), scene, scene_name(settings));
        let mut measured =
            runner.measure(std::slice::from_ref(&settings.method), effort, &|what| progress.say(what))?;
        drop((runner, progress));
        opened.map_or(Ok(()), |checked| self.device.close(checked))?;
        measured.pop().ok_or_else(|| Error::check("render", "no frame was run", "please report this"))
    }
}
