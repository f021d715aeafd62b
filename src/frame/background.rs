//! Structures for views to come, built while frames go on with `omni` [Thesis §5.7].
//!
//! On a compute queue of its own a build runs beside the frames and is taken over when its point on the timeline is
//! reached. With one queue for everything it is cut into slices that run between frames. Either way no frame waits
//! for a build: until one is there that serves the frame's view, the frame reads `omni`.

use std::sync::Arc;
use std::time::Instant;

use super::resident::{Pending, Resident};
use crate::error::Result;
use crate::method;
use crate::scene::Scene;
use crate::scene::settings::Distance;
use crate::structure::grid::Grid;
use crate::structure::{Lookup, RaysFrom};
use crate::vulkan::Device;

/// Frames that a build with one queue is spread over, and the guess for one beside them until the first has ended.
const FRAMES: usize = 8;

/// The structure a frame reads.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ServedDistance {
    pub lookup: Lookup,
    /// Frames since the one whose view it was made for; negative before it. None for `omni`, made for every view.
    pub age: Option<i64>,
}

/// A build and the frame it is for.
struct BuildAhead {
    frame: usize,
    begun: usize,
    lookup: Lookup,
    pending: Pending,
}

/// What the scene's method looks up of what lies ahead.
fn lookup_of(scene: &Scene) -> Result<Option<Lookup>> {
    let distance = method::of(scene.settings.method.name)?.distance();
    Ok(distance.map(|distance| Lookup::new(scene, distance)))
}

/// Builds ahead of the frames.
pub struct Background {
    device: Arc<Device>,
    coming: Option<BuildAhead>,
    /// Made, with the frame they were made for.
    ready: Vec<(usize, Lookup)>,
    /// Frames from the begin of a build to its use.
    lead: usize,
}

impl Background {
    pub fn new(device: &Arc<Device>) -> Self {
        Self { device: device.clone(), coming: None, ready: Vec::new(), lead: FRAMES }
    }

    /// The structure that frame number `frame`, which shows `scene`, reads. Waits for nothing.
    ///
    /// # Errors
    /// What the driver reports.
    pub fn serve(&mut self, frame: usize, scene: &Scene, resident: &mut Resident) -> Result<Option<ServedDistance>> {
        let ended = self.coming.as_ref().map_or(Ok(false), |coming| coming.pending.job.finished())?;
        if let Some(coming) = self.coming.take_if(|_| ended) {
            self.lead = (frame - coming.begun).max(1);
            let lookup = coming.lookup;
            let ms = coming.pending.job.device_ms()?.unwrap_or(0.0);
            resident.finish(coming.pending, ms)?;
            self.ready.push((coming.frame, lookup));
        }
        let Some(wanted) = lookup_of(scene)? else { return Ok(None) };
        let grid = Grid::new(&scene.field, wanted.cell);
        let from = RaysFrom::of(&scene.camera);
        let serves = |lookup: &Lookup| lookup.view.is_some_and(|view| view.serves(&grid, &scene.field, from));
        // What is for a frame that has passed is kept only while it serves.
        self.ready.retain(|(made_for, lookup)| *made_for > frame || serves(lookup));
        let kept: Vec<Lookup> = self.ready.iter().map(|(_, lookup)| *lookup).collect();
        resident.keep_views(&kept);
        let age = |made_for: usize| frame as i64 - made_for as i64;
        let best = self.ready.iter().filter(|(_, lookup)| serves(lookup)).min_by_key(|(f, _)| age(*f).abs());
        Ok(Some(match best {
            Some((made_for, lookup)) => ServedDistance { lookup: *lookup, age: Some(age(*made_for)) },
            None if wanted.view.is_none() => ServedDistance { lookup: wanted, age: None },
            None => ServedDistance { lookup: Lookup { distance: Distance::Omni, view: None, ..wanted }, age: None },
        }))
    }

    /// Goes on with builds after frame number `frame`; `scene_of` gives the scene of a frame to come, where there is
    /// one. The wall time that slices took here, milliseconds.
    ///
    /// # Errors
    /// What the driver reports.
    pub fn go_on(
        &mut self,
        frame: usize,
        resident: &mut Resident,
        scene_of: &dyn Fn(usize) -> Option<Scene>,
    ) -> Result<f64> {
        let ahead = frame + self.lead;
        if self.coming.is_none()
            && self.ready.iter().all(|(made_for, _)| *made_for < ahead)
            && let Some(scene) = scene_of(ahead)
            && let Some(lookup) = lookup_of(&scene)?.filter(|lookup| lookup.view.is_some())
            && let Some(mut pending) = resident.begin(&scene, &lookup)?
        {
            if self.device.separate_compute() {
                pending.job.advance(usize::MAX, &[])?;
            }
            self.coming = Some(BuildAhead { frame: ahead, begun: frame, lookup, pending });
        }
        let Some(coming) = self.coming.as_mut().filter(|_| !self.device.separate_compute()) else { return Ok(0.0) };
        let begin = Instant::now();
        let job = &mut coming.pending.job;
        job.advance(job.slices().div_ceil(FRAMES - 1), &[])?;
        if let Some(last) = job.last() {
            last.wait()?;
        }
        Ok(begin.elapsed().as_secs_f64() * 1e3)
    }
}
