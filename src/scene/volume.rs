//! A volume as its file holds it: typed voxels, dimensions, spacing, and how it lies in space.

use glam::DQuat;

use crate::error::{Error, Result};

/// Voxels in the type of their source, x fastest, then y, then z.
#[derive(Clone, Debug, PartialEq)]
pub enum Voxels {
    U8(Vec<u8>),
    I8(Vec<i8>),
    U16(Vec<u16>),
    I16(Vec<i16>),
    U32(Vec<u32>),
    I32(Vec<i32>),
    U64(Vec<u64>),
    I64(Vec<i64>),
    F32(Vec<f32>),
    F64(Vec<f64>),
}

/// The type of one voxel, by the names of the command line (`--type u8`).
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize, clap::ValueEnum)]
#[serde(rename_all = "lowercase")]
#[value(rename_all = "lowercase")]
pub enum VoxelType {
    U8,
    I8,
    U16,
    I16,
    U32,
    I32,
    U64,
    I64,
    F32,
    F64,
}

impl VoxelType {
    pub fn bytes(self) -> usize {
        match self {
            Self::U8 | Self::I8 => 1,
            Self::U16 | Self::I16 => 2,
            Self::U32 | Self::I32 | Self::F32 => 4,
            Self::U64 | Self::I64 | Self::F64 => 8,
        }
    }
}

/// Runs `$body` with `$v` bound to the typed vector inside.
macro_rules! each_type {
    ($voxels:expr, $v:ident => $body:expr) => {
        match $voxels {
            Voxels::U8($v) => $body,
            Voxels::I8($v) => $body,
            Voxels::U16($v) => $body,
            Voxels::I16($v) => $body,
            Voxels::U32($v) => $body,
            Voxels::I32($v) => $body,
            Voxels::U64($v) => $body,
            Voxels::I64($v) => $body,
            Voxels::F32($v) => $body,
            Voxels::F64($v) => $body,
        }
    };
}

pub(crate) use each_type;

impl Voxels {
    pub fn len(&self) -> usize {
        each_type!(self, v => v.len())
    }

    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The voxel at `index`: without loss, but for 64-bit integers beyond 2^53, which are rounded to the nearest f64.
    #[allow(clippy::unnecessary_cast)]
    pub fn get(&self, index: usize) -> f64 {
        each_type!(self, v => v[index] as f64)
    }

    pub fn voxel_type(&self) -> VoxelType {
        match self {
            Self::U8(_) => VoxelType::U8,
            Self::I8(_) => VoxelType::I8,
            Self::U16(_) => VoxelType::U16,
            Self::I16(_) => VoxelType::I16,
            Self::U32(_) => VoxelType::U32,
            Self::I32(_) => VoxelType::I32,
            Self::U64(_) => VoxelType::U64,
            Self::I64(_) => VoxelType::I64,
            Self::F32(_) => VoxelType::F32,
            Self::F64(_) => VoxelType::F64,
        }
    }
}

/// A volume as read: what it is called, its voxels and how far apart they are.
#[derive(Clone, Debug, PartialEq)]
pub struct Volume {
    /// The file's path or `builtin:NAME:SIZE`, as the user gave it.
    pub name: String,
    /// Voxels along x, y and z, each at least 1.
    pub dims: [usize; 3],
    /// Distance of voxel centres along x, y and z, in the source's unit; finite and positive.
    pub spacing: [f64; 3],
    pub voxels: Voxels,
    /// How the volume lies in volume space: the rotation from its own axes to those of volume space.
    pub turn: DQuat,
    /// What reading did with the file that its user may want to know: one sentence each, for outputs and reports.
    pub notes: Vec<String>,
    /// What may make a picture of the volume mislead, one sentence each.
    pub warnings: Vec<String>,
}

impl Volume {
    /// # Errors
    /// When a dimension is 0, a spacing is not finite and positive, or the voxels are not `dims` many.
    pub fn new(name: impl Into<String>, dims: [usize; 3], spacing: [f64; 3], voxels: Voxels) -> Result<Self> {
        let name = name.into();
        if dims.contains(&0) {
            return Err(Error::input(
                name,
                format!("has no voxels along one side ({dims:?})"),
                "give three sizes of at least 1",
            ));
        }
        if !spacing.iter().all(|s| s.is_finite() && *s > 0.0) {
            return Err(Error::input(
                name,
                format!("has the spacing {spacing:?}"),
                "give three finite, positive distances",
            ));
        }
        let count = dims.iter().try_fold(1usize, |n, &d| n.checked_mul(d));
        if count != Some(voxels.len()) {
            return Err(Error::input(
                name,
                format!("holds {} voxels where its sizes {dims:?} ask for another number", voxels.len()),
                "correct the sizes or complete the data",
            ));
        }
        Ok(Self { name, dims, spacing, voxels, turn: DQuat::IDENTITY, notes: Vec::new(), warnings: Vec::new() })
    }
}
