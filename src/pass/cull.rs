//! What each pair of cull and mark asks of a step's depth test.

use ash::vk;

use crate::part::access::{Access, Usage};
use crate::part::{DepthTest, Draw};
use crate::resource;
use crate::scene::settings::{Cull, Mark};
use crate::twin::section::{PARTIAL_REACH, partial_depth};

/// A box drawn in the upper half of the depth range, as in the thesis' own form [Thesis §5.3].
const UPPER_HALF: f32 = 0.75;

/// Lets a step that only tests take part where the stored depth is at most `bound`.
pub fn cull_by_stored(draw: &mut Draw, accesses: &mut Vec<Access>, cull: Cull, bound: f32) {
    draw.bound = bound;
    only_test(draw, accesses, cull, bound, vk::CompareOp::GREATER_OR_EQUAL);
}

/// Lets a step take part only where a ray has nothing left but the segment that ends at a surface, in its part behind so many
/// layers: the depth test is reversed [Thesis ch. 6 §7].
pub fn cull_by_partial(draw: &mut Draw, accesses: &mut Vec<Access>, cull: Cull, section: u32) {
    let depth = partial_depth(section) as f32;
    (draw.least, draw.bound) = (depth - PARTIAL_REACH, depth + PARTIAL_REACH);
    only_test(draw, accesses, cull, depth, vk::CompareOp::EQUAL);
    if cull == Cull::Discard {
        draw.specialize([("PARTIAL_DEPTH", depth.to_bits()), ("PARTIAL_REACH", PARTIAL_REACH.to_bits())]);
    }
}

/// Tests the stored depth and leaves it: by the bounds of `draw`, by the z-test of a box drawn at `depth`, or in the shader.
fn only_test(draw: &mut Draw, accesses: &mut Vec<Access>, cull: Cull, depth: f32, compare: vk::CompareOp) {
    match cull {
        // ALWAYS rather than off: with the depth test off one driver's occlusion counts ignore the bounds.
        Cull::Bounds | Cull::Auto => {
            draw.test = DepthTest { compare: Some(vk::CompareOp::ALWAYS), write: false, bounds: true };
            accesses.push(Usage::DepthTest.of(resource::STORED));
        }
        Cull::Ztest => {
            draw.depths = [depth; 2];
            draw.test = DepthTest { compare: Some(compare), write: false, bounds: false };
            accesses.push(Usage::DepthTest.of(resource::STORED));
        }
        Cull::Discard => {
            draw.define(["CULL_DISCARD"]);
            accesses.push(Usage::Sampled.of(resource::STORED));
        }
    }
}

/// The depth test of marks that never fall. Those of the thesis' own form rise each time they are written.
pub fn rising(mark: Mark) -> vk::CompareOp {
    match mark {
        Mark::FragdepthAny => vk::CompareOp::GREATER,
        _ => vk::CompareOp::GREATER_OR_EQUAL,
    }
}

/// Lets a step write its marks: into the depth buffer, or into a colour attachment that is copied there.
/// `compare` is the depth test of the written depth against the stored one, where it is written directly.
pub fn mark_into(draw: &mut Draw, accesses: &mut Vec<Access>, mark: Mark, compare: vk::CompareOp) {
    draw.define([match mark {
        Mark::Copy => "MARK_COPY",
        Mark::Fragdepth | Mark::Auto => "MARK_FRAGDEPTH",
        Mark::FragdepthAny => "MARK_FRAGDEPTH_ANY",
    }]);
    if mark == Mark::Copy {
        accesses.push(Usage::Color.of(resource::MARKS));
        return;
    }
    accesses.retain(|a| a.resource != resource::STORED);
    accesses.push(Usage::DepthWrite.of(resource::STORED));
    draw.depths = [if mark == Mark::FragdepthAny { UPPER_HALF } else { 1.0 }; 2];
    draw.test = DepthTest { compare: Some(compare), write: true, bounds: draw.test.bounds };
}
