//! `depthleap render`: one picture, its counts and times.

use std::path::{Path, PathBuf};

use clap::Args;

use super::open::DeviceOptions;
use super::options::{MethodOptions, SceneOptions, scene_name};
use crate::error::{Error, Result};
use crate::measure::picture::Format;
use crate::measure::runner::{Effort, Runner};
use crate::measure::{table, write_atomically};
use crate::read;
use crate::scene::settings::MethodName;

/// One picture, its counts and times
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  depthleap render fuel.nrrd --tf ramp -o fuel.png
  depthleap render scene.toml --method rc-block --json counts.json -o picture.exr
  depthleap render --from counts.json -o again.png
  depthleap render head.raw --dims 256,256,128 --type u16 -o head.npy")]
pub struct Render {
    /// Scene file, volume file or builtin:NAME:SIZE [default: builtin:shells:64]
    #[arg(value_name = "SCENE|VOLUME")]
    scene: Option<String>,
    /// Picture: .png (sRGB), .exr or .npy (float, linear, premultiplied); -.png writes to standard output
    #[arg(short, long, value_name = "FILE", allow_hyphen_values = true)]
    output: PathBuf,
    /// Render method [default: nn-omni]
    #[arg(long)]
    method: Option<MethodName>,
    /// Repeat the run whose settings stand in this JSON (FILE#INDEX picks one of several)
    #[arg(long, value_name = "FILE", conflicts_with = "scene")]
    from: Option<PathBuf>,
    /// Write counts, times and settings as JSON
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Compare with the f64 reference
    #[arg(long)]
    reference_error: bool,
    /// Frames timed
    #[arg(long, value_name = "N", default_value_t = 1)]
    repeats: usize,
    #[command(flatten)]
    scene_options: SceneOptions,
    #[command(flatten)]
    method_options: MethodOptions,
    #[command(flatten)]
    device: DeviceOptions,
}

impl Render {
    pub fn run(&self) -> Result<()> {
        // Before any work is done for nothing.
        Format::of(&self.output)?;
        let mut settings = match &self.from {
            Some(file) => {
                let mut settings = read::settings_from_json(file)?;
                self.scene_options.apply(&mut settings)?;
                settings
            }
            None => self.scene_options.settings(self.scene.as_deref())?,
        };
        self.method_options.apply(&mut settings);
        settings.method.name = self.method.unwrap_or(settings.method.name);
        let scene = read::scene(&settings)?;
        let checked = self.device.open()?;
        let effort = Effort { warmups: 1, repeats: self.repeats, reference: self.reference_error };
        let mut runner = Runner::new(&checked, scene, scene_name(&settings));
        let mut measured = runner.measure(&[settings.method.clone()], effort, &|_| {})?;
        let Some(one) = measured.pop() else {
            return Err(Error::check("render", "no frame was run", "please report this"));
        };
        drop(runner);
        self.device.close(checked)?;
        one.picture.write(&self.output, settings.image.background)?;
        if let Some(file) = &self.json {
            write_json(file, &one.run.to_json()?)?;
        }
        // The picture may be on standard output.
        eprint!("{}", table::table(std::slice::from_ref(&one.run)));
        Ok(())
    }
}

fn write_json(file: &Path, json: &str) -> Result<()> {
    if file == Path::new("-") {
        crate::measure::write::write_standard_output(json.as_bytes())
    } else {
        write_atomically(file, json.as_bytes())
    }
}
