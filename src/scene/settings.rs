//! The settings of a run: the scene file's sections and keys, each with its default. A run is repeated from
//! these alone.

use std::path::PathBuf;

use serde::{Deserialize, Serialize};

use super::camera::Camera;
use super::field::{NanPolicy, Normalisation};
use super::fixed;
pub use super::method::{Cull, DepthFormat, Distance, Mark, MethodName};
use super::range::RangeEnd;
use super::volume::VoxelType;
pub use super::volume_choice::{Component, Endian, Orientation};

/// All keys of a scene file.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, expecting = "the sections of a scene file")]
pub struct Settings {
    pub volume: VolumeSettings,
    pub transfer: TransferSettings,
    pub camera: CameraSettings,
    pub image: ImageSettings,
    pub sampling: SamplingSettings,
    pub method: MethodSettings,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, expecting = "the section [volume]")]
pub struct VolumeSettings {
    /// A file, relative to the scene file.
    #[serde(skip_serializing_if = "Option::is_none", with = "super::file_name")]
    pub path: Option<PathBuf>,
    /// `NAME:SIZE`, see [`super::builtin`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub builtin: Option<String>,
    /// The scalar range, in the volume's own values or as percentiles of them.
    #[serde(skip_serializing_if = "Option::is_none", deserialize_with = "fixed::optional")]
    pub range: Option<[RangeEnd; 2]>,
    pub nan: NanPolicy,
    /// Values that stand for no value, in the volume's own unit; the policy `nan` says what becomes of them.
    #[serde(skip_serializing_if = "Vec::is_empty", deserialize_with = "fixed::one_or_more")]
    pub no_data: Vec<f64>,
    /// Sizes, type and spacing of a raw file.
    #[serde(skip_serializing_if = "Option::is_none", deserialize_with = "fixed::optional")]
    pub dims: Option<[usize; 3]>,
    #[serde(rename = "type", skip_serializing_if = "Option::is_none")]
    pub voxel_type: Option<VoxelType>,
    #[serde(skip_serializing_if = "Option::is_none", deserialize_with = "fixed::optional")]
    pub spacing: Option<[f64; 3]>,
    /// The byte order of a raw file.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub endian: Option<Endian>,
    /// Bytes in front of the voxels of a raw file; -1: all that the voxels leave over.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub skip: Option<i64>,
    /// Which value of a voxel is shown where the file holds several.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub component: Option<Component>,
    /// Which volume is shown, counted from 0, where the file holds several, one after another.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub frame: Option<usize>,
    pub orientation: Orientation,
    pub texture: VolumeTexture,
    /// How far an interpolated x may be off before `texture = "auto"` takes a finer format, and a named one is warned of.
    pub precision: f64,
}

impl VolumeSettings {
    /// How the volume's voxels become x.
    pub fn normalisation(&self) -> Normalisation<'_> {
        Normalisation { range: self.range, nan: self.nan, no_data: &self.no_data }
    }
}

impl Default for VolumeSettings {
    fn default() -> Self {
        Self {
            path: None,
            builtin: None,
            range: None,
            nan: NanPolicy::default(),
            no_data: Vec::new(),
            dims: None,
            voxel_type: None,
            spacing: None,
            endian: None,
            skip: None,
            component: None,
            frame: None,
            orientation: Orientation::default(),
            texture: VolumeTexture::default(),
            precision: DEFAULT_PRECISION,
        }
    }
}

/// Half a code of 8 bits: what no 8-bit picture of a transfer function over the whole range shows.
const DEFAULT_PRECISION: f64 = 1.0 / 512.0;

/// Errors of x that can be asked for.
pub const PRECISIONS: std::ops::RangeInclusive<f64> = 1e-9..=1.0;

/// How voxels are kept on the device.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum VolumeTexture {
    /// The smallest format that keeps every value and that the device interpolates as precisely as --precision asks.
    #[default]
    Auto,
    /// As stored: R8 or R16 for 8 and 16 bit integers, R32F for everything else.
    Native,
    /// 16 bits over the values there are.
    R16,
    /// 32-bit float, exact.
    R32f,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, expecting = "the section [transfer]")]
pub struct TransferSettings {
    #[serde(skip_serializing_if = "Option::is_none")]
    pub preset: Option<String>,
    /// A transfer function file, relative to the scene file: `{"points": [[x, r, g, b, a], ...]}`.
    #[serde(skip_serializing_if = "Option::is_none", with = "super::file_name")]
    pub file: Option<PathBuf>,
    /// Points [x, red, green, blue, opacity].
    #[serde(skip_serializing_if = "Option::is_none", deserialize_with = "fixed::optional_lists")]
    pub points: Option<Vec<[f64; 5]>>,
    /// The length an opacity stands for, in voxels of the finest spacing.
    pub reference: f64,
}

impl Default for TransferSettings {
    fn default() -> Self {
        Self { preset: None, file: None, points: None, reference: 1.0 }
    }
}

