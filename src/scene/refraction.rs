//! Indices of refraction, which bend rays where they change [Stegmaier05 §6].

use super::Scene;
use super::texture::TextureMap;

/// The longest way of a ray that bends, in diagonals of the volume: one that goes around in circles ends there.
const LONGEST_WAY: f64 = 4.0;

/// The index of refraction of values: linear between points, constant beyond them.
#[derive(Clone, Debug, PartialEq)]
pub struct RefractiveIndex {
    /// [value, index], values rising.
    points: Vec<[f64; 2]>,
}

/// The index from one value on, up to the next piece.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IndexPiece {
    /// Where the piece begins; the first one has no begin, and this is where it ends.
    pub begin: f64,
    /// The index there.
    pub index: f64,
    /// What the index rises by in a unit of the value.
    pub slope: f64,
}

impl RefractiveIndex {
    /// Of a scene, over values in the unit that `map` leads to; none where it has none.
    pub fn of(scene: &Scene, map: TextureMap) -> Option<Self> {
        let points = &scene.settings.effects.refraction.as_ref()?.points;
        Some(Self { points: points.iter().map(|[x, index]| [map.value(*x), *index]).collect() })
    }

    /// The pieces: one in front of the first point, one from each point on, the last of which goes on.
    pub fn pieces(&self) -> Vec<IndexPiece> {
        let [begin, index] = self.points[0];
        let mut pieces = vec![IndexPiece { begin, index, slope: 0.0 }];
        pieces.extend((0..self.points.len()).map(|i| {
            let [begin, index] = self.points[i];
            let slope = self.points.get(i + 1).map_or(0.0, |next| (next[1] - index) / (next[0] - begin));
            IndexPiece { begin, index, slope }
        }));
        pieces
    }

    /// The piece that a value is on: at a point, that behind it.
    pub fn piece_at(&self, value: f64) -> IndexPiece {
        self.pieces()[self.points.partition_point(|[begin, _]| *begin <= value)]
    }

    /// The index of a value.
    pub fn at(&self, value: f64) -> f64 {
        let piece = self.piece_at(value);
        piece.index + (value - piece.begin) * piece.slope
    }

    /// The values at which the index begins or ceases to change, or changes otherwise.
    pub fn knots(&self) -> impl Iterator<Item = f64> + '_ {
        self.points.iter().map(|[value, _]| *value)
    }

    /// The closed intervals of values on which the index changes, rising.
    pub fn changing(&self) -> Vec<[f64; 2]> {
        let changing = self.points.windows(2).filter(|pair| pair[0][1] != pair[1][1]);
        changing.map(|pair| [pair[0][0], pair[1][0]]).collect()
    }
}

impl Scene {
    /// The steps of the longest way that a ray which bends may take.
    pub fn longest_way(&self) -> f64 {
        let step = self.settings.sampling.step * self.field.finest();
        (LONGEST_WAY * self.field.extent().length() / step).ceil()
    }
}
