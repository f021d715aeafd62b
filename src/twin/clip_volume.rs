//! Twin of `glsl/shared/clip_volume.glsl`: what another volume leaves of the scene's own one [Stegmaier05 §6].

use glam::DVec3;

use super::lighting::RoundedPlace;
use super::segment::VALUE_ROUNDING;
use super::surface::RoundedValue;
use super::{Pixel, Twin};
use crate::scene::ClipVolume;
use crate::scene::settings::Refine;

/// What f32 takes from a place in the clip volume, in parts of the numbers that it is made of: texture coordinates, four products and
/// their sum.
const PLACE_ROUNDING: f64 = 1.0 / (1 << 22) as f64;

/// Halvings of a step in which a ray comes into what is kept, or leaves it, as in the shader.
const CUT_HALVINGS: u32 = 16;

/// What is kept of a stretch, by its two ends.
pub(super) struct KeptPart {
    /// Its begin and its end, in steps.
    pub between: [f64; 2],
    /// Whether the ray comes into it behind the begin of the stretch.
    pub enters: bool,
    /// How far f32 may be off with where it is cut, in steps; 0 where it is not.
    pub rounding: f64,
}

impl KeptPart {
    /// A stretch that is kept as a whole.
    fn whole(between: [f64; 2]) -> Self {
        Self { between, enters: false, rounding: 0.0 }
    }
}

/// Whether texture coordinates of the scene's volume are kept, by values and faces of the box that are off by `by` times what f32 may
/// be off.
fn is_kept_by(clip: &ClipVolume, place: DVec3, by: f64) -> bool {
    let voxel = clip.voxel(place);
    let sizes = clip.rows.map(|row| row.abs().dot(place.abs().extend(1.0)));
    let off = PLACE_ROUNDING * DVec3::from_array(sizes);
    let [low, high] = clip.faces(0.0);
    let (low, high) = (low - by * off, high + by * off);
    let within = voxel.cmpge(low).all() && voxel.cmple(high).all();
    let inside = within && {
        let value = clip.value(voxel);
        value + by * value_rounding(clip, voxel, off) >= clip.level
    };
    inside == clip.keeps_inside
}

/// How far f32 may be from the value at a voxel, of which each coordinate is off by so much.
fn value_rounding(clip: &ClipVolume, voxel: DVec3, off: DVec3) -> f64 {
    let (field, middle) = (&clip.field, voxel + 0.5);
    // Where the place may lie in another cell, that one's values count too.
    let cells = [field.cell_at(middle - off), field.cell_at(middle + off)];
    let corners = cells.into_iter().flat_map(|cell| field.corners(cell)).map(|corner| f64::from(field.values[corner]));
    let [least, most] =
        corners.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], value| [least.min(value), most.max(value)]);
    let spread = most - least;
    // What is constant is interpolated exactly.
    if spread == 0.0 { 0.0 } else { VALUE_ROUNDING * least.abs().max(most.abs()) + off.element_sum() * spread }
}

impl Twin<'_> {
    /// Whether a clip volume keeps the ray's place so many steps from the entry point; undecided where f32 may find another thing.
    pub(super) fn is_kept(&self, pixel: &mut Pixel, steps: f64) -> bool {
        let Some(clip) = self.scene.cutting_volume() else { return true };
        let kept_by = |steps: f64, by: f64| is_kept_by(clip, self.position_at(pixel, steps), by);
        let kept = kept_by(steps, 0.0);
        // A place that is none of a sample is that of a polygon or of the exit point, and is off by more.
        let is_sample = (steps - self.scene.settings.sampling.offset.steps()).fract() == 0.0;
        let off = if is_sample { 0.0 } else { self.as_placed(pixel, steps).rounding };
        let unsure = [(-off, -1.0), (-off, 1.0), (off, -1.0), (off, 1.0)];
        pixel.undecided |= unsure.into_iter().any(|(off, by)| kept_by(steps + off, by) != kept);
        kept
    }

    /// What is kept of a stretch; none where neither of its ends is.
    pub(super) fn kept_part(&self, pixel: &mut Pixel, stretch: [f64; 2]) -> Option<KeptPart> {
        let Some(clip) = self.scene.cutting_volume() else { return Some(KeptPart::whole(stretch)) };
        let [front, back] = stretch.map(|steps| self.is_kept(pixel, steps));
        if front == back {
            return front.then_some(KeptPart::whole(stretch));
        }
        let halvings = if self.scene.settings.surface.refine == Refine::None { 0 } else { CUT_HALVINGS };
        let cut_by = |by: f64| {
            let [mut kept, mut clipped] = if front { stretch } else { [stretch[1], stretch[0]] };
            for _ in 0..halvings {
                let middle = 0.5 * (kept + clipped);
                let found =
                    if is_kept_by(clip, self.position_at(pixel, middle), by) { &mut kept } else { &mut clipped };
                *found = middle;
            }
            kept
        };
        let [cut, less, more] = [0.0, -1.0, 1.0].map(cut_by);
        let halved = (stretch[1] - stretch[0]) / f64::from(1u32 << CUT_HALVINGS);
        let rounding = (less - cut).abs().max((more - cut).abs()) + halved + self.as_placed(pixel, cut).rounding;
        let between = if front { [stretch[0], cut] } else { [cut, stretch[1]] };
        Some(KeptPart { between, enters: !front, rounding: if halvings == 0 { 0.0 } else { rounding } })
    }

    /// A place that is the end of a step or of a part of the ray.
    pub(super) fn as_placed(&self, pixel: &Pixel, steps: f64) -> RoundedPlace {
        RoundedPlace { steps, rounding: self.cut_rounding(pixel) / self.voxels_in_step(pixel) }
    }

    /// The value `steps` from the entry point, where f32 may take it so many steps beside.
    pub(super) fn value_beside_cut(&self, pixel: &Pixel, steps: f64, rounding: f64) -> RoundedValue {
        let found = self.value_at(pixel, steps);
        let off = [-rounding, rounding].map(|by| (self.value_at(pixel, steps + by).value - found.value).abs());
        RoundedValue { rounding: found.rounding + off[0].max(off[1]), ..found }
    }

    /// The part of the step with that stretch in which the ray meets a surface: that in front of it and that on it, or twice the place
    /// at which it comes into what is kept on one.
    pub(super) fn hit_in_step(&self, pixel: &mut Pixel, stretch: [f64; 2]) -> Option<[f64; 2]> {
        let part = self.kept_part(pixel, stretch)?;
        let [begin, end] = part.between;
        let cut = if part.enters { begin } else { end };
        if part.rounding > 0.0 {
            // Whether it is on a surface there, f32 may see beside.
            let beside = self.value_beside_cut(pixel, cut, part.rounding);
            pixel.undecided |= self.near_surface(beside);
        }
        let hit = match part.enters && self.is_on_surface(pixel, begin) {
            true => Some([begin; 2]),
            false => self.is_on_surface(pixel, end).then_some(part.between),
        };
        pixel.cut = part.rounding;
        hit
    }
}
