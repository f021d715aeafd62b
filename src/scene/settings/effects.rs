//! `[effects]`: GLSL of the user's that samples and surfaces go through.

use std::path::PathBuf;

use super::section::section;
use crate::scene::limits::Limits;

/// Seconds that a frame with an effect may take, from a hundredth to a day.
const SECONDS: Limits = Limits::from_to(0.01, 86400.0, "a number of seconds {}");

section! {
    /// GLSL of the user's that samples and surfaces go through, in the methods `single-pass...`.
    #[serde(expecting = "the section [effects]")]
    #[command(next_help_heading = "Effects")]
    EffectsSettings, EffectsOptions, "effects";

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
        /// GLSL of your own, by single-pass methods: a file that defines `vec4 effect(Sample here)`, which is asked for the
        /// colour and opacity of each sample that shows, or the colour of each iso-surface that is met; what it is told
        /// stands in glsl/shared/effect.glsl
        #[arg(long, value_name = "FILE")]
        pub effect: Option<PathBuf>,
    }
}

impl EffectsOptions {
    fn apply_others(&self, settings: &mut EffectsSettings) {
        if let Some(file) = &self.effect {
            (settings.file, settings.hash) = (Some(file.clone()), None);
        }
    }
}
