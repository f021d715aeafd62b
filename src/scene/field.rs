//! The scalar field every method renders: voxel values brought to the scalar range, under a NaN policy.

use std::sync::OnceLock;

use glam::DVec3;
use rayon::prelude::*;

use super::range::{self, RangeEnd};
use super::volume::{Volume, VoxelType};
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

/// How voxels become x.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Normalisation<'a> {
    /// The scalar range; without, that of [`range::natural`].
    pub range: Option<[RangeEnd; 2]>,
    pub nan: NanPolicy,
    /// Values that stand for no value: they are treated as NaN.
    pub no_data: &'a [f64],
}

/// The box around a mesh, in volume space, and the unit of lengths there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hull {
    pub extent: DVec3,
    pub unit: f64,
}

/// A normalised volume. Cells are the boxes between neighbouring voxel centres, (n - 1) of them along a side of
/// n voxels (1 where n is 1); a border cell reaches out to the face of the volume.
#[derive(Clone, Debug)]
pub struct Field {
    /// The volume as read; a texture in its own type is made from it.
    pub volume: Volume,
    /// The scalar range: x = (value - low) / (high - low); where both are equal, x is 0 everywhere.
    pub range: [f64; 2],
    /// Each voxel as x, x fastest. Not clamped to [0, 1].
    pub values: Vec<f32>,
    /// Cells that are transparent, whatever they hold (policy `hole`), x fastest; none otherwise.
    pub holes: Option<Vec<bool>>,
    /// Voxels without a finite value: NaN, infinite, or no data.
    pub missing: usize,
    no_data: Vec<f64>,
    /// Where the values are, if not in voxels: at the points of a mesh, which stand in a row here.
    hull: Option<Hull>,
    /// Found when first asked for.
    extremes: OnceLock<[f32; 2]>,
    contrast: OnceLock<f64>,
    value_extremes: OnceLock<Option<[f64; 2]>>,
    block_ranges: OnceLock<Vec<[f32; 2]>>,
}

impl Field {
    /// The field under a range of numbers and a policy, where no value stands for no data.
    ///
    /// # Errors
    /// As [`Field::of`].
    pub fn new(volume: Volume, range: Option<[f64; 2]>, nan: NanPolicy) -> Result<Self> {
        let range = range.map(|ends| ends.map(RangeEnd::Value));
        Self::of(volume, &Normalisation { range, nan, no_data: &[] })
    }

    /// # Errors
    /// When the range is upside down or not finite, or a voxel has no value under the policy `error`.
    pub fn of(volume: Volume, how: &Normalisation) -> Result<Self> {
        let missing = Missing { voxel_type: volume.voxels.voxel_type(), no_data: how.no_data };
        let range = scalar_range(&volume, how.range, &missing)?;
        let count = volume.voxels.len();
        let bad = (0..count).into_par_iter().filter(|&i| missing.is(volume.voxels.get(i))).count();
        if bad > 0 && how.nan == NanPolicy::Error {
            let or = if how.no_data.is_empty() { "" } else { ", or no data" };
            return Err(Error::input(
                &volume.name,
                format!("holds {bad} voxels that are NaN or infinite{or}"),
                "repair them or choose nan = \"replace\" or \"hole\"",
            ));
        }
        let mut values = Vec::new();
        if values.try_reserve_exact(count).is_err() {
            let problem = format!("has {count} voxels, and there is not enough memory for them in f32");
            return Err(Error::input(&volume.name, problem, "use a smaller volume"));
        }
        let x = |i: usize| {
            let value = volume.voxels.get(i);
            // What is infinite keeps its sign; no data has none.
            normalised(if value.is_finite() && missing.is(value) { f64::NAN } else { value }, range)
        };
        values.par_extend((0..count).into_par_iter().map(x));
        let mut field = Self {
            range,
            values,
            holes: None,
            missing: bad,
            no_data: how.no_data.to_vec(),
            hull: None,
            extremes: OnceLock::new(),
            contrast: OnceLock::new(),
            value_extremes: OnceLock::new(),
            block_ranges: OnceLock::new(),
            volume,
        };
        if bad > 0 && how.nan == NanPolicy::Hole {
            field.holes = Some(field.cells_where(|corner| field.is_missing(corner)));
        }
        Ok(field)
    }

    /// The same values at the points of a mesh.
    pub fn within(self, hull: Hull) -> Self {
        Self { hull: Some(hull), holes: None, ..self }
    }

    /// Whether the values are those of a mesh's points, so that there are no voxels.
    pub fn is_of_mesh(&self) -> bool {
        self.hull.is_some()
    }

    /// Whether the voxel has no finite value.
    pub fn is_missing(&self, voxel: usize) -> bool {
        let voxels = &self.volume.voxels;
        Missing { voxel_type: voxels.voxel_type(), no_data: &self.no_data }.is(voxels.get(voxel))
    }

    /// x of a value in the volume's own unit.
    pub fn x(&self, value: f64) -> f32 {
        normalised(value, self.range)
    }

    /// Whether x is 0 everywhere, since the scalar range is a single value.
    pub fn has_empty_range(&self) -> bool {
        self.range[0] == self.range[1]
    }

