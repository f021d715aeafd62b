//! `[[light]]`: lights that shine on iso-surfaces or on samples [Thesis §4.2.1].

use glam::DVec3;
use serde::{Deserialize, Serialize};

use crate::error::{Error, Result};
use crate::scene::fixed;
use crate::scene::light::{Light, LightPlace};

/// Lights at the most.
pub const MOST_LIGHTS: usize = 8;

/// The largest exponent of the specular part: beyond it, a highlight is smaller than what single precision tells of a normal.
const LARGEST_SHININESS: f64 = 1e6;

/// A light. Lengths are in volume space: the longest side of the volume is 1, its centre is 0,0,0.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, expecting = "a table [[light]]")]
pub struct LightSettings {
    /// Where the light comes from, of one so far away that all its rays are parallel; of any length but 0.
    #[serde(skip_serializing_if = "Option::is_none", deserialize_with = "fixed::optional")]
    pub direction: Option<[f64; 3]>,
    /// Where the light is, in place of `direction`.
    #[serde(skip_serializing_if = "Option::is_none", deserialize_with = "fixed::optional")]
    pub position: Option<[f64; 3]>,
    /// Linear red, green and blue.
    #[serde(deserialize_with = "fixed::list")]
    pub color: [f64; 3],
    /// The part of the light that comes from all sides.
    pub ambient: f64,
    /// The part of the light that is spread from a surface to all sides.
    pub diffuse: f64,
    /// The part of the light that a surface reflects about its normal.
    pub specular: f64,
    /// The exponent of the specular part: the larger, the smaller is the highlight.
    pub shininess: f64,
}

impl Default for LightSettings {
    fn default() -> Self {
        Self {
            direction: None,
            position: None,
            color: [1.0; 3],
            ambient: 0.1,
            diffuse: 0.7,
            specular: 0.2,
            shininess: 32.0,
        }
    }
}

impl LightSettings {
    /// The light, in volume space.
    pub fn light(&self) -> Light {
        let scaled = |part: f64| self.color.map(|c| c * part);
        let place = match (self.position, self.direction) {
            (Some(position), _) => LightPlace::Position(position.into()),
            (None, direction) => LightPlace::Direction(unit(direction.unwrap_or_default().into())),
        };
        Light {
            place,
            ambient: scaled(self.ambient),
            diffuse: scaled(self.diffuse),
            specular: scaled(self.specular),
            shininess: self.shininess,
        }
    }

    fn check(&self) -> Result<()> {
        let refuse = |key: &str, problem: String, remedy: &str| {
            Err(Error::usage(format!("light.{key}"), problem, remedy.to_owned()))
        };
        let (place, key) = match (self.direction, self.position) {
            (Some(direction), None) => (direction, "direction"),
            (None, Some(position)) => (position, "position"),
            (Some(_), Some(_)) => {
                return refuse("direction", "is given beside position".to_owned(), "keep one of them");
            }
            (None, None) => {
                return refuse(
                    "direction",
                    "is missing, and position too".to_owned(),
                    "give one of direction and position",
                );
            }
        };
        if !place.iter().all(|c| c.abs() <= LARGEST) {
            return refuse(key, format!("is {place:?}"), &format!("give three numbers up to {LARGEST:e}"));
        }
        if key == "direction" && place == [0.0; 3] {
            return refuse(key, "has the length 0".to_owned(), "give the direction that the light comes from");
        }
        if !self.color.iter().all(|c| (0.0..=LARGEST_PART).contains(c)) {
            return refuse(
                "color",
                format!("is {:?}", self.color),
                &format!("give three numbers from 0 to {LARGEST_PART}"),
            );
        }
        let parts = [("ambient", self.ambient), ("diffuse", self.diffuse), ("specular", self.specular)];
        for (key, part) in parts {
            if !(0.0..=LARGEST_PART).contains(&part) {
                return refuse(key, format!("is {part}"), &format!("give a number from 0 to {LARGEST_PART}"));
            }
        }
        if !(0.0..=LARGEST_SHININESS).contains(&self.shininess) {
            let remedy = format!("give a number from 0 to {LARGEST_SHININESS}");
            return refuse("shininess", format!("is {}", self.shininess), &remedy);
        }
        Ok(())
    }
}

/// The largest colour and the largest part of a light: products of two are those of the brightest surfaces.
const LARGEST_PART: f64 = 1e3;

/// Places beyond this have no squares in single precision.
const LARGEST: f64 = 1e15;

/// A vector of length 1, however short or long it was.
fn unit(way: DVec3) -> DVec3 {
    (way / way.abs().max_element()).normalize_or_zero()
}

/// Whether every table is allowed, and all of them together.
///
/// # Errors
/// When one is not, by its key.
pub(super) fn check(lights: &[LightSettings]) -> Result<()> {
    if lights.len() > MOST_LIGHTS {
        let remedy = format!("keep them to {MOST_LIGHTS}");
        return Err(Error::usage("light", format!("has {} tables", lights.len()), remedy));
    }
    lights.iter().try_for_each(LightSettings::check)
}
