//! Twin of `glsl/layer.frag`, and of `glsl/shared/layer.glsl`: the part of a ray between two layers.

use super::{Effect, Pixel, Surface, Twin};
use crate::math::blend::Blend;
use crate::scene::settings::{Last, PartialSegments};

/// Distances of surfaces are good to some 2^-23 of the way to them: the length of the way from the eye is rounded, and that from
/// the face of the box is counted in steps.
const SURFACE_ROUNDING: f64 = 4e-7;

/// Blends the colour of a transparent layer under what is in front of it, unless that is an iso-surface.
pub fn layer_without_surface(twin: &Twin, pixel: &mut Pixel, number: u32) -> Effect {
    if pixel.hit[3] == 0.0 { layer(twin, pixel, number) } else { Effect::Discarded }
}

/// Blends the colour of a transparent layer under what is in front of it.
pub fn layer(twin: &Twin, pixel: &mut Pixel, layer: u32) -> Effect {
    let Some(surface) = pixel.layers.get(layer as usize) else { return Effect::Discarded };
    pixel.accumulated = twin.blend().apply(pixel.accumulated, surface.color);
    Effect::Silent
}

/// Blends the colour of the opaque surface under what is in front of it.
pub fn opaque(twin: &Twin, pixel: &mut Pixel, _: u32) -> Effect {
    let Some(surface) = pixel.opaque else { return Effect::Discarded };
    pixel.accumulated = twin.blend().apply(pixel.accumulated, surface.color);
    Effect::Silent
}

/// Draws the colour of the opaque surface in place of what is there.
pub fn opaque_first(_: &Twin, pixel: &mut Pixel, _: u32) -> Effect {
    let Some(surface) = pixel.opaque else { return Effect::Discarded };
    pixel.accumulated = surface.color;
    Effect::Silent
}

impl Twin<'_> {
    /// How a sample on a slice, or the colour of a layer, is joined with what is drawn already.
    pub(super) fn blend(&self) -> Blend {
        match self.projection.blend {
            Blend::Over if self.slices.is_some_and(|slices| slices.of_pass.is_none()) => Blend::InFront,
            blend => blend,
        }
    }

    /// Where the part of the ray that is drawn begins and ends, in steps; nothing is between them where the ray has no such part.
    pub fn part(&self, pixel: &Pixel) -> [f64; 2] {
        let steps = self.steps(pixel);
        let before = match pixel.section.checked_sub(1) {
            None => pixel.begin.as_ref(),
            Some(layer) => pixel.layers.get(layer as usize),
        };
        let begin = match before {
            Some(surface) if surface.kept => surface.steps.max(0.0),
            None if pixel.section == 0 && !self.scene.polygons.cuts_in_front() => 0.0,
            _ => steps,
        };
        let behind: Option<&Surface> = pixel.layers.get(pixel.section as usize).or(pixel.opaque.as_ref());
        [begin, behind.map_or(steps, |surface| surface.steps.min(steps))]
    }

    /// The first sample of the part of the ray that is drawn, and one past its last.
    pub fn samples_of_part(&self, pixel: &Pixel) -> (u32, u32) {
        if self.slices.is_some() {
            return self.slices_of_part(pixel);
        }
        let ([begin, end], all) = (self.part(pixel), self.sample_count(pixel));
        if begin >= end || all == 0 {
            return (0, 0);
        }
        match self.scene.last() {
            Last::Partial => ((begin.floor() as u32).min(all - 1), (end.ceil() as u32).min(all)),
            Last::Full | Last::None => {
                let sample = |steps: f64| (steps - self.scene.settings.sampling.offset.steps()).ceil().max(0.0) as u32;
                (sample(begin), sample(end).min(all))
            }
        }
    }

    /// How far f32 may be off with where a surface cuts the ray, in steps.
    fn cut_reach(&self, pixel: &Pixel) -> f64 {
        SURFACE_ROUNDING / self.step_length() * (1.0 + pixel.length)
    }

    /// The same in voxels, at the most on any axis; of places on a ray that are not those of samples.
    pub(super) fn cut_rounding(&self, pixel: &Pixel) -> f64 {
        self.cut_reach(pixel) * self.voxels_in_step(pixel)
    }

    /// Voxels that a step goes through, at the most on any axis.
    pub(super) fn voxels_in_step(&self, pixel: &Pixel) -> f64 {
        (pixel.direction / self.scene.field.voxel() * self.step_length()).abs().max_element()
    }

    /// Goes to the part of the ray behind so many layers, and sees whether f32 can tell its samples.
    pub fn enter(&self, pixel: &mut Pixel, section: u32) {
        let known = pixel.section == section && section > 0;
        pixel.section = section;
        if !known {
            self.judge_cuts(pixel);
        }
    }

    /// Sees whether f32 can tell the samples of the part of the ray that is drawn.
    pub fn judge_cuts(&self, pixel: &mut Pixel) {
        if self.slices.is_some() {
            self.enter_slices(pixel);
            return;
        }
        if pixel.layers.is_empty() && pixel.opaque.is_none() && pixel.begin.is_none() {
            return;
        }
        let (steps, offset) = (self.steps(pixel), self.scene.settings.sampling.offset.steps());
        let reach = self.cut_reach(pixel);
        // Where segments that end at a surface are drawn apart, it matters whether it is that or the face of the box.
        if self.scene.settings.layers.partial == PartialSegments::Apart {
            let surfaces = pixel.layers.iter().chain(&pixel.opaque);
            pixel.undecided |= surfaces.into_iter().any(|surface| (surface.steps - steps).abs() < reach);
        }
        for cut in self.part(pixel).into_iter().filter(|cut| *cut > 0.0 && *cut < steps) {
            let place = match self.scene.last() {
                Last::Partial => cut,
                Last::Full | Last::None => cut - offset,
            };
            pixel.undecided |= (place - place.round()).abs() < reach;
        }
    }
}
