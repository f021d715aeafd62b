//! Lists of a fixed length in a scene file. TOML's deserializer takes the first entries of a longer list and drops the
//! rest in silence; here any other length is refused.

use serde::de::Error;
use serde::{Deserialize, Deserializer};

/// Exactly `N` entries.
pub fn list<'de, D: Deserializer<'de>, T: Deserialize<'de>, const N: usize>(from: D) -> Result<[T; N], D::Error> {
    exactly(Vec::deserialize(from)?)
}

/// Exactly `N` entries, or nothing.
pub fn optional<'de, D: Deserializer<'de>, T: Deserialize<'de>, const N: usize>(
    from: D,
) -> Result<Option<[T; N]>, D::Error> {
    Option::deserialize(from)?.map(exactly).transpose()
}

/// Any number of lists of exactly `N` entries, or nothing.
pub fn optional_lists<'de, D: Deserializer<'de>, T: Deserialize<'de>, const N: usize>(
    from: D,
) -> Result<Option<Vec<[T; N]>>, D::Error> {
    let lists: Option<Vec<Vec<T>>> = Option::deserialize(from)?;
    lists.map(|lists| lists.into_iter().map(exactly).collect()).transpose()
}

/// Any number of lists of exactly `N` entries.
pub fn lists<'de, D: Deserializer<'de>, T: Deserialize<'de>, const N: usize>(from: D) -> Result<Vec<[T; N]>, D::Error> {
    let lists: Vec<Vec<T>> = Vec::deserialize(from)?;
    lists.into_iter().map(exactly).collect()
}

fn exactly<T, E: Error, const N: usize>(entries: Vec<T>) -> Result<[T; N], E> {
    let count = entries.len();
    entries.try_into().map_err(|_| E::custom(format!("{count} entries where there have to be {N}")))
}

/// A number, or a list of numbers.
pub fn one_or_more<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<f64>, D::Error> {
    #[derive(Deserialize)]
    #[serde(untagged, expecting = "expected a number or a list of numbers")]
    enum OneOrMore {
        One(f64),
        More(Vec<f64>),
    }
    Ok(match OneOrMore::deserialize(from)? {
        OneOrMore::One(number) => vec![number],
        OneOrMore::More(numbers) => numbers,
    })
}
