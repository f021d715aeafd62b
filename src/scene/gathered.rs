//! The most that any ray of a view gathers: what bounds of opacities and of errors are made of.

use super::Scene;
use super::longest::longest_ray;
use super::slices::{SLACK, Slices};
use super::view::View;
use crate::math::polyhedron::HalfSpace;
use crate::math::ray::ViewRays;

/// The most that any ray of a view gathers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gathered {
    /// Samples.
    pub samples: f64,
    /// What all of them stand for together, in steps: as far as they go, the last one for all of its part.
    pub steps: f64,
    /// How often a colour is blended with what the target holds.
    pub blends: f64,
}

impl Gathered {
    /// That of a view in so many main passes.
    pub fn of(scene: &Scene, view: &View, passes: u32) -> Self {
        let samples = f64::from(view.longest_samples);
        match &view.slices {
            None => Self { samples, steps: samples + 1.0, blends: f64::from(passes) },
            Some(slices) => Self::on_slices(scene, view, slices),
        }
    }

    /// From the first slice of a ray to its last one is no farther than the ray, and the last one stands for a stride.
    fn on_slices(scene: &Scene, view: &View, slices: &Slices) -> Self {
        // Samples are taken a little beyond the volume too.
        let grown = |plane: &HalfSpace| HalfSpace { distance: plane.distance - SLACK, ..*plane };
        let planes: Vec<HalfSpace> = scene.clip_planes().iter().map(grown).collect();
        let half = (0.5 + SLACK) * scene.field.extent();
        let rays = ViewRays { near: view.rays.near - SLACK, ..view.rays };
        let length = longest_ray(&rays, half, &planes, view.region);
        let strides = length / slices.spacing;
        let stride = slices.longest_stride(&view.rays, view.size);
        let of_step = scene.settings.sampling.step * scene.field.finest() / slices.spacing;
        let samples = strides.floor() + 1.0;
        Self { samples, steps: (strides + stride) / of_step, blends: samples }
    }
}
