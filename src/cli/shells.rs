//! `depthleap shells`: iso-surfaces of a volume as polygons.

use std::ffi::OsString;
use std::path::PathBuf;

use clap::Args;
use cpu_time::ProcessTime;

use super::options::{SceneOptions, scene_name};
use super::output;
use crate::error::{Error, Result};
use crate::measure::ply::ply;
use crate::measure::write::{is_standard_output, write_atomically, write_standard_error, write_standard_output};
use crate::read;
use crate::report::number::thousands;
use crate::report::table::{Column, Table, TextLayout};
use crate::scene::Field;
use crate::structure::shell::{crosses, polygons};

/// The most levels at once.
const MOST_LEVELS: usize = 256;

/// Iso-surfaces of a volume as polygons; needs no GPU
///
/// Finds the shells of a volume, a surface for each level, by marching cubes between the voxels' centres and out to the faces of the
/// volume [Heidrich95 §2], and writes them to one PLY file: triangles with shared vertices in volume space, each vertex with its level
/// as `value`. Surfaces are closed but on the faces of the volume and at holes (--nan hole). Prints polygons and CPU time of each
/// level to standard error.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  depthleap shells fuel.nrrd --levels 40,80,120 -o fuel.ply
  depthleap shells ct_head.nrrd --count 6 -o head.ply
  depthleap shells builtin:jets:128 --levels 0.5 -o - > jets.ply")]
pub struct ShellsCommand {
    /// Scene file (.toml), volume file, mesh file, builtin:NAME:SIZE or a built-in scene [default: builtin:shells:64]
    #[arg(value_name = "SCENE|VOLUME")]
    scene: Option<OsString>,
    /// The PLY file; - for standard output
    #[arg(short, long, value_name = "FILE", allow_hyphen_values = true)]
    output: PathBuf,
    /// Values of the surfaces, in the volume's own unit, with commas between; in any order
    #[arg(long, value_name = "VALUE,...", value_delimiter = ',', allow_negative_numbers = true)]
    #[arg(required_unless_present = "count", conflicts_with = "count")]
    levels: Vec<f64>,
    /// So many levels, each in the middle of an equal part of the scalar range (--range)
    #[arg(long, value_name = "N")]
    count: Option<usize>,
    #[command(flatten)]
    scene_options: SceneOptions,
}

impl ShellsCommand {
    pub fn run(&self) -> Result<()> {
        output::check(&[&self.output])?;
        let settings = self.scene_options.settings(self.scene.as_deref())?;
        let field = &read::scene(&settings)?.field;
        let (levels, warnings) = self.asked(field)?;
        let mut table = Table {
            columns: ["level", "vertices", "triangles", "CPU ms"].map(Column::numbers).to_vec(),
            ..Table::default()
        };
        let mut shells = Vec::with_capacity(levels.len());
        for level in levels {
            let begin = ProcessTime::now();
            let shell = polygons(field, field.x(level))?;
            let milliseconds = begin.elapsed().as_secs_f64() * 1e3;
            let counts = [shell.corners.len(), shell.triangles.len()].map(|n| thousands(n as u64));
            let row = [vec![level.to_string()], counts.to_vec(), vec![format!("{milliseconds:.1}")]].concat();
            table.rows.push(row.into_iter().map(Into::into).collect());
            shells.push((level, shell));
        }
        output::say("warning", &scene_name(&settings), &warnings);
        let bytes = ply(&shells)?;
        match is_standard_output(&self.output) {
            true => write_standard_output(&bytes)?,
            false => write_atomically(&self.output, &bytes)?,
        }
        write_standard_error(&table.text(&TextLayout::default()));
        Ok(())
    }

    /// The levels, rising, each once, and what a reader should know of them.
    fn asked(&self, field: &Field) -> Result<(Vec<f64>, Vec<String>)> {
        let number = self.count.unwrap_or(self.levels.len());
        if !(1..=MOST_LEVELS).contains(&number) {
            let option = if self.count.is_some() { "--count" } else { "--levels" };
            let problem = format!("asks for {number} levels");
            return Err(Error::usage(option, problem, format!("ask for 1 to {MOST_LEVELS}")));
        }
        if let Some(level) = self.levels.iter().find(|level| !level.is_finite()) {
            return Err(Error::usage("--levels", format!("has the level {level}"), "give finite numbers"));
        }
        let [low, high] = field.range;
        let middle = |i: usize| {
            let part = (i as f64 + 0.5) / number as f64;
            // Not by the difference, which may overflow.
            low * (1.0 - part) + high * part
        };
        let mut levels = match self.count {
            Some(count) => (0..count).map(middle).collect(),
            None => self.levels.clone(),
        };
        levels.sort_by(f64::total_cmp);
        let asked = levels.len();
        levels.dedup();
        let mut warnings = Vec::new();
        if levels.len() < asked {
            warnings.push(format!("{} of {asked} levels are there twice, and are written once", asked - levels.len()));
        }
        let names: Vec<String> =
            levels.iter().filter(|level| !crosses(field, field.x(**level))).map(f64::to_string).collect();
        if !names.is_empty() {
            let levels = names.join(", ");
            warnings.push(format!("no value lies on both sides of the level {levels}: its surface has no polygons"));
        }
        Ok((levels, warnings))
    }
}
