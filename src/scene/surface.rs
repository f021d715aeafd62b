//! Iso-surfaces of a scene's field.

use super::settings::{Find, Last, Settings, SurfaceLevel};
use super::{Field, Scene, TransferFunction};

/// Iso-surfaces that rays look for, in place of the volume's colours or with them.
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
    /// What it takes of the light behind it; a surface of opacity 1 ends rays.
    pub opacity: f64,
}

/// The width of ranges of which nothing is said, in parts of the scalar range.
const WIDTH: f64 = 0.1;

impl Surface {
    /// The surfaces that settings ask for; none where they ask for none.
    pub fn of(settings: &Settings, field: &Field, transfer: &TransferFunction) -> Option<Self> {
        let surface = &settings.surface;
        let [low, high] = field.range;
        // Halved first, as those of voxels: the difference of two finite numbers may overflow, that of their halves cannot.
        let half = if high - low > 1.0 { 0.5 } else { 1.0 };
        let x = |value: f64| match high > low {
            true => (half * value - half * low) / (half * high - half * low),
            // x is 0 everywhere: a value that the field has is 0, others are beyond all of it.
            false if value == low => 0.0,
            false => (value - low).signum(),
        };
        let level = |asked: &SurfaceLevel| {
            let reach = 0.5 * surface.iso_width.unwrap_or(WIDTH * high - WIDTH * low);
            let values = match surface.find {
                Find::Crossing => [x(asked.iso), f64::INFINITY],
                Find::Range => [x(asked.iso - reach), x(asked.iso + reach)],
            };
            let [r, g, b, _] = transfer.evaluate(x(asked.iso));
            Level { values, color: asked.color.unwrap_or([r, g, b]), opacity: asked.opacity }
        };
        let mut levels: Vec<Level> = surface.asked().iter().map(level).collect();
        levels.sort_by(|a, b| a.values[0].total_cmp(&b.values[0]));
        (!levels.is_empty()).then_some(Self { levels })
    }

    /// Whether any lets something through, so that rays may go on behind it.
    pub fn is_transparent(&self) -> bool {
        self.levels.iter().any(|level| level.opacity < 1.0)
    }
}

impl Scene {
    /// Whether rays look for a surface that ends them, so that what they gather is where they meet it.
    pub fn ends_at_surfaces(&self) -> bool {
        self.surface.is_some() && !self.sees_through_surfaces()
    }

    /// Whether rays gather the colours of surfaces that they cross: of those that let something through, and of all that stand within
    /// the colours of the volume, or within the cells of a mesh.
    pub fn sees_through_surfaces(&self) -> bool {
        let crosses = |surface: &Surface| surface.is_transparent() || self.tetrahedra.is_some();
        self.surface.as_ref().is_some_and(crosses) || self.surfaces_in_volume()
    }

    /// Whether surfaces are drawn with the volume's colours.
    pub fn surfaces_in_volume(&self) -> bool {
        self.surface.is_some() && self.settings.surface.volume
    }

    /// What the last sample of a ray stands for. One that looks for surfaces looks at all of its ray, and no further.
    pub fn last(&self) -> Last {
        if self.surface.is_some() || self.settings.adaptive.importance {
            Last::Partial
        } else {
            self.settings.sampling.last
        }
    }

    /// Samples on a ray that is so many steps long.
    pub fn samples_on(&self, steps: f64) -> u32 {
        match self.last() {
            Last::None => steps as u32,
            Last::Full | Last::Partial => (steps - self.settings.sampling.offset.steps()).ceil().max(0.0) as u32,
        }
    }

    /// Whether what a sample shows is not that of its own value alone, but of the way to the next one too.
    pub fn spans(&self) -> bool {
        self.surface.is_some() || self.settings.sampling.preintegrates()
    }
}
