//! What shows among values: what the transfer function makes visible, what counts for a projection of values, or what is on a
//! surface.

use super::{of, surface_values};
use crate::scene::RefractiveIndex;
use crate::scene::texture::TextureMap;
use crate::scene::{Scene, TransferFunction};

/// What shows among values of one unit: x, or the texture's.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Shown {
    /// What the transfer function makes visible, where it takes part.
    pub visible: Option<Visible>,
    /// Besides, values in these closed intervals, rising and apart.
    pub within: Vec<[f64; 2]>,
}

/// Where a transfer function has any opacity, or a value that is off by no more than `slack` may find some.
#[derive(Clone, Debug, PartialEq)]
pub struct Visible {
    pub transfer: TransferFunction,
    pub slack: f64,
}

impl Shown {
    /// What shows of a scene, in the unit that `map` leads to.
    pub fn of(scene: &Scene, map: TextureMap) -> Self {
        let projection = of(&scene.settings);
        let colors = || Visible {
            transfer: scene.transfer.mapped(|x| map.value(x)),
            slack: scene.value_slack() * map.scale.abs(),
        };
        match &projection.values {
            Some(values) => Self { visible: None, within: (values.counting)(&projection.levels(scene, map)) },
            None => Self {
                visible: (scene.surface.is_none() || scene.surfaces_in_volume()).then(colors),
                within: on_surfaces(scene, map).into_iter().chain(bending(scene, map)).collect(),
            },
        }
    }

    /// What shows of a scene, among x.
    pub fn in_x(scene: &Scene) -> Self {
        Self::of(scene, TextureMap::IDENTITY)
    }

    /// Whether anything in `[low, high]` shows.
    pub fn anywhere(&self, low: f64, high: f64) -> bool {
        let sees = |Visible { transfer, slack }: &Visible| transfer.visible(low - slack, high + slack);
        self.visible.as_ref().is_some_and(sees) || self.within.iter().any(|[from, to]| low <= *to && high >= *from)
    }

    /// The least and the greatest value at which what shows may change.
    pub fn turns(&self) -> [f64; 2] {
        let knots = self.visible.iter().flat_map(|Visible { transfer, slack }| {
            let knots = transfer.knots();
            [knots[0].x - slack, knots[knots.len() - 1].x + slack]
        });
        let ends = self.within.iter().flatten().copied().filter(|end| end.is_finite());
        knots.chain(ends).fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], x| [least.min(x), most.max(x)])
    }
}

/// The values that are on surfaces, or that rays cross where they go on behind them.
fn on_surfaces(scene: &Scene, map: TextureMap) -> Vec<[f64; 2]> {
    let mut values = surface_values(scene, map);
    // Within such a surface there is nothing, unless a clip volume or the end of a mesh cuts it open.
    if scene.sees_through_surfaces() && scene.clip_volume.is_none() && scene.tetrahedra.is_none() {
        values.iter_mut().for_each(|[from, to]| *to = *from);
    }
    apart(values)
}

/// The values at which rays bend, which no ray may leap over; no surfaces are beside these.
fn bending(scene: &Scene, map: TextureMap) -> Vec<[f64; 2]> {
    let slack = scene.value_slack() * map.scale.abs();
    let index = RefractiveIndex::of(scene, map);
    let changing = index.map_or_else(Vec::new, |index| index.changing());
    apart(changing.into_iter().map(|[from, to]| [from - slack, to + slack]).collect())
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
        Self { visible: Some(Visible { transfer: transfer.clone(), slack: 0.0 }), within: Vec::new() }
    }
}
