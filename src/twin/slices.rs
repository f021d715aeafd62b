//! Twin of `glsl/slices.frag` and of `glsl/shared/slices.glsl`: samples on slices [Thesis §3.4].

use glam::DVec3;

use super::{Effect, Pixel, Twin};
use crate::math::ray::ViewRay;
use crate::projection::SampleWeight;
use crate::scene::settings::Alpha;
use crate::scene::slices::{SLACK, Slices, within};
use crate::truth::preintegrated::part_of;

/// Places on slices, and faces that they are held against, are good to this in f32: in sides of the volume and volume units.
const PLACE_ROUNDING: f64 = 2e-6;

/// As in the shader: how much wider the volume is for who decides about slices, and how many more of a spacing.
const WIDER: f64 = 2.0 * SLACK;
const MORE: f64 = 1e-3;

/// Takes the samples of a main pass' slices.
pub fn slices(twin: &Twin, pixel: &mut Pixel, pass: u32) -> Effect {
    let Some(slices) = twin.slices else { return Effect::Silent };
    let ray = twin.rays.of(pixel.column, pixel.row);
    let part = twin.part_depths(pixel, &ray);
    let (mut fragments, mut contributed) = (0, 0);
    for slice in slices.in_pass(pass) {
        let depth = slices.depth(&ray, slice);
        if !twin.is_inside(pixel, &ray, depth) || !twin.is_in_part(pixel, depth, part) {
            continue;
        }
        fragments += 1;
        let sample = twin.sample_on(slices, pixel, &ray, slice);
        let before = pixel.accumulated;
        pixel.accumulated = twin.blend().apply(before, sample);
        let shows = match twin.projection.shows_values() {
            true => pixel.accumulated != before,
            false => sample[3] > 0.0,
        };
        contributed += u64::from(shows);
    }
    Effect::Several { fragments, contributed }
}

