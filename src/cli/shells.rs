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
use crate::plan;
use crate::read;
use crate::report::number::thousands;
use crate::report::table::{Column, Table, TextLayout};
use crate::scene::Field;
use crate::scene::settings::{self, finite_number};
use crate::scene::shells::{Faces, in_the_middle, polygons};

/// The most levels at once.
const MOST_LEVELS: usize = settings::MOST_LEVELS as usize;

/// Iso-surfaces of a volume as polygons; needs no GPU
///
/// Finds the shells of a volume, a surface for each level, by marching cubes between the voxels' centres and out to the faces of the
/// volume [Heidrich95 §2], and writes them to one PLY file: triangles with shared vertices in volume space, each vertex with its level
/// as `value`. Surfaces are closed except at holes (--nan hole) and, without --closed, at the faces of the volume; where voxels lie at
/// the level itself, vertices coincide and some triangles have no area. Clip planes and clip geometry take nothing away. Prints polygons
/// and CPU time of each level to standard error.
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
    #[arg(long = "levels", value_name = "VALUE,...", value_delimiter = ',', value_parser = finite_number, allow_hyphen_values = true)]
    #[arg(id = "levels_of_file", required_unless_present = "count_of_file", conflicts_with = "count_of_file")]
    levels: Vec<f64>,
    /// Number of levels, each in the middle of an equal part of the scalar range (--range)
    #[arg(long = "count", id = "count_of_file", value_name = "N")]
    count: Option<usize>,
    /// Close shells at the faces of the volume
    #[arg(long)]
    closed: bool,
    #[command(flatten)]
    scene_options: SceneOptions,
}

impl ShellsCommand {
    pub fn run(&self) -> Result<()> {
        output::check(&[&self.output])?;
        let settings = self.scene_options.settings(self.scene.as_deref())?;
        let scene = read::scene(&settings)?;
        if scene.tetrahedra.is_some() {
            let problem = "is a mesh of cells, and shells are made between voxels";
            return Err(Error::input(&scene.field.volume.name, problem, "give a volume of voxels"));
        }
        let (field, name) = (&scene.field, scene_name(&settings));
        let (levels, mut warnings) = self.asked(field)?;
        let mut table = Table {
            columns: ["level", "vertices", "triangles", "CPU ms"].map(Column::numbers).to_vec(),
            ..Table::default()
        };
        let faces = if self.closed { Faces::Closed } else { Faces::Open };
        let mut shells = Vec::with_capacity(levels.len());
        for level in levels {
            let begin = ProcessTime::now();
            let shell = polygons(field, field.x(level), faces)?;
            let milliseconds = begin.elapsed().as_secs_f64() * 1e3;
            let counts = [shell.corners.len(), shell.triangles.len()].map(|n| thousands(n as u64));
            let row = [vec![level.to_string()], counts.to_vec(), vec![format!("{milliseconds:.1}")]].concat();
            table.rows.push(row.into_iter().map(Into::into).collect());
            shells.push((level, shell));
        }
        let empty = shells.iter().filter(|(_, shell)| shell.triangles.is_empty());
        let empty: Vec<String> = empty.map(|(level, _)| level.to_string()).collect();
        if !empty.is_empty() {
            warnings.push(format!("all values lie on one side of {}: there is no surface", empty.join(", ")));
        }
        output::say("note", &name, &plan::notes(&scene));
        output::say("warning", &name, field.volume.warnings.iter().chain(&warnings));
        let bytes = ply(&shells, field.volume.turn)?;
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
        let mut levels = match self.count {
            Some(count) => in_the_middle(count, field.range),
            None => self.levels.clone(),
        };
        levels.sort_by(f64::total_cmp);
        let asked = levels.len();
        levels.dedup();
        let repeated = asked - levels.len();
        let warning = match repeated {
            0 => None,
            1 => Some("a repeated level is written once".to_owned()),
            _ => Some(format!("{repeated} repeated levels are written once")),
        };
        Ok((levels, warning.into_iter().collect()))
    }
}
