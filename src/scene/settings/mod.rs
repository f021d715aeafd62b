//! The settings of a run: the scene file's sections and keys, each with its default. A run is repeated from
//! these alone.
//!
//! **How to add a setting**: one entry in its section's file. The macro of `section.rs`, which tells the form of an
//! entry, makes of it the key, its default, the option on the command line with its help, and the check.
//!
//! **How to add a section**: one file as the others, its `mod` line here, and its row in `sections!` at the end of this
//! file: key, settings, options.
//!
//! The test over all settings (`tests/settings.rs`) then asks for an option, a range and an error for each key that is
//! new, and takes a value for an option where it cannot find one itself.

mod adaptive;
mod camera;
mod clip;
mod effects;
mod environment;
mod image;
mod key;
mod layers;
mod light;
mod mesh;
mod method;
mod parse;
mod placed;
mod projection;
mod refraction;
mod sampling;
mod section;
mod shading;
mod shells;
mod surface;
mod transfer;
mod tuned;
mod volume;

use std::path::PathBuf;

use clap::Args;
use serde::{Deserialize, Serialize};

use crate::error::Result;

pub use super::method::{Cull, DepthFormat, Distance, Mark, MethodName};
pub use super::projection::ProjectionName;
pub use super::volume_choice::{Component, Endian, Orientation};
pub use clip::{ClipOptions, ClipSettings};
pub use effects::{CHECKER, Translucency};
pub use environment::{ENVIRONMENTS, Mapping};
pub use image::Accumulate;
pub use key::Key;
pub use layers::PartialSegments;
pub use light::{LightSettings, MOST_LIGHTS};
pub use mesh::MeshSettings;
pub use method::{Builder, CELLS, SliceCut, Tiles};
pub use parse::number as finite_number;
pub use placed::Placed;
pub use refraction::Refraction;
pub use sampling::{Alpha, Classification, EXTRA_FETCHES, ErrorNorm, Filter, Last, Offset};
pub use shading::{GradientOperator, GradientTexture, Gradients};
pub use shells::{MOST_LEVELS, ShellMode, ShellOrder, ShellSum};
pub use surface::{Find, MOST_SURFACES, Refine, Shows, SurfaceLevel};
pub use transfer::ReferenceUnit;
pub use tuned::LeftOpen;
pub use volume::{RAW_SKIP, RAW_SPACING, VolumeTexture};

/// Joins the sections.
macro_rules! sections {
    ($($name:ident: $settings:ident, $options:ident;)*) => {
        $(pub use $name::{$settings, $options};)*

        /// All keys of a scene file.
        #[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
        #[serde(default, deny_unknown_fields, expecting = "the sections of a scene file")]
        pub struct Settings {
            $(pub $name: $settings,)*
            /// Polygons, as an array of tables `[[mesh]]`.
            #[serde(rename = "mesh", skip_serializing_if = "Vec::is_empty")]
            pub meshes: Vec<MeshSettings>,
            /// Geometry that the volume is cut at, as an array of tables `[[clip]]`.
            #[serde(rename = "clip", skip_serializing_if = "Vec::is_empty")]
            pub clips: Vec<ClipSettings>,
            /// Lights on surfaces or on samples, as an array of tables `[[light]]`.
            #[serde(rename = "light", skip_serializing_if = "Vec::is_empty")]
            pub lights: Vec<LightSettings>,
        }

        /// The options of all sections.
        #[derive(Clone, Debug, Default, Args)]
        #[command(mut_args(notes()))]
        pub struct SettingsOptions {
            $(
                #[command(flatten)]
                pub $name: $options,
            )*
            #[command(flatten)]
            pub clips: ClipOptions,
        }

        impl SettingsOptions {
            /// Writes the options that were given over `settings`.
            pub fn apply(&self, settings: &mut Settings) {
                $(self.$name.apply(&mut settings.$name);)*
                self.clips.apply(&mut settings.clips);
            }
        }

        impl Settings {
            /// All keys, section by section.
            pub fn keys() -> Vec<Key> {
                [$($settings::keys()),*].concat()
            }

            /// Whether every value is allowed, before any file is read.
            ///
            /// # Errors
            /// When one is not, by its key and its option.
            pub fn check(&self) -> Result<()> {
                $(self.$name.check()?;)*
                self.meshes.iter().try_for_each(MeshSettings::check)?;
                clip::check(&self.clips)?;
                light::check(&self.lights)
            }
        }
    };
}

/// What puts default and range behind the help of each option that sets a key.
fn notes() -> impl FnMut(clap::Arg) -> clap::Arg {
    let keys = Settings::keys();
    move |arg| match keys.iter().find(|key| key.option.is_some() && arg.get_id() == key.id) {
        Some(key) => {
            let help = arg.get_help().map(ToString::to_string).unwrap_or_default();
            arg.help(help + &key.note())
        }
        None => arg,
    }
}

/// The formats of what frames draw into.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Formats {
    pub accumulate: Accumulate,
    pub depth: DepthFormat,
}

impl Settings {
    /// Whether iso-surfaces show: those that are asked for, or the outermost shell.
    pub fn has_surface(&self) -> bool {
        self.surface.is_asked() || self.shells.mode == Some(ShellMode::Surface)
    }

    /// Distance between samples in voxels of the finest spacing; of adaptive sampling the shortest there may be.
    pub fn step(&self) -> f64 {
        if self.adaptive.importance { self.adaptive.shortest } else { self.sampling.step }
    }

    /// The same as an option.
    pub fn step_in_words(&self) -> String {
        let option = if self.adaptive.importance { "--shortest" } else { "--step" };
        format!("{option} {}", self.step())
    }

    /// Every path of a file that the settings name.
    pub fn paths(&mut self) -> impl Iterator<Item = &mut PathBuf> {
        let meshes = self.meshes.iter_mut().map(|mesh| &mut mesh.path);
        let clips = self.clips.iter_mut().flat_map(|clip| [&mut clip.path, &mut clip.volume]);
        let own = [&mut self.volume.path, &mut self.volume.mesh, &mut self.transfer.file];
        let background = self.effects.behind.iter_mut().filter(|name| name.as_os_str() != CHECKER);
        own.into_iter()
            .chain([&mut self.environment.image, &mut self.effects.file])
            .chain(meshes)
            .chain(clips)
            .flatten()
            .chain(background)
    }

    pub fn formats(&self) -> Formats {
        Formats { accumulate: self.image.accumulate, depth: self.method.depth }
    }
}

sections! {
    volume: VolumeSettings, VolumeOptions;
    transfer: TransferSettings, TransferOptions;
    camera: CameraSettings, CameraOptions;
    layers: LayersSettings, LayersOptions;
    surface: SurfaceSettings, SurfaceOptions;
    shading: ShadingSettings, ShadingOptions;
    environment: EnvironmentSettings, EnvironmentOptions;
    effects: EffectsSettings, EffectsOptions;
    image: ImageSettings, ImageOptions;
    projection: ProjectionSettings, ProjectionOptions;
    shells: ShellsSettings, ShellsOptions;
    sampling: SamplingSettings, SamplingOptions;
    adaptive: AdaptiveSettings, AdaptiveOptions;
    method: MethodSettings, MethodOptions;
}