    /// Least and greatest x in blocks of cells, which whoever asks first finds.
    pub fn block_ranges(&self, find: impl FnOnce(&Self) -> Vec<[f32; 2]>) -> &[[f32; 2]] {
        self.block_ranges.get_or_init(|| find(self))
    }

    /// The least and the greatest value.
    pub fn extremes(&self) -> [f32; 2] {
        *self.extremes.get_or_init(|| {
            let wider = |[low, high]: [f32; 2], [l, h]: [f32; 2]| [low.min(l), high.max(h)];
            let none = || [f32::INFINITY, f32::NEG_INFINITY];
            self.values.par_iter().map(|&v| [v, v]).reduce(none, wider)
        })
    }

    /// The least and the greatest value in the volume's own unit; none where no voxel has one.
    pub fn value_extremes(&self) -> Option<[f64; 2]> {
        *self.value_extremes.get_or_init(|| {
            let voxels = &self.volume.voxels;
            let missing = Missing { voxel_type: voxels.voxel_type(), no_data: &self.no_data };
            range::extremes(voxels, |value| !missing.is(value))
        })
    }

    /// The largest difference of x between neighbours along an axis.
    pub fn contrast(&self) -> f64 {
        *self.contrast.get_or_init(|| {
            let [nx, ny, nz] = self.volume.dims;
            let row = |y: usize, z: usize| &self.values[(z * ny + y) * nx..][..nx];
            let largest = |a: &[f32], b: &[f32]| {
                // In f64: the difference of two f32 may overflow.
                a.iter().zip(b).fold(0.0f64, |most, (a, b)| most.max((f64::from(*a) - f64::from(*b)).abs()))
            };
            let of_row = |i: usize| {
                let (y, z) = (i % ny, i / ny);
                let here = row(y, z);
                let along = largest(&here[1..], here);
                let beside = largest(row((y + 1).min(ny - 1), z), here);
                along.max(beside).max(largest(row(y, (z + 1).min(nz - 1)), here))
            };
            (0..ny * nz).into_par_iter().map(of_row).reduce(|| 0.0, f64::max)
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
        if let Some(hull) = self.hull {
            return hull.extent;
        }
        let side: [f64; 3] = std::array::from_fn(|a| self.volume.dims[a] as f64 * self.volume.spacing[a]);
        let longest = side.iter().copied().fold(0.0, f64::max);
        DVec3::from_array(side) / longest
    }

    /// Sides of one voxel in volume space.
    pub fn voxel(&self) -> DVec3 {
        if let Some(hull) = self.hull {
            return DVec3::splat(hull.unit);
        }
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

/// Which values stand for none.
#[derive(Clone, Copy)]
pub struct Missing<'a> {
    pub voxel_type: VoxelType,
    pub no_data: &'a [f64],
}

impl Missing<'_> {
    pub fn is(&self, value: f64) -> bool {
        // A number of a header or an option has more digits than an f32 that was read.
        let same = |no: &f64| value == *no || (self.voxel_type == VoxelType::F32 && value as f32 == *no as f32);
        !value.is_finite() || self.no_data.iter().any(same)
    }
}

fn scalar_range(volume: &Volume, range: Option<[RangeEnd; 2]>, missing: &Missing) -> Result<[f64; 2]> {
    let has_value = |value: f64| !missing.is(value);
    let Some(ends) = range else { return Ok(range::natural(&volume.voxels, has_value)) };
    let percents = ends.map(|end| match end {
        RangeEnd::Percentile(percent) => percent,
        RangeEnd::Value(_) => 0.0,
    });
    let found = match ends {
        [RangeEnd::Value(_), RangeEnd::Value(_)] => None,
        _ => range::percentiles(&volume.voxels, has_value, percents).map_err(|_| {
            let problem = format!("has {} voxels, and there is not enough memory to sort them", volume.voxels.len());
            Error::input(&volume.name, problem, "give the range in values, or use a smaller volume")
        })?,
    };
    let resolved = [0, 1].map(|i| match (ends[i], found) {
        (RangeEnd::Value(value), _) => value,
        // Where no voxel has a value the range is that of `natural`.
        (RangeEnd::Percentile(_), found) => found.map_or(i as f64, |found| found[i]),
    });
    let [low, high] = resolved;
    if low.is_finite() && high.is_finite() && low <= high {
        return Ok(resolved);
    }
    let given = ends.map(|end| end.to_string()).join(", ");
    let meant = if found.is_some() { format!(", which is {low} to {high}") } else { String::new() };
    Err(Error::input(
        &volume.name,
        format!("has the scalar range [{given}]{meant}"),
        "give a finite range = [low, high] with low <= high",
    ))
}

/// x of a value. NaN stands for the low end.
pub(super) fn normalised(value: f64, [low, high]: [f64; 2]) -> f32 {
    let value = match value {
        value if value.is_nan() => low,
        f64::INFINITY => high,
        f64::NEG_INFINITY => low,
        value => value,
    };
    // Halved first: the difference of two finite numbers may overflow, that of their halves cannot. Halves of the least
    // numbers lose digits; their differences are in no danger.
    let half = if high - low > 1.0 { 0.5 } else { 1.0 };
    let x = if high > low { (half * value - half * low) / (half * high - half * low) } else { 0.0 };
    x.clamp(f64::from(f32::MIN), f64::from(f32::MAX)) as f32
}
