//! What shaders know of rays in single floats.

use bytemuck::{Pod, Zeroable};
use glam::DVec3;

use crate::scene::single_rays::{Even, SingleRays as Rays};

/// `SingleRays` of `glsl/shared/single_rays.glsl`, where its members are explained.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct SingleRays {
    pub place: [[f32; 4]; 2],
    pub place_right: [[f32; 4]; 2],
    pub place_down: [[f32; 4]; 2],
    pub heading: [[f32; 4]; 2],
    pub heading_right: [[f32; 4]; 2],
    pub heading_down: [[f32; 4]; 2],
    pub center: [f32; 2],
    pub near: f32,
}

impl SingleRays {
    pub fn new(rays: &Rays) -> Self {
        let row = |numbers: DVec3| numbers.extend(0.0).as_vec4().to_array();
        let both = |parts: &[Even; 2], of: fn(&Even) -> DVec3| [row(of(&parts[0])), row(of(&parts[1]))];
        Self {
            place: both(&rays.place, |even| even.middle),
            place_right: both(&rays.place, |even| even.right),
            place_down: both(&rays.place, |even| even.down),
            heading: both(&rays.heading, |even| even.middle),
            heading_right: both(&rays.heading, |even| even.right),
            heading_down: both(&rays.heading, |even| even.down),
            center: rays.center.map(|c| c as f32),
            near: rays.near as f32,
        }
    }
}
