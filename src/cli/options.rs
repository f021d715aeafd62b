//! Options that several commands share, and how they change the settings of a scene. Every one of them has its
//! key in a scene file; an option given on the command line wins.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use clap::Args;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};

use crate::error::{Result, shown};
use crate::method;
use crate::part::rows::Method;
use crate::read;
use crate::scene::Camera;
use crate::scene::field::NanPolicy;
use crate::scene::range::RangeEnd;
use crate::scene::settings::{
    Accumulate, Alpha, Builder, Classification, Component, Cull, DepthFormat, Endian, Filter, Last, Mark, MethodName,
    Offset, Orientation, Settings, TransferSettings, VolumeTexture,
};
use crate::scene::transfer::PRESETS;
use crate::scene::volume::VoxelType;

/// What to show and how to sample it.
#[derive(Clone, Debug, Default, Args)]
#[command(next_help_heading = "Scene")]
pub struct SceneOptions {
    /// Transfer function: ramp, surface, haze, linear, or a JSON file {"points": [[x, r, g, b, a], ...]} with x from 0
    /// to 1 [default: ramp]
    #[arg(long, value_name = "NAME|FILE")]
    tf: Option<String>,
    /// Length an opacity stands for, in voxels of the finest spacing [default: 1]
    #[arg(long, value_name = "VOXELS", allow_negative_numbers = true)]
    reference: Option<f64>,
    /// Scalar range that the transfer function covers, in the volume's values or as percentiles of them (1%,99%)
    /// [default: the whole range of u8, minimum to maximum of other types]
    #[arg(long, value_name = "LOW,HIGH", value_parser = range, allow_hyphen_values = true)]
    range: Option<[RangeEnd; 2]>,
    /// What a voxel that is not a finite number, or is no data, stands for [default: replace]
    #[arg(long, value_name = "POLICY")]
    nan: Option<NanPolicy>,
    /// Values of voxels that stand for no data, such as -9999; they count as NaN and not for the default range
    #[arg(long, value_name = "VALUE,...", value_delimiter = ',', value_parser = number, allow_hyphen_values = true)]
    no_data: Option<Vec<f64>>,
    /// Voxels along x, y and z of a raw file (x varies fastest)
    #[arg(long, value_name = "X,Y,Z", value_parser = counts, allow_hyphen_values = true)]
    dims: Option<[usize; 3]>,
    /// Voxel type of a raw file
    #[arg(long = "type", value_name = "TYPE")]
    voxel_type: Option<VoxelType>,
    /// Distances between the voxels of a raw file, in any unit [default: 1,1,1]
    #[arg(long, value_name = "X,Y,Z", value_parser = numbers::<3>, allow_hyphen_values = true)]
    spacing: Option<[f64; 3]>,
    /// Byte order of the voxels of a raw file [default: little]
    #[arg(long, value_name = "ORDER")]
    endian: Option<Endian>,
    /// Bytes in front of the voxels of a raw file that are skipped; -1 skips all that the voxels leave over [default: 0]
    #[arg(long, value_name = "BYTES", allow_negative_numbers = true)]
    skip: Option<i64>,
    /// Value shown of voxels that have several (colours, vectors): a number from 0, luminance (of Rec. 709) or magnitude
    #[arg(long, value_name = "0..N|luminance|magnitude", allow_negative_numbers = true)]
    component: Option<Component>,
    /// Volume shown of a file that holds several, or slice of one that is a stack, counted from 0
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    frame: Option<usize>,
    /// Axes the volume is drawn along: those its file states, or those of its stored voxels [default: file]
    #[arg(long, value_name = "AXES")]
    orientation: Option<Orientation>,
    /// How voxels are kept on the device [default: auto]
    #[arg(long, value_name = "FORMAT")]
    texture: Option<VolumeTexture>,
    /// How far an interpolated value may be off, as a part of the scalar range: --texture auto takes the smallest format
    /// that the device interpolates as precisely [default: 0.001953125]
    #[arg(long, value_name = "X", allow_negative_numbers = true)]
    precision: Option<f64>,