/// The camera; the default looks along -z at the whole volume (a front face of 428 of 500 pixels, the thesis').
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, expecting = "the section [camera]")]
pub struct CameraSettings {
    #[serde(deserialize_with = "fixed::list")]
    pub eye: [f64; 3],
    #[serde(deserialize_with = "fixed::list")]
    pub target: [f64; 3],
    #[serde(deserialize_with = "fixed::list")]
    pub up: [f64; 3],
    pub fov_y: f64,
}

impl Default for CameraSettings {
    fn default() -> Self {
        Self { eye: [0.0, 0.0, 1.91], target: [0.0; 3], up: [0.0, 1.0, 0.0], fov_y: 45.0 }
    }
}

impl From<&CameraSettings> for Camera {
    fn from(s: &CameraSettings) -> Self {
        Self { eye: s.eye.into(), target: s.target.into(), up: s.up.into(), fov_y: s.fov_y }
    }
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, expecting = "the section [image]")]
pub struct ImageSettings {
    /// Width and height in pixels.
    #[serde(deserialize_with = "fixed::list")]
    pub size: [u32; 2],
    /// Linear light; shows in PNG files where the picture is not opaque.
    #[serde(deserialize_with = "fixed::list")]
    pub background: [f64; 3],
    pub accumulate: Accumulate,
}

impl Default for ImageSettings {
    fn default() -> Self {
        Self { size: [500, 500], background: [0.0; 3], accumulate: Accumulate::Rgba32f }
    }
}

/// The format colours are accumulated in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum Accumulate {
    #[default]
    Rgba32f,
    Rgba16f,
    Rgba8,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, expecting = "the section [sampling]")]
pub struct SamplingSettings {
    /// Distance between samples, in voxels of the finest spacing.
    pub step: f64,
    pub offset: Offset,
    pub last: Last,
    pub alpha: Alpha,
    pub filter: Filter,
    pub classification: Classification,
    /// M: samples per main pass.
    pub samples_per_pass: u32,
    /// N: main passes; 0 takes as many as the longest ray of this view needs.
    pub passes: u32,
    /// T: a ray ends when its opacity is greater.
    pub termination: f64,
    /// An artificial cost: so many further fetches of the volume with each sample, one after another. It changes no picture.
    pub extra_fetches: u32,
}

impl Default for SamplingSettings {
    fn default() -> Self {
        Self {
            step: 1.0,
            offset: Offset::Left,
            last: Last::Full,
            alpha: Alpha::Exponential,
            filter: Filter::Hardware,
            classification: Classification::Post,
            samples_per_pass: 8,
            passes: 0,
            termination: 0.95,
            extra_fetches: 0,
        }
    }
}

impl SamplingSettings {
    /// Whether a sample stands for all values up to the next one, not for its own alone.
    pub fn spans(&self) -> bool {
        self.classification == Classification::PreIntegrated
    }
}

/// What the transfer function is asked for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum Classification {
    /// The value of a sample.
    #[default]
    Post,
    /// All values from one sample to the next, by a table made for the step; the value goes evenly between them.
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

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, expecting = "the section [method]")]
pub struct MethodSettings {
    pub name: MethodName,
    pub cull: Cull,
    pub mark: Mark,
    /// The format of the depth buffer.
    pub depth: DepthFormat,
    /// Mark a ray as gone as soon as its next section lies beyond its end.
    pub exit_lookahead: bool,
    /// Block skipping also tests before the first main pass.
    pub block_first: bool,
    /// Side of a cell of the distance structure, in voxels: one of [`CELLS`].
    pub cell: u32,
    /// `nn-cone`: the half-angle around a voxel's view direction, in degrees: one of [`CONES`].
    pub cone: f64,
    pub build: Builder,
    /// Leave out what the scene does not need; without, everything a method may have is there.
    pub planner: bool,
    /// How often an intermediate pass may look up a distance in a segment: again from where the last one ends, as long as
    /// that is in the segment.
    pub lookups: u32,
}

/// Who builds the distances.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum Builder {
    /// The host for a device that is a CPU, where it is the faster, else the device.
    #[default]
    Auto,
    /// Compute shaders, on the compute queue.
    Device,
    /// The CPU.
    Host,
}

/// The formats of what frames draw into.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Formats {
    pub accumulate: Accumulate,
    pub depth: DepthFormat,
}

impl Settings {
    pub fn formats(&self) -> Formats {
        Formats { accumulate: self.image.accumulate, depth: self.method.depth }
    }
}

/// Sides a cell of a distance structure may have.
pub const CELLS: [u32; 4] = [1, 2, 4, 8];

/// Half-angles a cone may have, degrees.
pub const CONES: std::ops::RangeInclusive<f64> = 0.01..=60.0;

/// Extra fetches a sample may have.
pub const EXTRA_FETCHES: std::ops::RangeInclusive<u32> = 0..=4096;

/// Lookups a segment may have.
pub const LOOKUPS: std::ops::RangeInclusive<u32> = 1..=1024;

impl Default for MethodSettings {
    fn default() -> Self {
        Self {
            name: MethodName::default(),
            cull: Cull::Auto,
            mark: Mark::Auto,
            depth: DepthFormat::D32,
            exit_lookahead: true,
            block_first: false,
            cell: 1,
            cone: 10.0,
            build: Builder::Auto,
            planner: true,
            lookups: 1,
        }
    }
}
