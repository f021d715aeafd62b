//! Small pictures of a view, in f64, held against the exact integral.

use std::sync::Arc;

use crate::error::Result;
use crate::frame::{Structures, cpu};
use crate::method::{CPU, SINGLE_PASS_OMNI};
use crate::plan;
use crate::scene::Scene;
use crate::scene::settings::{ErrorNorm, SamplingSettings, Tiles};
use crate::truth::exact::ExactIntegrator;

/// The size of a small picture: pixels along the longer side, at the most; and how many times its error that of the whole picture is taken
/// to be, at the most, by either norm. Large errors are rare, and where a few pixels have one a small picture may have none; a mean has a few
/// per cent of chance in it.
#[derive(Clone, Copy)]
pub struct Small {
    side: f64,
    largest: f64,
    rmse: f64,
}

/// What steps are sought with, and what they are held against then.
pub const SEARCHED: Small = Small { side: 48.0, largest: 1.5, rmse: 1.0 };
pub const CONFIRMED: Small = Small { side: 128.0, largest: 2.0, rmse: 1.03 };

impl Small {
    /// The picture of a scene in this size.
    fn look(self, scene: &Scene, leaps: &Arc<Structures>) -> Result<SmallLook> {
        let mut scene = scene.clone();
        let [width, height] = scene.settings.image.size.map(f64::from);
        let scale = (self.side / width.max(height)).min(1.0);
        scene.settings.image.size = [width, height].map(|side| (side * scale).round().max(1.0) as u32);
        let rays = scene.camera.rays(scene.settings.image.size)?;
        let exact = ExactIntegrator::of(&scene).picture(&rays, scene.settings.image.size);
        Ok(SmallLook { scene, leaps: leaps.clone(), exact })
    }

    /// How many times the error of this picture that of the whole one is taken to be, at the most.
    pub fn safety(self, norm: ErrorNorm) -> f64 {
        match norm {
            ErrorNorm::Largest => self.largest,
            ErrorNorm::Rmse => self.rmse,
        }
    }
}

/// Voxels along the sides of the cells with which small pictures leap: structures of such take a small part of those of single voxels.
const CELL: u32 = 4;

/// A small picture of the view of a scene, and what it ought to be.
pub struct SmallLook {
    scene: Scene,
    /// What rays leap by, which no way of sampling changes.
    leaps: Arc<Structures>,
    pub exact: Vec<[f64; 4]>,
}

impl SmallLook {
    /// The pictures that steps are sought with and held against, of a view.
    ///
    /// # Errors
    /// When the scene cannot be drawn.
    pub fn both(scene: &Scene) -> Result<[Self; 2]> {
        let mut drawn = scene.clone();
        drawn.settings.sampling.error = None;
        (drawn.settings.method.name, drawn.settings.method.cell) = (SINGLE_PASS_OMNI.name(), CELL);
        drawn.settings.method.tiles = Tiles::All;
        // Loops know nothing of a number of passes.
        let in_passes = drawn.settings.sampling.passes > 0;
        let leaping = plan::plan(&drawn, None).ok().filter(|plan| plan.distance.is_some() && !in_passes);
        let mut leaps = Structures::default();
        match leaping {
            Some(plan) => leaps.prepare(&drawn, &plan),
            // Another method, or one that would look for something to leap over in every plan.
            None => drawn.settings.method.name = CPU.name(),
        }
        let leaps = Arc::new(Structures { distances: leaps.distances, ..Structures::default() });
        Ok([SEARCHED.look(&drawn, &leaps)?, CONFIRMED.look(&drawn, &leaps)?])
    }

    /// The error with a way of sampling.
    ///
    /// # Errors
    /// When the scene cannot have it.
    pub fn error(&self, sampling: &SamplingSettings, norm: ErrorNorm) -> Result<f64> {
        let mut scene = self.scene.clone();
        scene.settings.sampling = sampling.clone();
        plan::check(&scene)?;
        let plan = plan::plan(&scene, None)?;
        let drawn = cpu::run(&scene, &plan, &self.leaps, cpu::SUB_PIXEL_BITS);
        let off = |(a, b): (&[f64; 4], &[f64; 4])| std::array::from_fn(|c| a[c] - b[c]);
        Ok(norm.of(drawn.pixels.iter().zip(&self.exact).map(off)))
    }
}