    /// Picture size in pixels [default: 500x500]
    #[arg(long, value_name = "WxH", value_parser = viewport, allow_hyphen_values = true, help_heading = "View")]
    pub(super) viewport: Option<[u32; 2]>,
    /// Eye in volume space: the longest side of the volume is 1, its centre 0,0,0 [default: 0,0,1.91]
    #[arg(long, value_name = "X,Y,Z", value_parser = numbers::<3>, allow_hyphen_values = true, help_heading = "View")]
    eye: Option<[f64; 3]>,
    /// Point looked at, in volume space [default: 0,0,0]
    #[arg(long, value_name = "X,Y,Z", value_parser = numbers::<3>, allow_hyphen_values = true, help_heading = "View")]
    target: Option<[f64; 3]>,
    /// Direction that is up in the picture [default: 0,1,0]
    #[arg(long, value_name = "X,Y,Z", value_parser = numbers::<3>, allow_hyphen_values = true, help_heading = "View")]
    up: Option<[f64; 3]>,
    /// Vertical field of view, above 0 and below 180 degrees [default: 45]
    #[arg(long, value_name = "DEGREES", allow_negative_numbers = true, help_heading = "View")]
    fov: Option<f64>,
    /// Eye on a sphere about 0,0,0 instead of --eye: turned from +z towards +x [default: 0]
    #[arg(long, value_name = "DEGREES", allow_negative_numbers = true, conflicts_with = "eye", help_heading = "View")]
    azimuth: Option<f64>,
    /// And lifted towards +y [default: 0]
    #[arg(long, value_name = "DEGREES", allow_negative_numbers = true, conflicts_with = "eye", help_heading = "View")]
    elevation: Option<f64>,
    /// At this distance from 0,0,0, in longest sides of the volume [default: 1.91]
    #[arg(long, value_name = "SIDES", allow_negative_numbers = true, conflicts_with = "eye", help_heading = "View")]
    distance: Option<f64>,
    /// Colour behind the volume in PNG files, linear light from 0 to 1 [default: 0,0,0]
    #[arg(long, value_name = "R,G,B", value_parser = numbers::<3>, allow_hyphen_values = true, help_heading = "View")]
    background: Option<[f64; 3]>,
    /// Format colours are accumulated in [default: rgba32f]
    #[arg(long, value_name = "FORMAT", help_heading = "View")]
    accumulate: Option<Accumulate>,

    /// Distance between samples, in voxels of the finest spacing [default: 1]
    #[arg(long, value_name = "VOXELS", allow_negative_numbers = true, help_heading = "Sampling")]
    step: Option<f64>,
    /// Where in its step a sample is taken [default: left]
    #[arg(long, value_name = "PLACE", help_heading = "Sampling")]
    offset: Option<Offset>,
    /// What the last sample of a ray stands for [default: full]
    #[arg(long, value_name = "LENGTH", help_heading = "Sampling")]
    last: Option<Last>,
    /// How opacities are brought to the step [default: exponential]
    #[arg(long, value_name = "RULE", help_heading = "Sampling")]
    alpha: Option<Alpha>,
    /// Who interpolates the volume [default: hardware]
    #[arg(long, value_name = "WHO", help_heading = "Sampling")]
    filter: Option<Filter>,
    /// What the transfer function is asked for: values of samples, or all values from one to the next [default: post]
    #[arg(long, value_name = "WHAT", help_heading = "Sampling")]
    classification: Option<Classification>,
    /// M, samples per main pass [default: 8]
    #[arg(long, value_name = "M", allow_negative_numbers = true, help_heading = "Sampling")]
    samples_per_pass: Option<u32>,
    /// N, main passes; 0 takes as many as the longest ray of the view needs [default: 0]
    #[arg(long, value_name = "N", allow_negative_numbers = true, help_heading = "Sampling")]
    passes: Option<u32>,
    /// T, a ray ends when its opacity is greater, as in the papers: up to 1 - T of what lies behind, the background
    /// included, then stays as it was; 1 ends none early [default: 0.95]
    #[arg(long, value_name = "OPACITY", allow_negative_numbers = true, help_heading = "Sampling")]
    pub(super) termination: Option<f64>,
    /// Artificial cost of a sample: so many further fetches, one after another, which change no picture [default: 0]
    #[arg(long, value_name = "N", allow_negative_numbers = true, help_heading = "Sampling")]
    extra_fetches: Option<u32>,
}

/// Which passes, and how fragments are culled and marked.
#[derive(Clone, Debug, Default, Args)]
#[command(next_help_heading = "Method")]
pub struct MethodOptions {
    /// How fragments are culled [default: auto]
    #[arg(long, value_name = "TEST")]
    pub cull: Option<Cull>,
    /// How the intermediate pass stores its decision [default: auto]
    #[arg(long, value_name = "WAY")]
    pub mark: Option<Mark>,
    /// Format of the depth buffer, in which passes are told apart [default: d32]
    #[arg(long = "depth-format", value_name = "FORMAT")]
    depth: Option<DepthFormat>,
    /// nn-*: notice that a ray has left the volume only on arrival, as the papers do
    #[arg(long)]
    no_exit_lookahead: bool,
    /// Leave nothing out that the method may have, whether the scene needs it or not: the planner's savings
    #[arg(long)]
    no_planner: bool,
    /// rc-block: test for empty blocks before the first main pass too
    #[arg(long)]
    pub block_first: bool,
    /// nn-*: side of a cell of the distance structure in voxels: 1, 2, 4 or 8 [default: 1]
    #[arg(long, value_name = "VOXELS", allow_negative_numbers = true)]
    cell: Option<u32>,
    /// nn-cone: half-angle around the view direction [default: 10]
    #[arg(long, value_name = "DEGREES", allow_negative_numbers = true)]
    cone: Option<f64>,
    /// nn-*: how often a ray may look up a distance in a segment before it has to run there; 1 is the thesis'
    /// [default: 1]
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    lookups: Option<u32>,
    /// nn-*: who builds the distances [default: auto]
    #[arg(long, value_name = "WHO")]
    build: Option<Builder>,
}

