//! The scalar field every method renders: voxel values brought to the scalar range, under a NaN policy.

use std::sync::OnceLock;

use glam::DVec3;
use rayon::prelude::*;

use super::volume::{Volume, VoxelType, Voxels};
use crate::error::{Error, Result};

/// What a voxel that is not a finite number stands for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize, clap::ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum NanPolicy {
    /// NaN and -inf become the low end of the range, +inf the high end, before interpolation.
    #[default]
    Replace,
    /// A cell with a non-finite corner is transparent.
    Hole,
    /// The volume is refused.
    Error,
}

/// A normalised volume. Cells are the boxes between neighbouring voxel centres, (n - 1) of them along a side of
/// n voxels (1 where n is 1); a border cell reaches out to the face of the volume.
#[derive(Clone, Debug)]
pub struct Field {
    /// The volume as read; a texture in its own type is made from it.
    pub volume: Volume,
    /// The scalar range: x = (value - low) / (high - low).
    pub range: [f64; 2],
    /// Each voxel as x, x fastest. Not clamped to [0, 1].
    pub values: Vec<f32>,
    /// Cells that are transparent, whatever they hold (policy `hole`), x fastest; none otherwise.
    pub holes: Option<Vec<bool>>,
    /// Found when first asked for.
    extremes: OnceLock<[f32; 2]>,
}

impl Field {
    /// # Errors
    /// When the range is empty or not finite, or a voxel is not finite under the policy `error`.
    pub fn new(volume: Volume, range: Option<[f64; 2]>, policy: NanPolicy) -> Result<Self> {
        let range = match range {
            Some(range) => range,
            None => natural_range(&volume.voxels),
        };
        let [low, high] = range;
        if !(low.is_finite() && high.is_finite() && low <= high) {
            return Err(Error::input(
                &volume.name,
                format!("has the scalar range [{low}, {high}]"),
                "give a finite range = [low, high] with low <= high",
            ));
        }
        let count = volume.voxels.len();
        let bad = (0..count).into_par_iter().filter(|&i| !volume.voxels.get(i).is_finite()).count();
        if bad > 0 && policy == NanPolicy::Error {
            return Err(Error::input(
                &volume.name,
                format!("holds {bad} voxels that are NaN or infinite"),
                "repair them or choose nan = \"replace\" or \"hole\"",
            ));
        }
        let mut values = Vec::new();
        if values.try_reserve_exact(count).is_err() {
            let problem = format!("finds no memory for {count} voxels in f32");
            return Err(Error::input(&volume.name, problem, "use a smaller volume"));
        }
        values.par_extend((0..count).into_par_iter().map(|i| normalised(volume.voxels.get(i), low, high)));
        let mut field = Self { volume, range, values, holes: None, extremes: OnceLock::new() };
        if bad > 0 && policy == NanPolicy::Hole {
            field.holes = Some(field.cells_where(|corner| !field.volume.voxels.get(corner).is_finite()));
        }
        Ok(field)
    }

    /// The least and the greatest value.
    pub fn extremes(&self) -> [f32; 2] {
        *self.extremes.get_or_init(|| {
            let wider = |[low, high]: [f32; 2], [l, h]: [f32; 2]| [low.min(l), high.max(h)];
            let none = || [f32::INFINITY, f32::NEG_INFINITY];
            self.values.par_iter().map(|&v| [v, v]).reduce(none, wider)
        })
    }

    pub fn dims(&self) -> [usize; 3] {
        self.volume.dims
    }

    /// Cells along each side.
    pub fn cells(&self) -> [usize; 3] {
        self.volume.dims.map(|n| n.saturating_sub(1).max(1))
    }

    /// Sides of the volume in volume space: the longest is 1.
    pub fn extent(&self) -> DVec3 {
        let side: [f64; 3] = std::array::from_fn(|a| self.volume.dims[a] as f64 * self.volume.spacing[a]);
        let longest = side.iter().copied().fold(0.0, f64::max);
        DVec3::from_array(side) / longest
    }

    /// Sides of one voxel in volume space.
    pub fn voxel(&self) -> DVec3 {
        self.extent() / DVec3::from_array(self.volume.dims.map(|n| n as f64))
    }

    /// The finest spacing in volume space: the unit of `step` and of distances.
    pub fn finest(&self) -> f64 {
        self.voxel().min_element()
    }

    /// The eight voxels (fewer where a side has one voxel) that a cell interpolates.
    pub fn corners(&self, cell: [usize; 3]) -> [usize; 8] {
        let [nx, ny, nz] = self.volume.dims;
        std::array::from_fn(|corner| {
            let x = (cell[0] + (corner & 1)).min(nx - 1);
            let y = (cell[1] + (corner >> 1 & 1)).min(ny - 1);
            let z = (cell[2] + (corner >> 2)).min(nz - 1);
            (z * ny + y) * nx + x
        })
    }

    /// The cell a point (voxel space) lies in.
    pub fn cell_at(&self, voxel: DVec3) -> [usize; 3] {
        let cells = self.cells();
        std::array::from_fn(|a| (voxel[a] - 0.5).floor().clamp(0.0, (cells[a] - 1) as f64) as usize)
    }

    /// One flag a cell, x fastest: whether `corner` holds for any of its voxels.
    pub fn cells_where(&self, corner: impl Fn(usize) -> bool + Sync) -> Vec<bool> {
        let [nx, ny, nz] = self.cells();
        (0..nx * ny * nz)
            .into_par_iter()
            .map(|i| self.corners([i % nx, i / nx % ny, i / (nx * ny)]).into_iter().any(&corner))
            .collect()
    }
}

/// The whole range of u8 and u16, the finite minimum and maximum of other types.
fn natural_range(voxels: &Voxels) -> [f64; 2] {
    match voxels.voxel_type() {
        VoxelType::U8 => [0.0, 255.0],
        VoxelType::U16 => [0.0, 65535.0],
        _ => {
            let (low, high) = (0..voxels.len())
                .into_par_iter()
                .map(|i| voxels.get(i))
                .filter(|v| v.is_finite())
                .fold(|| (f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)))
                .reduce(|| (f64::INFINITY, f64::NEG_INFINITY), |a, b| (a.0.min(b.0), a.1.max(b.1)));
            if low <= high { [low, high] } else { [0.0, 1.0] }
        }
    }
}

/// x of a value; where the range is a single value, that value is 0, what lies below is -1 and above 1.
fn normalised(value: f64, low: f64, high: f64) -> f32 {
    let value = if value.is_nan() {
        low
    } else if value.is_infinite() {
        if value > 0.0 { high } else { low }
    } else {
        value
    };
    let x = if high > low {
        // Halved first: the difference of two finite numbers may overflow, that of their halves cannot.
        (0.5 * value - 0.5 * low) / (0.5 * high - 0.5 * low)
    } else if value == low {
        0.0
    } else {
        (value - low).signum()
    };
    x.clamp(f64::from(f32::MIN), f64::from(f32::MAX)) as f32
}
