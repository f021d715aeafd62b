//! The two choices of near-neighbor skipping: how fragments are culled and how they are marked, and what each
//! pair asks of a step's depth test.

use ash::vk;

use super::resource::{Access, Resource, Usage};
use super::{DepthTest, Draw};
use crate::error::{Error, Result};
pub use crate::scene::settings::Mark;
use crate::scene::settings::{Cull, MethodName};

/// Cull and mark of a method, with `auto` resolved.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Form {
    pub cull: Cull,
    pub mark: Mark,
}

impl Form {
    /// As it stands in tables: `bounds+fragdepth`.
    pub fn name(self) -> String {
        format!("{}+{}", self.cull_name(), self.mark_name())
    }

    pub fn cull_name(self) -> &'static str {
        match self.cull {
            Cull::Auto => "auto",
            Cull::Bounds => "bounds",
            Cull::Ztest => "ztest",
            Cull::Discard => "discard",
        }
    }

    pub fn mark_name(self) -> &'static str {
        match self.mark {
            Mark::Auto => "auto",
            Mark::Fragdepth => "fragdepth",
            Mark::FragdepthAny => "fragdepth-any",
            Mark::Copy => "copy",
        }
    }

    /// All forms that make sense for a method; none for methods that cull nothing.
    pub fn all(method: MethodName) -> Vec<Self> {
        let culls = [Cull::Bounds, Cull::Ztest, Cull::Discard];
        let marks = [Mark::Fragdepth, Mark::FragdepthAny, Mark::Copy];
        let every = culls.into_iter().flat_map(|cull| marks.map(|mark| Self { cull, mark }));
        match method {
            MethodName::Rc | MethodName::Cpu => Vec::new(),
            MethodName::RcErt | MethodName::RcBlock => every.collect(),
            _ => every.filter(|f| f.cull == Cull::Bounds || f.mark == Mark::Copy).collect(),
        }
    }

    /// # Errors
    /// When the method has no such form.
    pub fn check(self, method: MethodName) -> Result<Self> {
        let all = Self::all(method);
        if all.contains(&self) {
            return Ok(self);
        }
        let names: Vec<_> = all.into_iter().map(Self::name).collect();
        Err(Error::usage(
            format!("--cull {} --mark {}", self.cull_name(), self.mark_name()),
            format!("method {} has no such form", method.name()),
            format!("choose one of {}", names.join(", ")),
        ))
    }
}

/// A box drawn in the upper half of the depth range, as in the thesis' own form [Thesis §5.3].
const UPPER_HALF: f32 = 0.75;

/// Lets a step that only tests take part where the stored depth is at most `bound`.
pub fn cull_by_stored(draw: &mut Draw, accesses: &mut Vec<Access>, cull: Cull, bound: f32) {
    draw.bound = bound;
    match cull {
        // ALWAYS rather than off: with the depth test off one driver's occlusion counts ignore the bounds.
        Cull::Bounds | Cull::Auto => {
            draw.test = DepthTest { compare: Some(vk::CompareOp::ALWAYS), write: false, bounds: true };
            accesses.push(Usage::DepthTest.of(Resource::Stored));
        }
        Cull::Ztest => {
            draw.depth = bound;
            draw.test = DepthTest { compare: Some(vk::CompareOp::GREATER_OR_EQUAL), write: false, bounds: false };
            accesses.push(Usage::DepthTest.of(Resource::Stored));
        }
        Cull::Discard => {
            draw.define(["CULL_DISCARD"]);
            accesses.push(Usage::Sampled.of(Resource::Stored));
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
        accesses.push(Usage::Color.of(Resource::Marks));
        return;
    }
    accesses.retain(|a| a.resource != Resource::Stored);
    accesses.push(Usage::DepthWrite.of(Resource::Stored));
    draw.depth = if mark == Mark::FragdepthAny { UPPER_HALF } else { 1.0 };
    draw.test = DepthTest { compare: Some(compare), write: true, bounds: draw.test.bounds };
}
