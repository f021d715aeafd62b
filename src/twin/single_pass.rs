//! Twin of `glsl/single_pass.frag` and `glsl/single_pass.comp`: the whole ray in one loop [Stegmaier05 §3, §5].
//!
//! Leaps are those of `glsl/shared/distance.glsl` and `visible_block.glsl`. They leave out samples that show nothing, so that it does not matter to the pixel
//! how far f32 leaps.

use super::{Effect, Pixel, Twin, backdrop, direction, entry, start};
use crate::math::ray::cut_interval;
use crate::scene::RefractiveIndex;
use crate::scene::texture::TextureMap;

/// Joins all samples of the part of the ray that is drawn with what the pixel has already.
pub fn single_pass(twin: &Twin, pixel: &mut Pixel, pass: u32) -> Effect {
    entry::entry(twin, pixel, pass);
    direction::direction(twin, pixel, pass);
    // Until now nobody knew how long the ray is.
    twin.judge_cuts(pixel);
    if pixel.section == 0 && twin.projection.shows_values() {
        start::start(twin, pixel, pass);
    }
    if twin.scene.backdrop.is_some() {
        // A ray begins empty, and what is behind it comes last.
        pixel.accumulated = [0.0; 4];
    }
    let before = pixel.accumulated;
    let effect = match RefractiveIndex::of(twin.scene, TextureMap::IDENTITY) {
        Some(index) => twin.bending_ray(pixel, &index),
        None => twin.straight_ray(pixel),
    };
    match twin.projection.shows_values() && pixel.accumulated != before {
        true => Effect::Contributed,
        false => effect,
    }
}

/// What the double-floats of shaders take from the sides of the volume's box, relative.
const BOX_ROUNDING: f64 = 1.0 / (1u64 << 40) as f64;

/// The same for a pixel of which no box says whether its ray meets the volume; undecided where a ray runs so near to a face that
/// rounding decides.
pub fn computed(twin: &Twin, pixel: &mut Pixel, pass: u32) -> Effect {
    let (scene, rays) = (twin.scene, &twin.rays);
    let ray = rays.of(pixel.column, pixel.row);
    let meets = |grown: f64| {
        let half = 0.5 * (1.0 + grown) * scene.field.extent();
        cut_interval(&ray, half, rays.near, scene.clip_planes()).is_some()
    };
    // Rays in single floats may be off on two axes at an edge.
    let off = BOX_ROUNDING + 4.0 * twin.rays_off;
    pixel.undecided |= meets(off) != meets(-off);
    if meets(0.0) { single_pass(twin, pixel, pass) } else { backdrop::backdrop(twin, pixel, pass) }
}

impl Twin<'_> {
    /// Joins what a straight ray gathers, and what is behind the volume.
    fn straight_ray(&self, pixel: &mut Pixel) -> Effect {
        let effect = self.cast_ray(pixel);
        self.show_backdrop(pixel);
        effect
    }

    fn cast_ray(&self, pixel: &mut Pixel) -> Effect {
        if self.importance.is_some() {
            return self.adaptive_steps(pixel, None, true);
        }
        if self.scene.sees_through_surfaces() {
            return self.crossings_on_ray(pixel);
        }
        if self.scene.surface.is_some() {
            return self.surface_on_ray(pixel);
        }
        let (first, end) = self.samples_of_part(pixel);
        let mut effect = Effect::Silent;
        let mut i = first;
        while i < end && !self.saturated(pixel) {
            let free = self.free_samples_from(pixel, i);
            if free > 0 {
                i += free;
                continue;
            }
            let sample = self.sample(pixel, i);
            if !self.projection.shows_values() && sample[3] > 0.0 {
                effect = Effect::Contributed;
            }
            pixel.accumulated = self.projection.blend.apply(pixel.accumulated, sample);
            i += 1;
        }
        effect
    }

    /// The first surface on the part of the ray that is drawn, lit where it is met.
    fn surface_on_ray(&self, pixel: &mut Pixel) -> Effect {
        // A surface in front has ended the ray.
        if pixel.hit[3] > 0.0 {
            return Effect::Silent;
        }
        let (first, end) = self.samples_of_part(pixel);
        let (hit, effect) = self.surface_between(pixel, first, end);
        pixel.hit = hit;
        super::lighting::lighting(self, pixel, 0);
        effect
    }
}
