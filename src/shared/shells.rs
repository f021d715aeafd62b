//! What the shaders of shells know.

use bytemuck::{Pod, Zeroable};
use glam::DVec3;

use super::Placement;
use crate::math::ray::{Lens, ViewRays};
use crate::scene::Scene;
use crate::scene::shells::{self, ShellDepth};

/// `ShellCue` of `glsl/shells.frag`, where its members are explained.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct ShellCue {
    pub beta: [f32; 2],
    pub line: [f32; 2],
    pub depth: [f32; 2],
    pub brightness: f32,
    pub lengths: f32,
    pub middle: f32,
}

impl ShellCue {
    pub fn new(scene: &Scene, depth: &ShellDepth, rays: &ViewRays) -> Self {
        let of_depth = match depth.lens {
            Lens::Perspective => [1.0 / depth.far, 1.0 / depth.nearest - 1.0 / depth.far],
            Lens::Orthographic => [depth.far, depth.nearest - depth.far],
        };
        let single = |pair: [f64; 2]| pair.map(|x| x as f32);
        Self {
            beta: single([depth.beta[0], depth.beta[1] * depth.z]),
            line: single(depth.line()),
            depth: single(of_depth),
            brightness: (1.0 / depth.scale) as f32,
            lengths: (1.0 / (scene.transfer.reference * scene.field.finest())) as f32,
            middle: depth.middle(rays) as f32,
        }
    }
}

/// `ShellLevel` of `glsl/shells.frag`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct ShellLevel {
    pub emission: f32,
    pub rise: f32,
}

impl ShellLevel {
    pub fn new(shell: &shells::Shell) -> Self {
        Self { emission: shell.emission as f32, rise: shell.rise as f32 }
    }
}

impl Placement {
    /// Of shells and of what may hide them: depths go from 0 at the far end to 1 at the near end.
    pub fn of_shells(rays: &ViewRays, size: [u32; 2], depth: &ShellDepth) -> Self {
        let of_polygons = Self::new(rays, size, 1.0);
        let to_depth = rays.to_picture().row(2);
        let row = |row: DVec3, rest: f64| row.as_vec3().extend(rest as f32).to_array();
        let (nearest, far) = (depth.nearest, depth.far);
        let z = match rays.lens {
            Lens::Perspective => row(-nearest / (far - nearest) * to_depth, nearest * far / (far - nearest)),
            Lens::Orthographic => row(-1.0 / (far - nearest) * to_depth, far / (far - nearest)),
        };
        Self { z, ..of_polygons }
    }
}
