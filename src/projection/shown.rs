//! What shows among values: what the transfer function makes visible, what counts for a projection of values, or what is on a
//! surface.

use super::{of, surface_values};
use crate::scene::texture::TextureMap;
use crate::scene::{Scene, TransferFunction};

/// What shows among values of one unit: x, or the texture's.
#[derive(Clone, Debug, PartialEq)]
pub enum Shown {
    /// Where the transfer function has any opacity, or a value that is off by no more than `slack` may find some.
    Visible { transfer: TransferFunction, slack: f64 },
    /// Values in these closed intervals, rising and apart.
    Within(Vec<[f64; 2]>),
}

impl Shown {
    /// What shows of a scene, in the unit that `map` leads to.
    pub fn of(scene: &Scene, map: TextureMap) -> Self {
        if scene.surface.is_some() {
            return Self::Within(apart(surface_values(scene, map)));
        }
        let projection = of(&scene.settings);
        match &projection.values {
            None => Self::Visible {
                transfer: scene.transfer.mapped(|x| map.value(x)),
                slack: scene.value_slack() * map.scale.abs(),
            },
            Some(values) => Self::Within((values.counting)(&projection.levels(scene, map))),
        }
    }

    /// What shows of a scene, among x.
    pub fn in_x(scene: &Scene) -> Self {
        Self::of(scene, TextureMap::IDENTITY)
    }

    /// Whether anything in `[low, high]` shows.
    pub fn anywhere(&self, low: f64, high: f64) -> bool {
        match self {
            Self::Visible { transfer, slack } => transfer.visible(low - slack, high + slack),
            Self::Within(intervals) => intervals.iter().any(|[from, to]| low <= *to && high >= *from),
        }
    }

    /// The least and the greatest value at which what shows may change.
    pub fn turns(&self) -> [f64; 2] {
        match self {
            Self::Visible { transfer, slack } => {
                let knots = transfer.knots();
                [knots[0].x - slack, knots[knots.len() - 1].x + slack]
            }
            Self::Within(intervals) => {
                let ends = || intervals.iter().flatten().copied().filter(|end| end.is_finite());
                [ends().fold(f64::INFINITY, f64::min), ends().fold(f64::NEG_INFINITY, f64::max)]
            }
        }
    }
}

/// Intervals that rise, those that meet joined.
fn apart(intervals: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    intervals.into_iter().fold(Vec::new(), |mut apart: Vec<[f64; 2]>, [from, to]| {
        match apart.last_mut() {
            Some(before) if from <= before[1].next_up() => before[1] = before[1].max(to),
            _ => apart.push([from, to]),
        }
        apart
    })
}

impl From<&TransferFunction> for Shown {
    fn from(transfer: &TransferFunction) -> Self {
        Self::Visible { transfer: transfer.clone(), slack: 0.0 }
    }
}
