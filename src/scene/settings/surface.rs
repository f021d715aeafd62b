//! `[surface]`: iso-surfaces that rays look for, in place of the volume's colours or with them.

use serde::{Deserialize, Serialize};

use super::section::section;
use crate::scene::fixed;
use crate::scene::limits::{Allowed, BRIGHTEST, Limits, WrongValue};

/// Iso values.
const VALUES: Limits = Limits::new(Allowed::Finite, "a finite number");

/// Widths of a range of values.
const WIDTHS: Limits = Limits::from_to(0.0, 1e30, "a width {}");

/// The most surfaces of `levels`: a ray's value is held against each of them.
pub const MOST_SURFACES: usize = 64;

section! {
    /// Iso-surfaces, in place of the volume's colours or with them.
    #[serde(expecting = "the section [surface]")]
    #[command(next_help_heading = "Surface")]
    SurfaceSettings, SurfaceOptions, "surface";

    /// Value of an iso-surface that is drawn, in the volume's own unit
    #[serde(skip_serializing_if = "Option::is_none")]
    #[arg(long, value_name = "VALUE", allow_negative_numbers = true)]
    iso?: f64, within VALUES;

    /// Iso-surfaces with colours of their own, besides `iso`
    #[serde(skip_serializing_if = "Vec::is_empty")]
    #[arg(skip)]
    levels: Vec<SurfaceLevel> = Vec::new(), by sound;

    /// How a ray finds a surface
    #[arg(long, value_name = "RULE")]
    find: Find = Find::Crossing;

    /// Width of the range of values about an iso value for --find range, in the volume's own unit
    #[serde(skip_serializing_if = "Option::is_none")]
    #[arg(long = "iso-width", value_name = "WIDTH", allow_negative_numbers = true)]
    iso_width?: f64, within WIDTHS, default "a tenth of the scalar range";

    /// How the place of a surface is found between two samples
    #[arg(long, value_name = "HOW")]
    refine: Refine = Refine::Linear;

    /// Draw surfaces together with the volume's colours, not in place of them
    #[arg(long = "surface-volume", num_args = 0, default_missing_value = "true")]
    volume: bool = false;

    /// What a pixel shows of the surface that its ray meets: its colour in all lights, its place or its normal as numbers
    #[arg(long = "surface-shows", value_name = "WHAT")]
    shows: Shows = Shows::Color;
}

impl SurfaceSettings {
    /// Whether there are any.
    pub fn is_asked(&self) -> bool {
        self.iso.is_some() || !self.levels.is_empty()
    }

    /// The surfaces that are asked for.
    pub fn asked(&self) -> Vec<SurfaceLevel> {
        let one = self.iso.map(|iso| SurfaceLevel { iso, ..SurfaceLevel::default() });
        one.into_iter().chain(self.levels.clone()).collect()
    }
}

/// An iso-surface.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table { iso, color, opacity } of surface.levels")]
pub struct SurfaceLevel {
    /// The value on the surface, in the volume's own unit.
    pub iso: f64,
    /// Linear red, green and blue; that of the transfer function at the iso value where nothing is said.
    #[serde(default, skip_serializing_if = "Option::is_none", deserialize_with = "fixed::optional")]
    pub color: Option<[f64; 3]>,
    /// Opacity of the surface.
    #[serde(default = "opaque")]
    pub opacity: f64,
}

fn opaque() -> f64 {
    1.0
}

impl Default for SurfaceLevel {
    fn default() -> Self {
        Self { iso: 0.0, color: None, opacity: opaque() }
    }
}

/// What is wrong with a list of surfaces.
fn sound(levels: &[SurfaceLevel]) -> Option<WrongValue> {
    let wrong = |problem: String, remedy: &str| Some(WrongValue { problem, remedy: remedy.to_owned() });
    if levels.len() > MOST_SURFACES {
        return wrong(format!("has {} surfaces", levels.len()), &format!("keep them to {MOST_SURFACES}"));
    }
    levels.iter().find_map(|level| match level {
        _ if !level.iso.is_finite() => wrong(format!("has the iso value {}", level.iso), "give finite numbers"),
        _ if !(0.0..=1.0).contains(&level.opacity) => {
            wrong(format!("has the opacity {}", level.opacity), "give an opacity from 0 to 1")
        }
        SurfaceLevel { color: Some(color), .. } if !color.iter().all(|c| (0.0..=BRIGHTEST).contains(c)) => {
            wrong(format!("has the color {color:?}"), &format!("give three numbers from 0 to {BRIGHTEST}"))
        }
        _ => None,
    })
}

/// How a ray finds a surface.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum Find {
    /// Where a value comes to be at least that of the surface [KW03 §2.2, Weiler03].
    #[default]
    Crossing,
    /// Where a value lies in a range about that of the surface [Thesis ch. 5 §3.2].
    Range,
}

/// How the place of a surface is found between two samples.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum Refine {
    /// It is that of the first sample on it, as in the papers.
    None,
    /// As if values went evenly from one sample to the next [Stegmaier05 §6].
    #[default]
    Linear,
    /// The root of the interpolant along the ray, a cubic in every cell.
    Exact,
}

/// What a pixel shows of the surface that its ray meets.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum Shows {
    /// Its colour in all lights.
    #[default]
    Color,
    /// The place at which the ray meets it: x, y and z in volume space, opacity 1.
    Position,
    /// Its normal of length 1, turned to the eye: x, y and z in volume space, opacity 1; 0 where there is no gradient.
    Normal,
}
