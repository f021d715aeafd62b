//! The scalar range: the values that x runs over from 0 to 1, given as numbers, as percentiles, or not at all.

use std::collections::TryReserveError;
use std::fmt;

use rayon::prelude::*;
use serde::de::{Error as _, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::volume::{VoxelType, Voxels};

/// One end of the scalar range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RangeEnd {
    /// A value in the volume's own unit.
    Value(f64),
    /// The least value that so many per cent of the voxels with a value do not exceed; 0 is the minimum, 100 the maximum.
    Percentile(f64),
}

impl RangeEnd {
    /// Whether the number can be one: finite, a percentile from 0 to 100.
    pub fn is_sound(self) -> bool {
        match self {
            Self::Value(value) => value.is_finite(),
            Self::Percentile(percent) => (0.0..=100.0).contains(&percent),
        }
    }
}

impl From<f64> for RangeEnd {
    fn from(value: f64) -> Self {
        Self::Value(value)
    }
}

impl fmt::Display for RangeEnd {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Value(value) => write!(f, "{value}"),
            Self::Percentile(percent) => write!(f, "{percent}%"),
        }
    }
}

impl std::str::FromStr for RangeEnd {
    type Err = String;

    /// `12.5` or `99%`.
    fn from_str(text: &str) -> Result<Self, String> {
        let text = text.trim();
        let (number, end): (&str, fn(f64) -> Self) = match text.strip_suffix('%') {
            Some(percent) => (percent.trim_end(), Self::Percentile),
            None => (text, Self::Value),
        };
        let end = number.parse().ok().map(end).filter(|end| end.is_sound());
        end.ok_or_else(|| format!("`{text}` is neither a finite number nor a percentage from 0% to 100%"))
    }
}

impl Serialize for RangeEnd {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Value(value) => serializer.serialize_f64(*value),
            Self::Percentile(_) => serializer.collect_str(self),
        }
    }
}

impl<'de> Deserialize<'de> for RangeEnd {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct End;
        impl Visitor<'_> for End {
            type Value = RangeEnd;

            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("a number, or a percentage such as \"99%\"")
            }

            fn visit_f64<E>(self, value: f64) -> Result<RangeEnd, E> {
                Ok(RangeEnd::Value(value))
            }

            fn visit_i64<E>(self, value: i64) -> Result<RangeEnd, E> {
                Ok(RangeEnd::Value(value as f64))
            }

            fn visit_u64<E>(self, value: u64) -> Result<RangeEnd, E> {
                Ok(RangeEnd::Value(value as f64))
            }

            fn visit_str<E: serde::de::Error>(self, text: &str) -> Result<RangeEnd, E> {
                match text.parse() {
                    Ok(end @ RangeEnd::Percentile(_)) => Ok(end),
                    _ => Err(E::invalid_value(serde::de::Unexpected::Str(text), &self)),
                }
            }
        }
        deserializer.deserialize_any(End).map_err(D::Error::custom)
    }
}

/// The range where nothing is said: all of u8, else the least and the greatest value. `has_value` says which voxels have
/// one. [0, 1] where none has.
pub fn natural(voxels: &Voxels, has_value: impl Fn(f64) -> bool + Sync) -> [f64; 2] {
    if voxels.voxel_type() == VoxelType::U8 {
        return [0.0, 255.0];
    }
    extremes(voxels, has_value).unwrap_or([0.0, 1.0])
}

/// The least and the greatest value of the voxels that have one; none where none has.
pub fn extremes(voxels: &Voxels, has_value: impl Fn(f64) -> bool + Sync) -> Option<[f64; 2]> {
    let none = || [f64::INFINITY, f64::NEG_INFINITY];
    let [low, high] = (0..voxels.len())
        .into_par_iter()
        .map(|i| voxels.get(i))
        .filter(|v| has_value(*v))
        .fold(none, |[low, high], v| [low.min(v), high.max(v)])
        .reduce(none, |a, b| [a[0].min(b[0]), a[1].max(b[1])]);
    (low <= high).then_some([low, high])
}

/// The values that so many per cent of the voxels with a value do not exceed, by nearest rank; none where no voxel has a
/// value.
///
/// # Errors
/// When there is not enough memory to sort them.
pub fn percentiles(
    voxels: &Voxels,
    has_value: impl Fn(f64) -> bool + Sync,
    percents: [f64; 2],
) -> Result<Option<[f64; 2]>, TryReserveError> {
    let mut values: Vec<f64> = Vec::new();
    values.try_reserve_exact(voxels.len())?;
    values.par_extend((0..voxels.len()).into_par_iter().map(|i| voxels.get(i)).filter(|v| has_value(*v)));
    let Some(last) = values.len().checked_sub(1) else { return Ok(None) };
    Ok(Some(percents.map(|percent| {
        // Multiplied first: a whole number of voxels stays one.
        let rank = (percent * values.len() as f64 / 100.0).ceil() as usize;
        *values.select_nth_unstable_by(rank.saturating_sub(1).min(last), f64::total_cmp).1
    })))
}
