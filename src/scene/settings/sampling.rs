//! `[sampling]`: where samples are taken, and what they stand for.

use std::ops::RangeInclusive;

use serde::{Deserialize, Serialize};

use super::section::section;
use super::tuned;
use crate::error::{self, Error};
use crate::scene::limits::Limits;

/// Steps that are neither below what single precision resolves nor longer than any volume, in voxels.
const STEPS: Limits = Limits::from_to(1e-4, 1e6, "a number of voxels {}");

/// Errors that may be asked for, of a channel of the picture.
const ERRORS: Limits = Limits::from_to(1e-6, 1.0, "an error {}");

/// The most samples of a pass, and the most passes.
const MAX_COUNT: f64 = 65536.0;

/// Extra fetches a sample may have.
pub const EXTRA_FETCHES: RangeInclusive<u32> = 0..=4096;

section! {
    /// Where samples are taken, and what they stand for.
    #[serde(expecting = "the section [sampling]")]
    #[command(next_help_heading = "Sampling")]
    SamplingSettings, SamplingOptions, "sampling";

    /// Distance between samples, in voxels of the finest spacing
    #[arg(long, value_name = "VOXELS", allow_negative_numbers = true)]
    step: f64 = 1.0, within STEPS;

    /// Error against the exact integral, a number or a fraction as 1/255: step, T and classification are chosen so that they meet it, by a
    /// quick look, and with --method auto the fastest method
    #[serde(skip_serializing_if = "Option::is_none")]
    #[arg(long, value_name = "BOUND", value_parser = fraction, allow_negative_numbers = true)]
    error?: f64, within ERRORS, default "none";

    /// What the error that is asked for is
    #[arg(long, value_name = "NORM")]
    error_norm: ErrorNorm = ErrorNorm::Largest;

    /// Where in its step a sample is taken
    #[arg(long, value_name = "PLACE")]
    offset: Offset = Offset::Left;

    /// What the last sample of a ray stands for
    #[arg(long, value_name = "LENGTH")]
    last: Last = Last::Full;

    /// How opacities are brought to the step
    #[arg(long, value_name = "RULE")]
    alpha: Alpha = Alpha::Exponential;

    /// Who interpolates the volume
    #[arg(long, value_name = "WHO")]
    filter: Filter = Filter::Hardware;

    /// What the transfer function is asked for: values of samples, or all values from one to the next
    #[arg(long, value_name = "WHAT")]
    classification: Classification = Classification::Post;

    /// M, samples per main pass; auto, or 0, has it chosen for the scene
    #[serde(deserialize_with = "tuned::number")]
    #[arg(long, value_name = "M", value_parser = tuned::option, allow_negative_numbers = true)]
    samples_per_pass: u32 = 8, within Limits::from_to(f64::from(tuned::AUTO), MAX_COUNT, "a number {}, or auto"), default "8; auto of render and plan";

    /// N, main passes; 0 takes as many as the longest ray of the view needs
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    passes: u32 = 0, within Limits::from_to(0.0, MAX_COUNT, "a number {}; 0 takes as many as the view needs");

    /// T, a ray ends when its opacity is greater, as in the papers: up to 1 - T of what lies behind, the background
    /// included, then stays as it was; 1 ends none early
    #[arg(long, value_name = "OPACITY", allow_negative_numbers = true)]
    termination: f64 = 0.95, within Limits::from_to(0.0, 1.0, "an opacity {} (1 ends no ray early)");

    /// Nodes along each side of the table of ways through the cells of a mesh, of --classification pre-integrated
    #[arg(long = "table-size", value_name = "N", allow_negative_numbers = true)]
    table: u32 = 64, within Limits::from_to(2.0, 256.0, "nodes {}");

    /// Artificial cost of a sample: so many further fetches, one after another, which change no picture
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    extra_fetches: u32 = 0,
        within Limits::from_to(f64::from(*EXTRA_FETCHES.start()), f64::from(*EXTRA_FETCHES.end()), "a number {}");
}

/// A number, or one divided by another.
fn fraction(text: &str) -> Result<f64, String> {
    let number = |text: &str| text.trim().parse::<f64>().map_err(|e| format!("`{text}`: {e}"));
    match text.split_once('/') {
        Some((above, below)) => Ok(number(above)? / number(below)?),
        None => number(text),
    }
}

impl SamplingSettings {
    /// Whether the way of sampling is as it is written, for runs that draw a scene by several methods or steps and compare what they draw.
    ///
    /// # Errors
    /// When it is to be chosen.
    pub fn as_written(&self) -> error::Result<()> {
        let Some(bound) = self.error else { return Ok(()) };
        Err(Error::usage(
            format!("sampling.error (--error {bound})"),
            "chooses steps for one method, and here several methods or steps are compared",
            "use render, whose JSON says what it has chosen, and give that here",
        ))
    }

    /// Whether a sample stands for all values up to the next one, not for its own alone.
    pub fn preintegrates(&self) -> bool {
        self.classification == Classification::PreIntegrated
    }
}

/// How the differences of two pictures become one number.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum ErrorNorm {
    /// The largest of any channel of any pixel.
    #[default]
    Largest,
    /// The root of the mean square over all channels of all pixels.
    Rmse,
}

impl ErrorNorm {
    /// The norm of differences of premultiplied RGBA, a pixel each; 0 of none.
    pub fn of(self, differences: impl Iterator<Item = [f64; 4]>) -> f64 {
        match self {
            Self::Largest => differences.flatten().fold(0.0, |most, d| most.max(d.abs())),
            Self::Rmse => {
                let (mut sum, mut count) = (0.0, 0.0f64);
                differences.flatten().for_each(|d| (sum, count) = (sum + d * d, count + 1.0));
                (sum / count.max(1.0)).sqrt()
            }
        }
    }
}

/// What the transfer function is asked for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum Classification {
    /// The value of a sample.
    #[default]
    Post,
    /// All values from one sample to the next, by a table made for the step; the value goes evenly between them. Of a mesh of cells all
    /// from one face to the next, by a table of their lengths as well, where others integrate exactly.
    PreIntegrated,
}

/// Where in its step a sample is taken.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum Offset {
    /// At its begin, as the papers do.
    #[default]
    Left,
    /// In its middle.
    Midpoint,
}

impl Offset {
    /// In steps.
    pub fn steps(self) -> f64 {
        match self {
            Self::Left => 0.0,
            Self::Midpoint => 0.5,
        }
    }
}

/// What the last sample of a ray stands for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum Last {
    /// A whole step, as in the papers.
    #[default]
    Full,
    /// What is left of the ray.
    Partial,
    /// A whole step, and the ray ends before a step that would leave the volume [Stegmaier05 §5].
    None,
}

/// How an opacity is brought from the reference length to the step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum Alpha {
    /// 1 - (1 - a)^(step / reference).
    #[default]
    Exponential,
    /// Used as it stands.
    Paper,
}

/// Who interpolates the volume.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum Filter {
    /// The device's texture unit.
    #[default]
    Hardware,
    /// The shader, in f32.
    Exact,
    /// Nobody: a sample has the value of the nearest voxel, as label maps need.
    Nearest,
}