impl SceneOptions {
    /// The settings of `scene` (a scene file, a volume, `builtin:NAME:SIZE`, or nothing) under these options.
    ///
    /// # Errors
    /// When a scene file cannot be read.
    pub fn settings(&self, scene: Option<&OsStr>) -> Result<Settings> {
        let mut settings = Settings::default();
        match scene {
            None => {}
            Some(name) if is_scene_file(name) => settings = read::settings(Path::new(name))?,
            Some(name) => match name.to_str().and_then(|name| name.strip_prefix("builtin:")) {
                Some(spec) => settings.volume.builtin = Some(spec.to_owned()),
                None => settings.volume.path = Some(PathBuf::from(name)),
            },
        }
        self.apply(&mut settings);
        Ok(settings)
    }

    /// Writes the options that were given over `settings`.
    pub fn apply(&self, settings: &mut Settings) {
        /// Over the key where the option was given.
        fn put<T: Clone>(key: &mut T, option: &Option<T>) {
            if let Some(value) = option {
                *key = value.clone();
            }
        }
        fn put_some<T: Clone>(key: &mut Option<T>, option: &Option<T>) {
            if option.is_some() {
                key.clone_from(option);
            }
        }
        if let Some(tf) = &self.tf {
            let reference = settings.transfer.reference;
            settings.transfer = TransferSettings { reference, ..TransferSettings::default() };
            // What is neither a preset nor looks like a file is a preset with a typing error.
            let file = tf.contains(['.', '/']) || Path::new(tf).exists();
            if file && !PRESETS.contains(&tf.as_str()) {
                settings.transfer.file = Some(PathBuf::from(tf));
            } else {
                settings.transfer.preset = Some(tf.clone());
            }
        }
        put(&mut settings.transfer.reference, &self.reference);
        let volume = &mut settings.volume;
        put_some(&mut volume.range, &self.range);
        put(&mut volume.nan, &self.nan);
        put_some(&mut volume.dims, &self.dims);
        put_some(&mut volume.voxel_type, &self.voxel_type);
        put_some(&mut volume.spacing, &self.spacing);
        put(&mut volume.no_data, &self.no_data);
        put_some(&mut volume.endian, &self.endian);
        put_some(&mut volume.skip, &self.skip);
        put_some(&mut volume.component, &self.component);
        put_some(&mut volume.frame, &self.frame);
        put(&mut volume.orientation, &self.orientation);
        put(&mut volume.texture, &self.texture);
        put(&mut volume.precision, &self.precision);
        let image = &mut settings.image;
        put(&mut image.size, &self.viewport);
        put(&mut image.background, &self.background);
        put(&mut image.accumulate, &self.accumulate);
        let camera = &mut settings.camera;
        put(&mut camera.fov_y, &self.fov);
        put(&mut camera.eye, &self.eye);
        put(&mut camera.target, &self.target);
        put(&mut camera.up, &self.up);
        if self.azimuth.is_some() || self.elevation.is_some() || self.distance.is_some() {
            let [azimuth, elevation] = [self.azimuth, self.elevation].map(Option::unwrap_or_default);
            let orbit = Camera::orbit(azimuth, elevation, self.distance.unwrap_or(1.91), camera.fov_y);
            camera.eye = orbit.eye.to_array();
        }
        let sampling = &mut settings.sampling;
        put(&mut sampling.step, &self.step);
        put(&mut sampling.offset, &self.offset);
        put(&mut sampling.last, &self.last);
        put(&mut sampling.alpha, &self.alpha);
        put(&mut sampling.filter, &self.filter);
        put(&mut sampling.classification, &self.classification);
        put(&mut sampling.samples_per_pass, &self.samples_per_pass);
        put(&mut sampling.passes, &self.passes);
        put(&mut sampling.termination, &self.termination);
        put(&mut sampling.extra_fetches, &self.extra_fetches);
    }
}

