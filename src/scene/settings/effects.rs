//! `[effects]`: what single-pass methods do besides [Stegmaier05 §6], and GLSL of the user's that samples and surfaces go through.

use std::path::PathBuf;

use serde::{Deserialize, Serialize};

use super::refraction::{Refraction, points};
use super::section::section;
use crate::scene::limits::{Limits, WrongValue};

/// Ways in front of a surface.
const BIASES: Limits = Limits::from_to(0.0, 100.0, "voxels {}");

/// The most that a volume unit takes of light: what is left of it behind a voxel of the finest volume is no number of f32.
const MOST_ABSORPTION: f64 = 1e6;

/// Ways from the volume to what is behind it.
const BEHIND: Limits = Limits::from_to(0.0, 100.0, "a number of volume units {}");

/// Squares of a checker.
const SQUARES: Limits = Limits::from_to(1.0, 1000.0, "a number of squares {}");

/// The built-in background, in place of a file.
pub const CHECKER: &str = "checker";

/// Seconds that a frame with an effect may take, from a hundredth to a day.
const SECONDS: Limits = Limits::from_to(0.01, 86400.0, "a number of seconds {}");

section! {
    /// What the methods `single-pass...` do besides.
    #[serde(expecting = "the section [effects]")]
    #[command(next_help_heading = "Effects")]
    EffectsSettings, EffectsOptions, "effects";

    /// Let iso-surfaces shade each other and themselves
    #[arg(long, num_args = 0, default_missing_value = "true")]
    shadows: bool = false;

    /// How far in front of a surface its ways to lights begin, in voxels of the finest spacing
    #[arg(long = "shadow-bias", value_name = "VOXELS", allow_negative_numbers = true)]
    shadow_bias: f64 = 1.0, within BIASES;

    /// Light that comes through what iso-surfaces enclose
    #[serde(skip_serializing_if = "Option::is_none")]
    #[arg(skip)]
    translucency?: Translucency, by sound;

    /// Bend rays by the index of refraction that values x have, linear between those given: `0.2:1,0.4:1.33`
    #[serde(skip_serializing_if = "Option::is_none")]
    #[arg(long, value_name = "X:INDEX,...", value_parser = points, allow_hyphen_values = true)]
    refraction?: Refraction, by super::refraction::sound;

    /// What is behind the volume: "checker", or a picture (PNG, Radiance HDR or OpenEXR) relative to the scene file
    #[serde(skip_serializing_if = "Option::is_none", with = "crate::scene::file_name")]
    #[arg(long, value_name = "checker|FILE")]
    behind as "background"?: PathBuf;

    /// How far the background is behind the corner of the volume that is farthest from the eye, in volume units
    #[arg(long = "behind-distance", value_name = "UNITS", allow_negative_numbers = true)]
    background_distance: f64 = 0.5, within BEHIND;

    /// Squares of the checker in the height of the picture
    #[arg(long = "behind-squares", value_name = "COUNT", allow_negative_numbers = true)]
    background_squares: f64 = 12.0, within SQUARES;

    /// A file that defines `vec4 effect(Sample here)`, relative to the scene file
    #[serde(skip_serializing_if = "Option::is_none", with = "crate::scene::file_name")]
    #[arg(skip)]
    file?: PathBuf;

    /// SHA-256 of the file's text when a run was made, in hexadecimal digits; another text comes with a warning
    #[serde(skip_serializing_if = "Option::is_none")]
    #[arg(skip)]
    hash?: String;

    /// Seconds that a frame with an effect may take before it is given up as one that never ends
    #[arg(long = "effect-limit", value_name = "SECONDS", allow_negative_numbers = true)]
    limit: f64 = 120.0, within SECONDS;

    options {
        /// Let light through iso-surfaces, which take so much of it in a volume unit
        #[arg(long = "translucency", value_name = "ABSORPTION", allow_negative_numbers = true)]
        pub absorption: Option<f64>,

        /// GLSL of your own, by single-pass methods: a file that defines `vec4 effect(Sample here)`, which is asked for the
        /// colour and opacity of each sample that shows, or the colour of each iso-surface that is met; what it is told
        /// stands in glsl/shared/effect.glsl
        #[arg(long, value_name = "FILE")]
        pub effect: Option<PathBuf>,
    }
}

impl EffectsOptions {
    fn apply_others(&self, settings: &mut EffectsSettings) {
        if let Some(absorption) = self.absorption {
            settings.translucency = Some(Translucency { absorption, ..settings.translucency.unwrap_or_default() });
        }
        if let Some(file) = &self.effect {
            (settings.file, settings.hash) = (Some(file.clone()), None);
        }
    }
}

/// Light that comes through what the outermost iso-surface encloses [Stegmaier05 §6].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, expecting = "a table { absorption, part } of effects.translucency")]
pub struct Translucency {
    /// What a volume unit within takes of light: it leaves exp(-absorption).
    pub absorption: f64,
    /// The part of a surface's diffuse and specular colour that such light takes the place of.
    pub part: f64,
}

impl Default for Translucency {
    fn default() -> Self {
        Self { absorption: 4.0, part: 1.0 }
    }
}

/// What is wrong with a translucency.
fn sound(translucency: &Option<Translucency>) -> Option<WrongValue> {
    let wrong = |problem: String, remedy: String| Some(WrongValue { problem, remedy });
    let Translucency { absorption, part } = translucency.as_ref()?;
    if !(0.0..=MOST_ABSORPTION).contains(absorption) {
        return wrong(format!("has the absorption {absorption}"), format!("give a number from 0 to {MOST_ABSORPTION}"));
    }
    if !(0.0..=1.0).contains(part) {
        return wrong(format!("has the part {part}"), "give a part from 0 to 1".to_owned());
    }
    None
}
