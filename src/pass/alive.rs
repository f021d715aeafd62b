//! Counts the rays that are not dead, so that passes nobody takes part in are not run [after Thesis §5.3.3].

use ash::vk;

use crate::math::blend::Blend;
use crate::part::access::Usage;
use crate::part::geometry::Geometry;
use crate::part::resource::Resource;
use crate::part::{DepthTest, Draw, Group, Step, Work};
use crate::resource;
use crate::twin::section::WAITING;

/// Sections and skipped segments stay at or below 0.5.
const ALIVE: f32 = WAITING;

/// Counts before main pass `pass`, by a depth test that every device has, in the pixels that `geometry` covers.
///
/// `beside`: a colour target that is attached for nothing. Mesa 26's lavapipe forgets that attachments blend each in its
/// own way once a step without colour attachments was drawn: marks beside a blended RES would be blended too, and lost.
pub fn alive(geometry: &'static Geometry, pass: u32, beside: Option<Resource>) -> Step {
    let mut accesses = vec![Usage::Vertices.of(geometry.vertices), Usage::DepthTest.of(resource::STORED)];
    accesses.extend(beside.map(|target| Usage::ColorKept.of(target)));
    Step::new(
        format!("alive #{pass}"),
        Group::Alive,
        pass,
        accesses,
        Work::Draw(Draw {
            geometry,
            vertices: geometry.vertices,
            depths: [ALIVE; 2],
            least: 0.0,
            bound: ALIVE,
            test: DepthTest { compare: Some(vk::CompareOp::GREATER_OR_EQUAL), write: false, bounds: false },
            vertex_define: None,
            shader: None,
            constants: Default::default(),
            blend: Blend::Replace,
            fills: false,
            twin: None,
        }),
    )
}