impl MethodOptions {
    /// Writes the options that were given over `settings`.
    pub fn apply(&self, settings: &mut Settings) {
        let method = &mut settings.method;
        method.cull = self.cull.unwrap_or(method.cull);
        method.mark = self.mark.unwrap_or(method.mark);
        method.depth = self.depth.unwrap_or(method.depth);
        method.exit_lookahead &= !self.no_exit_lookahead;
        method.planner &= !self.no_planner;
        method.block_first |= self.block_first;
        method.cell = self.cell.unwrap_or(method.cell);
        method.cone = self.cone.unwrap_or(method.cone);
        method.lookups = self.lookups.unwrap_or(method.lookups);
        method.build = self.build.unwrap_or(method.build);
    }
}

/// Whether a scene is named by its file, not by its volume.
pub fn is_scene_file(name: &OsStr) -> bool {
    name.as_encoded_bytes().ends_with(b".toml")
}

/// What a scene is called in tables: the file without its folder, or the built-in volume.
pub fn scene_name(settings: &Settings) -> String {
    let volume = &settings.volume;
    let file = volume.path.as_deref().and_then(Path::file_stem).map(|s| s.to_string_lossy().into_owned());
    let built_in = || volume.builtin.clone().unwrap_or_else(|| "shells:64".to_owned());
    let transfer = &settings.transfer;
    let tf = match (&transfer.preset, &transfer.file) {
        (Some(name), _) => name.clone(),
        (None, Some(file)) => file.file_stem().map(|s| s.to_string_lossy().into_owned()).unwrap_or_default(),
        (None, None) if transfer.points.is_some() => "points".to_owned(),
        (None, None) => PRESETS[0].to_owned(),
    };
    // A name may hold what a terminal obeys.
    shown(&format!("{}, {tf}", file.unwrap_or_else(built_in)).replace('\n', "\\n"))
}

/// The names of methods, each with what it is.
pub(super) fn method_parser() -> impl TypedValueParser<Value = MethodName> {
    let value = |method: &Method| PossibleValue::new(method.name).help(format!("{} [{}]", method.about, method.source));
    PossibleValuesParser::new(method::METHODS.map(value)).try_map(|name| name.parse::<MethodName>())
}

/// Every method that is shown for a scene when none is asked for.
pub const BENCH_METHODS: [MethodName; 8] = [
    method::RC.name(),
    method::RC_ERT.name(),
    method::RC_BLOCK.name(),
    method::NN_OMNI.name(),
    method::NN_DIRECTIONAL.name(),
    method::NN_CONE.name(),
    method::NN_OPTIMAL.name(),
    method::NN_OPTIMAL_FUSED.name(),
];

/// `256,256,128` as sizes of a volume.
fn counts(text: &str) -> Result<[usize; 3], String> {
    list(text, |part| part.parse().ok().filter(|n| *n > 0), "not a number of voxels of at least 1")
}

/// `0,255` or `1%,99%` as the ends of a scalar range.
fn range(text: &str) -> Result<[RangeEnd; 2], String> {
    let ends = text.split(',').map(str::parse).collect::<Result<Vec<RangeEnd>, _>>()?;
    ends.try_into().map_err(|ends: Vec<_>| format!("2 ends are needed, and the number given is {}", ends.len()))
}

/// A finite number.
fn number(text: &str) -> Result<f64, String> {
    let number = text.trim().parse().ok().filter(|n: &f64| n.is_finite());
    number.ok_or_else(|| format!("`{text}` is not a finite number"))
}

/// `1,2,3` as N finite numbers.
fn numbers<const N: usize>(text: &str) -> Result<[f64; N], String> {
    list(text, |part| part.parse().ok().filter(|n: &f64| n.is_finite()), "not a finite number")
}

/// N entries with commas between; `no` says what an entry is not that `entry` does not take.
fn list<T, const N: usize>(text: &str, entry: impl Fn(&str) -> Option<T>, no: &str) -> Result<[T; N], String> {
    let one = |part: &str| entry(part.trim()).ok_or_else(|| format!("`{part}` is {no}"));
    let entries: Vec<T> = text.split(',').map(one).collect::<Result<_, _>>()?;
    entries.try_into().map_err(|e: Vec<T>| format!("{N} numbers are needed, and the number given is {}", e.len()))
}

/// `500x500` as width and height.
fn viewport(text: &str) -> Result<[u32; 2], String> {
    let (width, height) = text.split_once('x').ok_or("give WIDTHxHEIGHT, 500x500 for example")?;
    let side = |part: &str| part.trim().parse::<u32>().map_err(|_| format!("`{part}` is not a number of pixels"));
    Ok([side(width)?, side(height)?])
}
