//! What is taken of a volume file that holds more than one scalar volume, and how a file's bytes and axes are meant.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Deserializer, Serialize, Serializer, de};

/// The byte order of a raw file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum Endian {
    /// The lowest byte of a number comes first.
    #[default]
    Little,
    /// The highest byte of a number comes first.
    Big,
}

/// Which axes the volume is drawn along.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum Orientation {
    /// The volume lies as its file says: x of the file's space is x of volume space.
    #[default]
    File,
    /// The volume's own axes are those of volume space, in the order its voxels are stored.
    Index,
}

/// What is shown of voxels that have several values: colours, vectors, lists.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Component {
    /// The value of this number, counted from 0.
    Number(usize),
    /// The brightness of the first three values, taken as red, green and blue of Rec. 709.
    Luminance,
    /// The length of the vector that the values make.
    Magnitude,
}

impl Component {
    const LUMINANCE: &str = "luminance";
    const MAGNITUDE: &str = "magnitude";
    const EXPECTED: &str = "expected a number from 0, luminance or magnitude";
}

impl fmt::Display for Component {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(n) => write!(f, "{n}"),
            Self::Luminance => f.write_str(Self::LUMINANCE),
            Self::Magnitude => f.write_str(Self::MAGNITUDE),
        }
    }
}

impl FromStr for Component {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            Self::LUMINANCE => Ok(Self::Luminance),
            Self::MAGNITUDE => Ok(Self::Magnitude),
            number => {
                number.parse().map(Self::Number).map_err(|_| format!("`{text}` is not a component, {}", Self::EXPECTED))
            }
        }
    }
}

/// A number where it is one, else the word.
impl Serialize for Component {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Number(n) => n.serialize(to),
            word => to.collect_str(word),
        }
    }
}

impl<'de> Deserialize<'de> for Component {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        from.deserialize_any(Visitor)
    }
}

struct Visitor;

impl de::Visitor<'_> for Visitor {
    type Value = Component;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(Component::EXPECTED.trim_start_matches("expected "))
    }

    fn visit_u64<E: de::Error>(self, number: u64) -> Result<Component, E> {
        usize::try_from(number).map(Component::Number).map_err(E::custom)
    }

    fn visit_i64<E: de::Error>(self, number: i64) -> Result<Component, E> {
        u64::try_from(number)
            .map_err(|_| E::invalid_value(de::Unexpected::Signed(number), &self))
            .and_then(|number| self.visit_u64(number))
    }

    fn visit_str<E: de::Error>(self, word: &str) -> Result<Component, E> {
        word.parse().map_err(E::custom)
    }
}
