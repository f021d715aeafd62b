//! `[volume]`: the voxels, and how they become the scalar that is shown.

use std::path::PathBuf;

use serde::{Deserialize, Serialize};

use super::parse::{counts, number, numbers};
use super::section::section;
use crate::scene::field::{NanPolicy, Normalisation};
use crate::scene::fixed;
use crate::scene::limits::{Allowed, Limits, WrongValue};
use crate::scene::mesh_field::{DEFAULT_BAND, DEFAULT_SIDE};
use crate::scene::range::RangeEnd;
use crate::scene::volume::VoxelType;
use crate::scene::volume_choice::{Component, Endian, Orientation};

/// The distances between the voxels of a raw file of which nothing is said.
pub const RAW_SPACING: [f64; 3] = [1.0; 3];

/// Bytes in front of the voxels of a raw file of which nothing is said.
pub const RAW_SKIP: i64 = 0;

/// Half a code of 8 bits: what no 8-bit picture of a transfer function over the whole range shows.
const DEFAULT_PRECISION: f64 = 1.0 / 512.0;

section! {
    /// The volume: a file, a built-in one or the distance field of a mesh, what is taken of it, and how its voxels become x.
    #[serde(expecting = "the section [volume]")]
    #[command(next_help_heading = "Scene")]
    VolumeSettings, VolumeOptions, "volume";

    /// A file, relative to the scene file
    #[serde(skip_serializing_if = "Option::is_none", with = "crate::scene::file_name")]
    #[arg(skip)]
    path?: PathBuf;

    /// `NAME:SIZE`, see [`crate::scene::builtin`]
    #[serde(skip_serializing_if = "Option::is_none")]
    #[arg(skip)]
    builtin?: String;

    /// A file of PLY, OBJ, STL or glTF, relative to the scene file, whose distance field is the volume
    #[serde(skip_serializing_if = "Option::is_none", with = "crate::scene::file_name")]
    #[arg(skip)]
    mesh?: PathBuf;

    /// Scalar range that the transfer function covers, in the volume's values or as percentiles of them (1%,99%)
    #[serde(skip_serializing_if = "Option::is_none", deserialize_with = "fixed::optional")]
    #[arg(long, value_name = "LOW,HIGH", value_parser = range, allow_hyphen_values = true)]
    range?: [RangeEnd; 2], by ordered, default "the whole range of u8, minimum to maximum of other types";

    /// What a voxel that is not a finite number, or is no data, stands for
    #[arg(long, value_name = "POLICY")]
    nan: NanPolicy = NanPolicy::default();

    /// Values of voxels that stand for no data, such as -9999; they count as NaN and not for the default range
    #[serde(skip_serializing_if = "Vec::is_empty", deserialize_with = "fixed::one_or_more")]
    #[arg(long, value_name = "VALUE,...", value_delimiter = ',', value_parser = number, allow_hyphen_values = true)]
    no_data: Vec<f64> = Vec::new(),
        within Limits::new(Allowed::Finite, "finite numbers; NaN and infinities stand for no value anyway");

    /// Voxels along x, y and z of a raw file (x varies fastest), or of a mesh's distance field
    #[serde(skip_serializing_if = "Option::is_none", deserialize_with = "fixed::optional")]
    #[arg(long, value_name = "X,Y,Z", value_parser = counts, allow_hyphen_values = true)]
    dims?: [usize; 3],
        default format!("of a mesh {DEFAULT_SIDE} along its longest side and what the others take");

    /// Voxels to each side of a mesh's surface in which distances are not clamped
    #[serde(skip_serializing_if = "Option::is_none")]
    #[arg(long, value_name = "VOXELS", allow_negative_numbers = true)]
    band?: f64,
        within Limits::from_to(1.0, 512.0, "a number of voxels {}"),
        default DEFAULT_BAND;

    /// Voxel type of a raw file
    #[serde(skip_serializing_if = "Option::is_none")]
    #[arg(long = "type", value_name = "TYPE")]
    voxel_type as "type"?: VoxelType;

    /// Distances between the voxels of a raw file, in any unit
    #[serde(skip_serializing_if = "Option::is_none", deserialize_with = "fixed::optional")]
    #[arg(long, value_name = "X,Y,Z", value_parser = numbers::<3>, allow_hyphen_values = true)]
    spacing?: [f64; 3], default RAW_SPACING.map(|d| d.to_string()).join(",");

    /// Byte order of the voxels of a raw file
    #[serde(skip_serializing_if = "Option::is_none")]
    #[arg(long, value_name = "ORDER")]
    endian?: Endian, default format!("{:?}", Endian::default()).to_lowercase();

    /// Bytes in front of the voxels of a raw file that are skipped; -1 skips all that the voxels leave over
    #[serde(skip_serializing_if = "Option::is_none")]
    #[arg(long, value_name = "BYTES", allow_negative_numbers = true)]
    skip?: i64,
        within Limits::new(Allowed::AtLeast(-1.0), "a number of bytes, or -1 for all that the voxels leave over"),
        default RAW_SKIP;

    /// Value shown of voxels that have several (colours, vectors): a number from 0, luminance (of Rec. 709) or
    /// magnitude
    #[serde(skip_serializing_if = "Option::is_none")]
    #[arg(long, value_name = "0..N|luminance|magnitude", allow_negative_numbers = true)]
    component?: Component;

    /// Values shown of a mesh of cells that has several, by the name of their array
    #[serde(skip_serializing_if = "Option::is_none")]
    #[arg(long, value_name = "NAME")]
    array?: String, default "the first at points with one value each, else the first";

    /// Volume shown of a file that holds several, or slice of one that is a stack, counted from 0
    #[serde(skip_serializing_if = "Option::is_none")]
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    frame?: usize;

    /// Axes the volume is drawn along: those its file states, or those of its stored voxels
    #[arg(long, value_name = "AXES")]
    orientation: Orientation = Orientation::default();

    /// How voxels are kept on the device
    #[arg(long, value_name = "FORMAT")]
    texture: VolumeTexture = VolumeTexture::default();

    /// How far an interpolated value may be off, as a part of the scalar range: --texture auto takes the smallest
    /// format that the device interpolates as precisely
    #[arg(long, value_name = "X", allow_negative_numbers = true)]
    precision: f64 = DEFAULT_PRECISION, within Limits::from_to(1e-9, 1.0, "a part of the scalar range {}");
}

