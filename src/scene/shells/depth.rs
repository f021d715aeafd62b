//! Where shells lie in depth: z of the depth cue, and the matrices that take it to the depth buffer [Heidrich95 §3].

use crate::math::ray::{Lens, ViewRays};
use crate::scene::Scene;
use crate::scene::settings::ShellMode;

/// The far end of a view lies behind the farthest corner of the volume by this part of the way there, so that rounding cuts nothing off.
const BEHIND: f64 = 1e-6;

/// What lies in depth between the far end of the volume and the nearest thing there is.
///
/// Depths of devices go from 0 at the far end to 1 at the near end. In perspective they are linear in 1 / depth, in orthographic views in
/// depth. z of the depth cue is `z` times such a depth: it is 1 at the near end of the volume, and more in front of it, where there may be
/// polygons.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShellDepth {
    pub lens: Lens,
    /// Depths in front of the eye, volume units, between which all lies that is drawn.
    pub nearest: f64,
    pub far: f64,
    /// z of what is nearest.
    pub z: f64,
    /// beta0 + b and a of the depth cue.
    pub beta: [f64; 2],
    /// What brightness is multiplied by to be a depth from 0 to 1, where the greatest is to be found.
    pub scale: f64,
}

impl ShellDepth {
    /// Of the shells of a scene; none where it has none.
    pub fn of(scene: &Scene, rays: &ViewRays) -> Option<Self> {
        let (shells, settings) = (scene.shells.as_ref()?, &scene.settings.shells);
        let half = 0.5 * scene.field.extent();
        let near = rays.nearest(-half, half) * (1.0 - BEHIND);
        let far = rays.deepest(-half, half).max(near) * (1.0 + BEHIND);
        let polygons = scene.polygons.bounds().map(|bounds| rays.nearest(bounds.least, bounds.greatest));
        let nearest = polygons.map_or(near, |polygons| near.min(polygons * (1.0 - BEHIND)));
        let from_far = |depth: f64| match rays.lens {
            Lens::Perspective => 1.0 / depth - 1.0 / far,
            Lens::Orthographic => far - depth,
        };
        let z = from_far(nearest) / from_far(near);
        let beta = [settings.beta0 + settings.b, settings.a];
        let brightest = shells.list.iter().map(|shell| shell.emission).fold(0.0, f64::max) * (beta[0] + beta[1] * z);
        let scale = if brightest > 0.0 { 1.0 / brightest } else { 1.0 };
        Some(Self { lens: rays.lens, nearest, far, z, beta, scale })
    }

    /// The depth buffer's depth of a depth in front of the eye.
    pub fn stored(&self, depth: f64) -> f64 {
        match self.lens {
            Lens::Perspective => (1.0 / depth - 1.0 / self.far) / (1.0 / self.nearest - 1.0 / self.far),
            Lens::Orthographic => (self.far - depth) / (self.far - self.nearest),
        }
    }

    /// beta of a depth of the depth buffer.
    pub fn cue(&self, stored: f64) -> f64 {
        self.beta[0] + self.beta[1] * self.z * stored
    }

    /// The depths that 0 and 1 of the depth buffer are taken to for a shell that emits so much, where the greatest is to be found: the
    /// matrix of equation (5) with b* and a*, both times `scale`.
    pub fn range(&self, mode: ShellMode, emission: f64) -> [f32; 2] {
        match mode {
            ShellMode::Max => [0.0, 1.0].map(|stored| (self.scale * emission * self.cue(stored)) as f32),
            ShellMode::Sum | ShellMode::Surface => [0.0, 1.0],
        }
    }

    /// How far apart two places at the far end must lie, in depth, for single precision to tell them apart where depth is brightness.
    pub fn told_apart(&self) -> f64 {
        let rise = match self.lens {
            Lens::Perspective => self.stored_of_inverse() / self.far.powi(2),
            Lens::Orthographic => -self.stored_of_depth(),
        };
        f64::from(f32::EPSILON) * self.beta[0] / (self.beta[1] * self.z * rise)
    }

    /// p and q of beta = p + q / depth in perspective, of beta = p - q depth in orthographic views.
    pub fn line(&self) -> [f64; 2] {
        let rise = self.beta[1] * self.z;
        let (from, slope) = match self.lens {
            Lens::Perspective => {
                let all = 1.0 / self.nearest - 1.0 / self.far;
                (-1.0 / self.far / all, 1.0 / all)
            }
            Lens::Orthographic => {
                let all = self.far - self.nearest;
                (self.far / all, 1.0 / all)
            }
        };
        [self.beta[0] + rise * from, rise * slope]
    }

    /// The integral of beta from depth `from` to depth `to`.
    pub fn between(&self, from: f64, to: f64) -> f64 {
        let [p, q] = self.line();
        match self.lens {
            Lens::Perspective => p * (to - from) + q * (to / from).ln(),
            Lens::Orthographic => (to - from) * (p - 0.5 * q * (to + from)),
        }
    }

    /// Whether rays begin within what is drawn, where nothing can be seen of what is in front of them.
    pub fn is_within(&self, rays: &ViewRays) -> bool {
        self.nearest <= rays.near
    }

    /// The depth to which ways are counted that no surface ends: sums are smallest about the middle. Rays that begin within the volume
    /// may begin within shells, whose ways to there are none.
    pub fn middle(&self, rays: &ViewRays) -> f64 {
        match self.lens {
            _ if self.is_within(rays) => rays.near,
            Lens::Perspective => (self.nearest * self.far).sqrt(),
            Lens::Orthographic => 0.5 * (self.nearest + self.far),
        }
    }

    /// What the depth buffer's depth rises by with 1 / depth, in perspective.
    pub(super) fn stored_of_inverse(&self) -> f64 {
        1.0 / (1.0 / self.nearest - 1.0 / self.far)
    }

    /// The same with depth, in orthographic views.
    pub(super) fn stored_of_depth(&self) -> f64 {
        -1.0 / (self.far - self.nearest)
    }
}
