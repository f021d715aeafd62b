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
    /// The same rays for the same scene, whatever it is seen from; none where the transfer function tells no values apart, so that no
    /// step can err.
    pub fn new(scene: &'a Scene, response: &Response, ranges: &[[f32; 2]]) -> Self {
        let field = &scene.field;
        let (cells, dims) = (field.cells(), field.dims());
        let exact = ExactIntegrator::new(field, &scene.transfer);
        let shown: Vec<u32> =
            (0..ranges.len() as u32).into_par_iter().filter(|cell| response.shows(ranges[*cell as usize])).collect();
        let ray = |number: usize| {
            let mut draw = Random(number as u64);
            let shown = *shown.get(draw.below(shown.len() as u32) as usize)? as usize;
            let cell = [shown % cells[0], shown / cells[0] % cells[1], shown / (cells[0] * cells[1])];
            // Cells on the border reach out to the faces.
            let place = DVec3::from_array(std::array::from_fn(|axis| {
                let low = if cell[axis] == 0 { 0.0 } else { cell[axis] as f64 + 0.5 };
                let high = if cell[axis] + 1 == cells[axis] { dims[axis] as f64 } else { cell[axis] as f64 + 1.5 };
                low + (high - low) * draw.part()
            }));
            let through = (place - 0.5 * DVec3::from_array(dims.map(|n| n as f64))) * field.voxel();
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
