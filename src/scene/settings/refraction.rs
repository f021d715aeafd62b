//! `effects.refraction`: which index of refraction a value has [Stegmaier05 §6].

use serde::{Deserialize, Serialize};

use crate::scene::fixed;
use crate::scene::limits::{Limits, WrongValue};

/// Indices of refraction, from less than any medium's to more.
pub const INDICES: Limits = Limits::from_to(0.01, 100.0, "an index {}");

/// Values beyond this do not survive the arithmetic of single precision.
const LARGEST_X: f64 = 1e30;

/// Points at the most.
pub const MOST_POINTS: usize = 256;

/// Indices of refraction over the scalar range, beside the transfer function.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table { points } of effects.refraction")]
pub struct Refraction {
    /// Points [x, index] with rising x, linear between them and constant beyond.
    #[serde(deserialize_with = "fixed::lists")]
    pub points: Vec<[f64; 2]>,
}

/// `0.2:1,0.4:1.33` as points.
pub(super) fn points(text: &str) -> Result<Refraction, String> {
    let point = |part: &str| {
        let (x, index) = part.split_once(':')?;
        Some([x.trim().parse().ok()?, index.trim().parse().ok()?])
    };
    let each =
        |part: &str| point(part).ok_or_else(|| format!("`{part}` is not X:INDEX, two numbers with a colon between"));
    Ok(Refraction { points: text.split(',').map(each).collect::<Result<_, _>>()? })
}

/// What is wrong with indices of refraction.
pub(super) fn sound(refraction: &Option<Refraction>) -> Option<WrongValue> {
    let wrong = |problem: String, remedy: String| Some(WrongValue { problem, remedy });
    let Refraction { points } = refraction.as_ref()?;
    if points.is_empty() || points.len() > MOST_POINTS {
        return wrong(format!("has {} points", points.len()), format!("give 1 to {MOST_POINTS} points [x, index]"));
    }
    for (i, [x, index]) in points.iter().enumerate() {
        if !INDICES.contains(*index) {
            return wrong(format!("has the index {index} at point {i}"), INDICES.remedy());
        }
        if !(-LARGEST_X..=LARGEST_X).contains(x) {
            return wrong(format!("has x = {x} at point {i}"), format!("give numbers up to {LARGEST_X:e}"));
        }
        if i > 0 && *x <= points[i - 1][0] {
            return wrong(
                format!("has x = {x} at point {i} after x = {}", points[i - 1][0]),
                "let x rise: an index that jumps would bend rays at a place of no extent, so give two points apart"
                    .to_owned(),
            );
        }
    }
    None
}