impl Twin<'_> {
    /// The slice renderer's view of a pixel: its ray, on which only slices are places.
    pub(super) fn enter_slices(&self, pixel: &mut Pixel) {
        let ray = self.rays.of(pixel.column, pixel.row);
        pixel.direction = ray.direction.normalize();
        pixel.length = f64::INFINITY;
        if self.slices.is_some_and(|slices| slices.of_pass.is_some()) {
            let [first, end] = self.numbers_of_part(pixel);
            let near_whole = |number: f64| (number - number.round()).abs() < 0.2 * MORE;
            pixel.undecided |= first <= end && (near_whole(first) || near_whole(end));
        }
    }

    /// Whether a place of the ray is in the volume, or nearly so.
    fn is_inside(&self, pixel: &mut Pixel, ray: &ViewRay, depth: f64) -> bool {
        let over = within(self.scene, ray.at(depth), SLACK).min(depth - (self.rays.near - SLACK));
        pixel.undecided |= over.abs() < PLACE_ROUNDING;
        over >= 0.0
    }

    /// Depths between which the part of the ray lies that is drawn.
    fn part_depths(&self, pixel: &Pixel, ray: &ViewRay) -> [f64; 2] {
        let [begin, end] = self.part(pixel);
        // Surfaces are so many steps from where the ray enters the volume.
        let enter = self.scene.interval(ray, self.rays.near).map_or(0.0, |(enter, _)| enter);
        let depth = |steps: f64| enter + steps * self.step_length() / ray.direction.length();
        [if begin > 0.0 { depth(begin) } else { f64::NEG_INFINITY }, depth(end)]
    }

    /// Whether a slice at that depth is on the part of the ray that is drawn.
    fn is_in_part(&self, pixel: &mut Pixel, depth: f64, [begin, end]: [f64; 2]) -> bool {
        let near = |cut: f64| (depth - cut).abs() < PLACE_ROUNDING * depth.abs().max(1.0);
        pixel.undecided |= near(begin) || near(end);
        begin <= depth && depth < end
    }

    /// The texture coordinates of sample `i`, on its slice where there are slices.
    pub(super) fn place_of(&self, pixel: &Pixel, i: u32) -> DVec3 {
        match self.slices {
            None => self.sample_position(pixel, i),
            Some(slices) => {
                let ray = self.rays.of(pixel.column, pixel.row);
                ray.at(slices.depth(&ray, i)) / self.scene.field.extent() + 0.5
            }
        }
    }

    /// Steps from sample to sample.
    pub(super) fn stride_of(&self, pixel: &Pixel) -> f64 {
        let of = |slices: &Slices| slices.stride(&self.rays.of(pixel.column, pixel.row)) / self.step_length();
        self.slices.map_or(1.0, of)
    }

    /// The numbers, with fractions, that slices at the ends of the part of the ray would have that is drawn, as who decides about it takes
    /// it; the first is greater where it has none.
    fn numbers_of_part(&self, pixel: &Pixel) -> [f64; 2] {
        let nothing = [1.0, 0.0];
        let Some(slices) = self.slices else { return nothing };
        let ray = self.rays.of(pixel.column, pixel.row);
        let [enter, leave] = self.depths_within(&ray, WIDER);
        let [begin, end] = self.part_depths(pixel, &ray);
        let (enter, leave) = (enter.max(begin), leave.min(end));
        let numbers = [slices.number(&ray, enter) - MORE, slices.number(&ray, leave) + MORE];
        if enter <= leave && !numbers[0].is_nan() { numbers } else { nothing }
    }

    /// The first slice of the part of the ray that is drawn, and one past its last.
    pub(super) fn slices_of_part(&self, pixel: &Pixel) -> (u32, u32) {
        counted(self.slices, self.numbers_of_part(pixel))
    }

    /// How many slices a ray meets in the volume, and whether f32 can tell.
    pub(super) fn slices_met(&self, pixel: &Pixel) -> (u32, bool) {
        let Some(slices) = self.slices else { return (0, true) };
        let ray = self.rays.of(pixel.column, pixel.row);
        let [enter, leave] = self.depths_within(&ray, SLACK);
        if enter > leave {
            return (0, true);
        }
        let numbers = [enter, leave].map(|depth| slices.number(&ray, depth));
        let reach = PLACE_ROUNDING / slices.spacing;
        let decided = numbers.into_iter().all(|number| (number - number.round()).abs() > reach);
        let (first, end) = counted(Some(slices), numbers);
        (end - first, decided)
    }

    /// Depths between which a ray is in the volume grown by `slack`.
    fn depths_within(&self, ray: &ViewRay, slack: f64) -> [f64; 2] {
        let mut between = [self.rays.near - SLACK, f64::INFINITY];
        let mut cut = |height: f64, rise: f64| match () {
            () if rise > 0.0 => between[0] = between[0].max(-height / rise),
            () if rise < 0.0 => between[1] = between[1].min(-height / rise),
            () if height < 0.0 => between[1] = f64::NEG_INFINITY,
            () => {}
        };
        let extent = self.scene.field.extent();
        for axis in 0..3 {
            for sign in [1.0, -1.0] {
                cut((0.5 + slack) * extent[axis] + sign * ray.origin[axis], sign * ray.direction[axis]);
            }
        }
        for plane in self.scene.clip_planes() {
            cut(plane.height(ray.origin) + slack, plane.normal.dot(ray.direction));
        }
        between
    }

    /// What a sample on a slice brings to its ray.
    fn sample_on(&self, slices: &Slices, pixel: &mut Pixel, ray: &ViewRay, slice: u32) -> [f64; 4] {
        let extent = self.scene.field.extent();
        let place = |slice: u32| ray.at(slices.depth(ray, slice)) / extent + 0.5;
        let stride = self.stride_of(pixel);
        let sampling = &self.scene.settings.sampling;
        // Opacities that are taken as they stand are those of a slice.
        let steps = if sampling.alpha == Alpha::Paper { 1.0 } else { stride };
        // A ray that begins on the slice.
        let anchor = sampling.offset.steps();
        let mut on_slice = Pixel { entry: place(slice), anchor, undecided: false, rounding: 0.0, ..pixel.clone() };
        let sample = match (&self.projection.values, self.table) {
            (Some(values), _) => {
                let lengths = sampling.step / self.scene.transfer.reference;
                let (met, decided) = self.slices_met(pixel);
                let mut of = |met: u32| {
                    let weight = SampleWeight { steps: stride, all: stride * f64::from(met.max(1)), lengths };
                    self.value_with(values, &mut on_slice, 0, &weight)
                };
                let sample = of(met);
                // Only averages ask how many there are.
                pixel.undecided |= !decided && of(met + 1) != sample;
                sample
            }
            (None, Some(table)) => {
                let [front, back] = [slice, slice + 1].map(|slice| {
                    let voxel = self.voxel(place(slice).clamp(DVec3::ZERO, DVec3::ONE));
                    table.node(self.value(&mut on_slice, voxel))
                });
                part_of(table.between(front, back), steps, sampling.alpha)
            }
            (None, None) => self.shade_steps(&mut on_slice, 0, steps),
        };
        pixel.undecided |= on_slice.undecided;
        pixel.rounding += on_slice.rounding;
        sample
    }
}

/// The first slice between two numbers, and one past the last.
fn counted(slices: Option<&Slices>, [first, end]: [f64; 2]) -> (u32, u32) {
    let count = slices.map_or(0.0, |slices| f64::from(slices.count));
    let (first, end) = (first.ceil(), end.floor() + 1.0);
    if first < end { (first.clamp(0.0, count) as u32, end.clamp(0.0, count) as u32) } else { (0, 0) }
}
