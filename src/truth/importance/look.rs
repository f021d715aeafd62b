//! A look at rays in all directions: how far adaptive steps are off from the exact integral.

use glam::DVec3;
use rayon::prelude::*;

use super::response::Response;
use crate::math::random::Random;
use crate::math::ray::{ViewRay, box_interval};
use crate::scene::Scene;
use crate::truth::exact::{Absorber, ExactIntegrator};

/// Rays of a look.
pub const RAYS: usize = 512;

/// Cells that are drawn for one in which anything shows.
const DRAWS: usize = 4096;

/// A ray from where it enters the volume's box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LookRay {
    pub entry: DVec3,
    /// Of length 1.
    pub direction: DVec3,
    pub length: f64,
}

/// Rays through what shows, each with its exact integral.
pub struct Look<'a> {
    rays: Vec<(LookRay, [f64; 4])>,
    pub medium: Absorber<'a>,
}

impl<'a> Look<'a> {
    /// The same rays for the same scene, whatever it is seen from.
    pub fn new(scene: &'a Scene, response: &Response, ranges: &[[f32; 2]]) -> Self {
        let field = &scene.field;
        let cells = field.cells();
        let exact = ExactIntegrator::new(field, &scene.transfer);
        let ray = |number: usize| {
            let mut draw = Random(number as u64);
            let shown = (0..DRAWS)
                .map(|_| draw.below(ranges.len() as u32) as usize)
                .find(|cell| response.shows(ranges[*cell]))?;
            let cell = [shown % cells[0], shown / cells[0] % cells[1], shown / (cells[0] * cells[1])];
            let place = DVec3::from_array(std::array::from_fn(|axis| cell[axis] as f64 + 0.5 + draw.part()));
            let through = (place - 0.5 * DVec3::from_array(field.dims().map(|n| n as f64))) * field.voxel();
            let direction = draw.direction();
            let far = 2.0 * field.extent().length();
            let line = ViewRay { origin: through - far * direction, direction };
            let (enter, leave) = box_interval(&line, 0.5 * field.extent(), 0.0)?;
            let (entry, length) = (line.at(enter), leave - enter);
            Some((LookRay { entry, direction, length }, exact.ray(entry, direction, length)))
        };
        Self { rays: (0..RAYS).into_par_iter().filter_map(ray).collect(), medium: Absorber::new(&scene.transfer) }
    }

    /// The most that any ray is off in a channel by another way to integrate.
    pub fn most(&self, integrate: impl Fn(&LookRay) -> [f64; 4] + Sync) -> f64 {
        let off = |(ray, exact): &(LookRay, [f64; 4])| {
            integrate(ray).iter().zip(exact).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
        };
        self.rays.par_iter().map(off).reduce(|| 0.0, f64::max)
    }
}
