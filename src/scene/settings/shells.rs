//! `[shells]`: nested iso-surfaces of an emissive volume [Heidrich95 §2].

use serde::{Deserialize, Serialize};

use super::section::section;
use crate::scene::limits::{Limits, WrongValue};

/// The most levels: each is a pass of its own.
pub const MOST_LEVELS: u32 = 256;

/// Factors of the depth cue.
const FACTORS: Limits = Limits::from_to(0.0, 1e6, "{}");

section! {
    /// Nested iso-surfaces of an emissive volume.
    #[serde(expecting = "the section [shells]")]
    #[command(next_help_heading = "Shells")]
    ShellsSettings, ShellsOptions, "shells";

    /// Show values as emissions, of which the greatest or the sum counts, or the outermost shell in light: --method shells, which asks for
    /// it, draws shells of polygons, and other methods do as with --projection mip or xray, or with --iso
    #[serde(skip_serializing_if = "Option::is_none")]
    #[arg(long = "shells", value_name = "MODE")]
    mode?: ShellMode;

    /// Number of shells, each with its level in the middle of an equal part of the scalar range
    #[arg(long = "shell-count", value_name = "N", allow_negative_numbers = true)]
    count: u32 = 11, within Limits::from_to(1.0, MOST_LEVELS as f64, "shells {}");

    /// Levels of the shells, in the volume's own unit, in place of --shell-count; in any order
    #[serde(skip_serializing_if = "Vec::is_empty")]
    #[arg(long = "shell-levels", value_name = "VALUE,...", value_delimiter = ',', value_parser = super::finite_number, allow_hyphen_values = true, action = clap::ArgAction::Set)]
    shell_levels as "levels": Vec<f64> = Vec::new(), by sound;

    /// Shells that are left out for now, by their numbers from 1 on, dimmest first
    #[serde(skip_serializing_if = "Vec::is_empty")]
    #[arg(long = "shell-disabled", value_name = "NUMBER,...", value_delimiter = ',', allow_negative_numbers = true, action = clap::ArgAction::Set)]
    disabled: Vec<u32> = Vec::new();

    /// beta0 of the depth cue beta0 + a z + b: the brightness that every depth has
    #[arg(long = "shell-beta0", value_name = "FACTOR", allow_negative_numbers = true)]
    beta0: f64 = 0.0, within FACTORS;

    /// a of the depth cue beta0 + a z + b, where z goes from 0 at the far end of the volume to 1 at its near end, or where rays begin within
    /// it, after the perspective division: 0 is no depth cue
    #[arg(long = "shell-a", value_name = "FACTOR", allow_negative_numbers = true)]
    a: f64 = 0.0, within FACTORS;

    /// b of the depth cue beta0 + a z + b
    #[arg(long = "shell-b", value_name = "FACTOR", allow_negative_numbers = true)]
    b: f64 = 1.0, within FACTORS;

    /// Which shell is drawn first, of the greatest emission; of --shells max
    #[arg(long = "shell-order", value_name = "ORDER")]
    order: ShellOrder = ShellOrder::Auto;

    /// What a shell adds to the sum where a ray meets it
    #[arg(long = "shell-sum", value_name = "WHAT")]
    sum: ShellSum = ShellSum::Lengths;
}

/// What is made of the shells that a ray meets [Heidrich95 §2].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum ShellMode {
    /// The greatest emission [Heidrich95 §2.2].
    Max,
    /// The sum of emissions [Heidrich95 §2.1], or of ways.
    Sum,
    /// The outermost shell in light [Heidrich95 §5].
    Surface,
}

/// The order of shells.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum ShellOrder {
    /// The brightest first, so that the early z-test rejects others, unless there are surfaces.
    #[default]
    Auto,
    Brightest,
    /// The dimmest first, as with surfaces [Heidrich95 §4].
    Dimmest,
}

/// What a shell adds to a sum.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum ShellSum {
    /// What the emission within it exceeds that around it by, half-way between levels, times the way within it: the sum goes to the
    /// emission integral.
    #[default]
    Lengths,
    /// Its emission, each time a ray meets it, as in the paper: the sum knows nothing of ways and grows with the number of shells.
    Crossings,
}

/// What is wrong with a list of levels.
fn sound(levels: &[f64]) -> Option<WrongValue> {
    let wrong = |problem: String, remedy: String| Some(WrongValue { problem, remedy });
    if levels.len() > MOST_LEVELS as usize {
        return wrong(format!("has {} levels", levels.len()), format!("keep them to {MOST_LEVELS}"));
    }
    let odd = levels.iter().find(|level| !level.is_finite())?;
    wrong(format!("has the level {odd}"), "give finite numbers".to_owned())
}
