//! `[transfer]`: which colour and opacity a value has.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::section::section;
use crate::scene::fixed;
use crate::scene::transfer::{DEFAULT_PRESET, PRESETS, REFERENCES};

/// What reference lengths are measured in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum ReferenceUnit {
    /// Voxels of the finest spacing: the same object, sampled more finely, is more opaque.
    #[default]
    Voxel,
    /// The longest side of the volume, whatever its voxels are.
    Volume,
}

section! {
    /// Which colour and opacity a value has; of preset, file and points there is one at the most.
    #[serde(expecting = "the section [transfer]")]
    // The help of the scene begins with --tf, at 0, and what belongs to it, in front of the volume's options.
    #[command(next_help_heading = "Scene", next_display_order = 1)]
    TransferSettings, TransferOptions, "transfer";

    /// A built-in transfer function
    #[serde(skip_serializing_if = "Option::is_none")]
    #[arg(skip)]
    preset?: String;

    /// A transfer function file, relative to the scene file: `{"points": [[x, r, g, b, a], ...]}`
    #[serde(skip_serializing_if = "Option::is_none", with = "crate::scene::file_name")]
    #[arg(skip)]
    file?: PathBuf;

    /// Points [x, red, green, blue, opacity]
    #[serde(skip_serializing_if = "Option::is_none", deserialize_with = "fixed::optional_lists")]
    #[arg(skip)]
    points?: Vec<[f64; 5]>;

    /// Length an opacity stands for, in the unit that --reference-unit names
    #[arg(long, value_name = "LENGTH", allow_negative_numbers = true)]
    reference: f64 = 1.0, within REFERENCES;

    /// Unit of the reference length
    #[arg(long, value_name = "UNIT")]
    reference_unit: ReferenceUnit = ReferenceUnit::Voxel;

    options {
        /// Transfer function: one of [`PRESETS`], or a file; takes the place of preset, file and points
        #[arg(long, value_name = "NAME|FILE", display_order = 0, help = help_of_tf())]
        pub tf: Option<String>,
    }
}

fn help_of_tf() -> String {
    let presets = PRESETS.join(", ");
    format!(
        "Transfer function: {presets}, or a JSON file {{\"points\": [[x, r, g, b, a], ...]}} with x from 0 to 1 \
         [default: {DEFAULT_PRESET}]"
    )
}

impl TransferOptions {
    fn apply_others(&self, settings: &mut TransferSettings) {
        let Some(tf) = &self.tf else { return };
        *settings = TransferSettings {
            reference: settings.reference,
            reference_unit: settings.reference_unit,
            ..TransferSettings::default()
        };
        // What is neither a preset nor looks like a file is a preset with a typing error.
        let file = tf.contains(['.', '/']) || Path::new(tf).exists();
        if file && !PRESETS.contains(&tf.as_str()) {
            settings.file = Some(PathBuf::from(tf));
        } else {
            settings.preset = Some(tf.clone());
        }
    }
}
