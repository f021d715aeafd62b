//! What a row of projections says.

use crate::math::blend::Blend;
use crate::scene::settings::{Last, Offset, ProjectionName, Settings};
use crate::scene::texture::{TextureChoice, TextureMap};
use crate::scene::{Field, Scene};

/// How the samples of a ray become its pixel. The list of them is `crate::projection::PROJECTIONS`.
pub struct Projection {
    /// The name on the command line, in files and in reports.
    pub name: &'static str,
    /// What it is, in a line of the help.
    pub about: &'static str,
    /// Where it is described, or "not in the papers"; the help shows it in brackets.
    pub source: &'static str,
    /// Its number in `glsl/shared/projection.glsl`.
    pub code: u32,
    /// How a sample joins those in front of it in a segment, and a segment what the pixel holds.
    pub blend: Blend,
    /// When a ray needs no further samples, in methods that end rays.
    pub ends: Ends,
    /// What is made of values; none where the transfer function makes colours of them.
    pub values: Option<OfValues>,
}

/// When a ray needs no further samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ends {
    /// Once its opacity is above T.
    Opaque,
    /// Once its value is [`Levels::end`], beyond which no sample counts.
    Reached,
    /// Never, for that reason.
    Never(&'static str),
}

/// What a projection of values makes of them. Its pictures are grey, and opaque wherever the box is, by what rays begin with:
/// no transfer function takes part. Levels and what counts are asked in x and in the texture's unit, all else in x.
pub struct OfValues {
    /// What values are held against, by those there are.
    pub levels: fn(&ValueSpan) -> Levels,
    /// The values that count for a pixel, as closed intervals that rise: others may be skipped.
    pub counting: fn(&Levels) -> Vec<[f64; 2]>,
    /// The value of a ray without samples.
    pub nothing: fn(&Levels) -> f64,
    /// What a sample of that x brings to its ray.
    pub part: fn(f64, &Levels, &SampleWeight) -> f64,
    /// The pixel in exact arithmetic.
    pub exact: fn(&Met) -> f64,
    /// The order in which its error falls with the step, where theory knows one. The flag: x is 0 at both ends of a ray.
    pub order: fn(Offset, Last, bool) -> Option<f64>,
    /// The most that a difference of 1 in every sample is in the pixel of a ray so many reference lengths long; of pixels that
    /// are linear in x, or an extreme of it.
    /// Plans state by it how far a pixel may be off, and warn by it of values that the picture's format cannot hold.
    pub magnification: fn(f64) -> f64,
    /// What is to be known of its error.
    pub remark: &'static str,
}

/// How far interpolation, a texture unit's own idea of a code, and the map from x to it may move a value, relative to the
/// largest number on the way: as far as `crate::structure::cells` widens ranges.
const SLACK: f64 = 1.0 / (1 << 20) as f64;

/// The values there are, in one unit: x, or the texture's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ValueSpan {
    pub least: f64,
    pub greatest: f64,
    /// What stands for x = 0.
    pub zero: f64,
}

impl ValueSpan {
    /// The values of a field in the unit that `map` leads to.
    pub fn of(field: &Field, map: TextureMap) -> Self {
        let [least, greatest] = field.extremes().map(|x| map.value(f64::from(x)));
        Self { least, greatest, zero: map.offset }
    }

    /// How far rounding may move `value`; an exact 0 stays where 0 stands for x = 0.
    pub fn slack(&self, value: f64) -> f64 {
        SLACK * value.abs().max(self.zero.abs())
    }
}

/// What values are held against. Each is a number of f32, so that shaders know the same.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Levels {
    /// What a ray begins with.
    pub start: f64,
    /// Beyond it values differ no more.
    pub end: f64,
}

impl Levels {
    pub fn new(start: f64, end: f64) -> Self {
        let [start, end] = [start, end].map(|level| level.clamp(f32::MIN.into(), f32::MAX.into()) as f32);
        Self { start: start.into(), end: end.into() }
    }

    /// Whether samples bring a ray down from what it begins with, so that one without samples would stand out.
    pub fn falls(self) -> bool {
        self.end < self.start
    }

    /// The same levels as x, of those in the unit that `map` leads to.
    pub fn in_x(self, map: TextureMap) -> Self {
        Self { start: map.x(self.start), end: map.x(self.end) }
    }
}

/// What a sample stands for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SampleWeight {
    /// Steps.
    pub steps: f64,
    /// Steps that all samples of its ray stand for together.
    pub all: f64,
    /// Reference lengths in a step.
    pub lengths: f64,
}

/// What a ray meets of the field between voxels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Met {
    pub least: f64,
    pub greatest: f64,
    /// Of x over the ray, in reference lengths; holes count as 0.
    pub integral: f64,
    /// The ray, holes included, in reference lengths.
    pub lengths: f64,
}

impl Projection {
    /// The name as settings have it.
    pub const fn name(&self) -> ProjectionName {
        ProjectionName::new(self.name)
    }

    /// What values of a scene are held against, in the unit that `map` leads to; nothing where it shows colours.
    pub fn levels(&self, scene: &Scene, map: TextureMap) -> Levels {
        let of = |values: &OfValues| (values.levels)(&ValueSpan::of(&scene.field, map));
        self.values.as_ref().map_or_else(Levels::default, of)
    }

    /// The same levels that shaders have, as x.
    pub fn levels_in_x(&self, scene: &Scene) -> Levels {
        let map = TextureMap::of(&scene.field, TextureChoice::of(scene).kept);
        self.levels(scene, map).in_x(map)
    }

    /// Whether samples have nothing but a value: the transfer function takes no part.
    pub fn shows_values(&self) -> bool {
        self.values.is_some()
    }

    /// The pixel, or the part of one, that a value is: grey, and opaque where the blend unit does not add opacities up.
    pub fn grey(&self, value: f64) -> [f64; 4] {
        [value, value, value, if self.blend == Blend::Add { 0.0 } else { 1.0 }]
    }

    /// The order in which its error falls with the step, where theory knows one; `vanishes`: x is 0 at both ends of a ray.
    pub fn order_of_values(&self, settings: &Settings, vanishes: bool) -> Option<f64> {
        let sampling = &settings.sampling;
        self.values.as_ref().and_then(|values| (values.order)(sampling.offset, sampling.last, vanishes))
    }
}

impl std::fmt::Debug for Projection {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        write!(f, "Projection({})", self.name)
    }
}