impl VolumeSettings {
    /// How the volume's voxels become x.
    pub fn normalisation(&self) -> Normalisation<'_> {
        Normalisation { range: self.range, nan: self.nan, no_data: &self.no_data }
    }
}

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

/// `0,255` or `1%,99%` as the ends of a scalar range.
fn range(text: &str) -> Result<[RangeEnd; 2], String> {
    let ends = text.split(',').map(str::parse).collect::<Result<Vec<RangeEnd>, _>>()?;
    ends.try_into().map_err(|ends: Vec<_>| format!("2 ends are needed, and the number given is {}", ends.len()))
}

/// What is wrong with a scalar range: an end that is none, or the high one first.
fn ordered(range: &Option<[RangeEnd; 2]>) -> Option<WrongValue> {
    let range = range.as_ref()?;
    let upside_down = match *range {
        [RangeEnd::Value(low), RangeEnd::Value(high)] | [RangeEnd::Percentile(low), RangeEnd::Percentile(high)] => {
            low > high
        }
        _ => false,
    };
    (upside_down || !range.iter().all(|end| end.is_sound())).then(|| WrongValue {
        problem: format!("is [{}]", range.map(|end| end.to_string()).join(", ")),
        remedy: "give two finite numbers or percentages from 0% to 100%, the low one first".to_owned(),
    })
}
