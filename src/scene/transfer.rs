//! Transfer functions: piecewise linear colour and opacity over the scalar range.

use super::limits::Limits;
use crate::error::{Error, Result};

/// One point of a transfer function. The same `x` twice is a jump, and the later point counts there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Knot {
    /// Place in the scalar range, 0 at its low end and 1 at its high end.
    pub x: f64,
    /// Linear light, not premultiplied.
    pub color: [f64; 3],
    /// Opacity over one reference length.
    pub opacity: f64,
}

/// Knots in rising order of `x`; clamped outside.
#[derive(Clone, Debug, PartialEq)]
pub struct TransferFunction {
    pub name: String,
    knots: Vec<Knot>,
    /// The length an opacity stands for, in voxels of the finest spacing.
    pub reference: f64,
}

/// Reference lengths whose ratio to a step survives single precision, in voxels.
pub const REFERENCES: Limits = Limits::from_to(1e-6, 1e6, "a number of voxels {}");

/// Places and colours beyond this do not survive the arithmetic of single precision.
const LARGEST: f64 = 1e30;

/// Names of the built-in transfer functions.
pub const PRESETS: [&str; 4] = ["ramp", "surface", "haze", "linear"];

/// The transfer function of a scene that names none.
pub const DEFAULT_PRESET: &str = PRESETS[0];

impl TransferFunction {
    /// # Errors
    /// When there is no knot, a number is not finite or beyond single precision, an opacity lies outside [0, 1], a colour
    /// is negative, `x` falls from one knot to the next, or the reference length is not one of [`REFERENCES`].
    pub fn new(name: impl Into<String>, knots: Vec<Knot>, reference: f64) -> Result<Self> {
        let name = name.into();
        let bad =
            |problem: String, remedy: &str| Err(Error::input(format!("transfer function {name}"), problem, remedy));
        if knots.is_empty() {
            return bad("has no points".into(), "give at least one, [x, r, g, b, opacity]");
        }
        if !REFERENCES.contains(reference) {
            return bad(format!("has the reference length {reference}"), &REFERENCES.remedy());
        }
        for (i, knot) in knots.iter().enumerate() {
            if !(knot.x.abs() <= LARGEST && knot.color.iter().all(|c| (0.0..=LARGEST).contains(c))) {
                return bad(
                    format!("point {i} has x = {} and colour {:?}", knot.x, knot.color),
                    &format!("give numbers up to {LARGEST:e}, colours of at least 0"),
                );
            }
            if !(0.0..=1.0).contains(&knot.opacity) {
                return bad(format!("point {i} has the opacity {}", knot.opacity), "give an opacity from 0 to 1");
            }
            if i > 0 && knot.x < knots[i - 1].x {
                return bad(
                    format!("point {i} (x = {}) comes after x = {}", knot.x, knots[i - 1].x),
                    "sort the points by x",
                );
            }
        }
        Ok(Self { name, knots, reference })
    }

    /// One of [`PRESETS`].
    pub fn preset(name: &str, reference: f64) -> Option<Result<Self>> {
        let grey = |x: f64, opacity: f64| Knot { x, color: [x; 3], opacity };
        let knots = match name {
            "ramp" => vec![grey(0.0, 0.0), grey(0.25, 0.0), grey(1.0, 0.5)],
            "surface" => vec![grey(0.0, 0.0), grey(0.3, 0.0), grey(0.3, 0.9), grey(1.0, 0.9)],
            "haze" => vec![grey(0.0, 0.01), grey(1.0, 0.01)],
            "linear" => vec![grey(0.0, 0.0), grey(1.0, 1.0)],
            _ => return None,
        };
        Some(Self::new(name, knots, reference))
    }

    pub fn knots(&self) -> &[Knot] {
        &self.knots
    }

    /// Colour and opacity (not premultiplied) at `x`.
    pub fn evaluate(&self, x: f64) -> [f64; 4] {
        let rgba = |k: &Knot| [k.color[0], k.color[1], k.color[2], k.opacity];
        // The last knot at or below x: at a jump, the later point.
        let above = self.knots.partition_point(|k| k.x <= x);
        let Some(low) = above.checked_sub(1).map(|i| &self.knots[i]) else {
            return rgba(&self.knots[0]);
        };
        let Some(high) = self.knots.get(above) else {
            return rgba(low);
        };
        let weight = (x - low.x) / (high.x - low.x);
        let (a, b) = (rgba(low), rgba(high));
        std::array::from_fn(|c| crate::math::interpolate::mix(a[c], b[c], weight))
    }

    /// Whether the opacity is non-zero anywhere in [low, high], as the limit at a jump included.
    pub fn visible(&self, low: f64, high: f64) -> bool {
        self.evaluate(low)[3] > 0.0
            || self.evaluate(high)[3] > 0.0
            || self.knots.iter().any(|k| k.opacity > 0.0 && low <= k.x && k.x <= high)
    }

    /// The same function over another scale: every knot moved by `map`, which must not fall.
    pub fn mapped(&self, map: impl Fn(f64) -> f64) -> Self {
        let knots = self.knots.iter().map(|k| Knot { x: map(k.x), ..*k }).collect();
        Self { name: self.name.clone(), knots, reference: self.reference }
    }

    /// Places where colour or opacity jumps.
    pub fn jumps(&self) -> impl Iterator<Item = f64> + '_ {
        self.knots.windows(2).filter(|k| k[0].x == k[1].x).map(|k| k[0].x)
    }
}
