//! `[environment]`: what iso-surfaces reflect [Thesis §4.3].

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::section::section;
use crate::scene::limits::Limits;

/// Parts of a colour.
const PARTS: Limits = Limits::from_to(0.0, 1.0, "a part {}");

/// The built-in environments: a sky, and the scene's opaque polygons in front of it.
pub const ENVIRONMENTS: [&str; 2] = ["sky", "polygons"];

section! {
    /// What iso-surfaces reflect; of image and builtin there is one at the most.
    #[serde(expecting = "the section [environment]")]
    #[command(next_help_heading = "Surface")]
    EnvironmentSettings, EnvironmentOptions, "environment";

    /// A picture of all that is around the volume, relative to the scene file: PNG, Radiance HDR or OpenEXR
    #[serde(skip_serializing_if = "Option::is_none", with = "crate::scene::file_name")]
    #[arg(skip)]
    image?: PathBuf;

    /// A built-in environment
    #[serde(skip_serializing_if = "Option::is_none")]
    #[arg(skip)]
    builtin?: String;

    /// Which direction each place of an environment's picture shows
    #[arg(long, value_name = "LAYOUT")]
    mapping: Mapping = Mapping::Latlong;

    /// Part of a surface's colour that is what it reflects of the environment
    #[arg(long, value_name = "PART", allow_negative_numbers = true)]
    reflectivity: f64 = 0.5, within PARTS;

    options {
        /// What surfaces reflect: one of [`ENVIRONMENTS`], or a file; takes the place of image and builtin
        #[arg(long, value_name = "NAME|FILE", help = help_of_environment())]
        pub environment: Option<String>,
    }
}

fn help_of_environment() -> String {
    format!("What surfaces reflect: {}, or a picture as PNG, Radiance HDR or OpenEXR", ENVIRONMENTS.join(", "))
}

impl EnvironmentOptions {
    fn apply_others(&self, settings: &mut EnvironmentSettings) {
        let Some(environment) = &self.environment else { return };
        // What is neither built in nor looks like a file is a name with a typing error.
        let file = environment.contains(['.', '/']) || Path::new(environment).exists();
        (settings.image, settings.builtin) = match file && !ENVIRONMENTS.contains(&environment.as_str()) {
            true => (Some(PathBuf::from(environment)), None),
            false => (None, Some(environment.clone())),
        };
    }
}

/// Which direction of volume space each place of a picture shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum Mapping {
    /// Rows from +y on top to -y, columns once around: the middle one is seen along -z, those right of it towards +x.
    #[default]
    Latlong,
    /// A mirror ball, seen from +z from far away, that fills the picture.
    Sphere,
}
