//! Iso-surfaces of a scene's field.

use super::settings::{Find, Last, Settings, SurfaceLevel};
use super::{Field, Scene, TransferFunction};

/// Iso-surfaces that rays look for, in place of the volume's colours.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    /// The surfaces, by rising values.
    pub levels: Vec<Level>,
}

/// A surface, among x.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Level {
    /// The values that are on it, from the one to the other; where it is a crossing, all from the one on.
    pub values: [f64; 2],
    /// Linear, not lit.
    pub color: [f64; 3],
}

/// The width of ranges of which nothing is said, in parts of the scalar range.
const WIDTH: f64 = 0.1;

impl Surface {
    /// The surfaces that settings ask for; none where they ask for none.
    pub fn of(settings: &Settings, field: &Field, transfer: &TransferFunction) -> Option<Self> {
        let surface = &settings.surface;
        let [low, high] = field.range;
        let x = |value: f64| match high > low {
            true => (value - low) / (high - low),
            // x is 0 everywhere: a value that the field has is 0, one above is beyond all of it.
            false => f64::from(u8::from(value > low)),
        };
        let level = |asked: &SurfaceLevel| {
            let half = 0.5 * surface.iso_width.unwrap_or(WIDTH * (high - low));
            let values = match surface.find {
                Find::Crossing => [x(asked.iso), f64::INFINITY],
                Find::Range => [x(asked.iso - half), x(asked.iso + half)],
            };
            let [r, g, b, _] = transfer.evaluate(x(asked.iso));
            Level { values, color: asked.color.unwrap_or([r, g, b]) }
        };
        let mut levels: Vec<Level> = surface.asked().iter().map(level).collect();
        levels.sort_by(|a, b| a.values[0].total_cmp(&b.values[0]));
        (!levels.is_empty()).then_some(Self { levels })
    }
}

impl Scene {
    /// What the last sample of a ray stands for. One that looks for surfaces looks at all of its ray, and no further.
    pub fn last(&self) -> Last {
        if self.surface.is_some() { Last::Partial } else { self.settings.sampling.last }
    }

    /// Whether what a sample shows is not that of its own value alone, but of the way to the next one too.
    pub fn spans(&self) -> bool {
        self.surface.is_some() || self.settings.sampling.preintegrates()
    }
}
