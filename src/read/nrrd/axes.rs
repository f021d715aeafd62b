//! The axes of an NRRD file: what the fields that have one entry an axis say.

use glam::DVec3;

use super::fields::Fields;
use crate::error::Result;

/// What a header says of an axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// Entries along it, at least 1.
    pub size: usize,
    /// Its `kinds`, lower case; none where it is unknown.
    pub kind: Option<String>,
    pub direction: Direction,
    /// Of `spacings`; none where it is unknown, which the format writes as NaN.
    pub spacing: Option<f64>,
    pub min: Option<f64>,
    pub max: Option<f64>,
    /// Whether its samples stand on the ends of its range (`node`) or in the middle of their share of it (`cell`).
    pub node: Option<bool>,
}

/// What `space directions` say of an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Direction {
    /// Nothing.
    Unsaid,
    /// It lies in no space.
    None,
    /// It lies there, nobody knows how (NaN).
    Unknown,
    /// The step from one sample to the next, and its length, which a square of it may not survive.
    Known(DVec3, f64),
}

/// The format has no more axes.
const MOST_AXES: usize = 16;

/// Every axis, the fastest first.
pub fn read(fields: &Fields) -> Result<Vec<Axis>> {
    let dimension = fields.required("dimension")?;
    let count: usize = fields.number("dimension", dimension)?;
    if !(1..=MOST_AXES).contains(&count) {
        return fields.bad("dimension", &format!("is {count}"), &format!("give 1 to {MOST_AXES} axes"));
    }
    let sizes = sizes(fields, count)?;
    let kinds = words(fields, "kinds", count)?;
    let centers = words(fields, "centers", count)?;
    let spacings = numbers(fields, "spacings", count)?;
    let mins = numbers(fields, "axis mins", count)?;
    let maxs = numbers(fields, "axis maxs", count)?;
    let directions = directions(fields, count)?;
    let mut axes = Vec::new();
    for a in 0..count {
        let node = match centers[a].as_deref() {
            None => None,
            Some("node") => Some(true),
            Some("cell") => Some(false),
            Some(other) => {
                return fields.bad("centers", &format!("has `{other}`"), "write cell, node or ??? for each axis");
            }
        };
        axes.push(Axis {
            size: sizes[a],
            kind: kinds[a].clone(),
            direction: directions[a],
            spacing: spacings[a],
            min: mins[a],
            max: maxs[a],
            node,
        });
    }
    Ok(axes)
}

fn sizes(fields: &Fields, count: usize) -> Result<Vec<usize>> {
    let text = fields.required("sizes")?;
    let sizes = text.split_whitespace().map(|n| fields.number::<usize>("sizes", n)).collect::<Result<Vec<_>>>()?;
    if sizes.len() != count {
        return fields.bad("sizes", &format!("are `{text}`"), &format!("give {count} sizes, one for each axis"));
    }
    if sizes.contains(&0) {
        return fields.bad("sizes", &format!("are `{text}`"), "give sizes of at least 1");
    }
    Ok(sizes)
}

/// One word an axis, lower case; none where it says that it does not know, or the field is absent.
fn words(fields: &Fields, field: &str, count: usize) -> Result<Vec<Option<String>>> {
    let Some(text) = fields.get(field) else { return Ok(vec![None; count]) };
    let known = |word: &str| !["???", "none"].contains(&word);
    let words = text.split_whitespace().map(|word| Some(word.to_lowercase()).filter(|w| known(w))).collect();
    one_an_axis(fields, field, words, count)
}

/// One number an axis; none for NaN, or where the field is absent.
fn numbers(fields: &Fields, field: &str, count: usize) -> Result<Vec<Option<f64>>> {
    let Some(text) = fields.get(field) else { return Ok(vec![None; count]) };
    let number = |word| fields.number::<f64>(field, word).map(|n| (!n.is_nan()).then_some(n));
    one_an_axis(fields, field, text.split_whitespace().map(number).collect::<Result<_>>()?, count)
}

fn one_an_axis<T>(fields: &Fields, field: &str, entries: Vec<T>, count: usize) -> Result<Vec<T>> {
    if entries.len() != count {
        let problem = format!("has {} entries where there are {count} axes", entries.len());
        return fields.bad(field, &problem, "give one an axis");
    }
    Ok(entries)
}

/// `(x,y,z)` vectors, `none` for an axis that lies in no space.
fn directions(fields: &Fields, count: usize) -> Result<Vec<Direction>> {
    const FIELD: &str = "space directions";
    let Some(text) = fields.get(FIELD) else { return Ok(vec![Direction::Unsaid; count]) };
    let mut directions = Vec::new();
    let mut rest = text.trim_start();
    while !rest.is_empty() {
        if let Some(after) = rest.strip_prefix("none") {
            directions.push(Direction::None);
            rest = after.trim_start();
            continue;
        }
        let Some((vector, after)) = rest.strip_prefix('(').and_then(|r| r.split_once(')')) else {
            return fields.bad(FIELD, &format!("are `{text}`"), "write (x,y,z) or none for each axis");
        };
        let parts = vector.split(',').map(|n| fields.number::<f64>(FIELD, n.trim()));
        directions.push(direction(&parts.collect::<Result<Vec<_>>>()?));
        rest = after.trim_start();
    }
    one_an_axis(fields, FIELD, directions, count)
}

fn direction(parts: &[f64]) -> Direction {
    if parts.iter().any(|part| part.is_nan()) {
        return Direction::Unknown;
    }
    let part = |i: usize| parts.get(i).copied().unwrap_or(0.0);
    let vector = DVec3::new(part(0), part(1), part(2));
    // The fourth coordinate of a space is time.
    if vector == DVec3::ZERO && part(3) != 0.0 {
        return Direction::None;
    }
    Direction::Known(vector, vector.to_array().into_iter().fold(0.0, f64::hypot))
}
