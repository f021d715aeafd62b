//! The pass of segments that end at a surface [Thesis ch. 6 §7].

use super::decisions::DECISIONS;
use crate::part::rows::{Feature, Hook, Why};
use crate::scene::settings::PartialSegments;
use crate::twin::section::partial_depth;

/// Segments that end at a surface, drawn in a pass of their own [Thesis ch. 6 §7].
pub const APART: Feature = Feature {
    with: Some("PARTIAL_APART"),
    constants: |context| match context.has(&APART) {
        true => vec![("PARTIAL_DEPTH", (partial_depth(context.section) as f32).to_bits())],
        false => Vec::new(),
    },
    ..Feature::at(Hook::Decide, "a pass for segments that end at a surface", |context| {
        let ends = context.layers > 0 || context.opaque;
        match context.scene.settings.layers.partial {
            PartialSegments::Within => Err(Why::Untold),
            PartialSegments::Apart if context.method.stack().is_some() => {
                Err("every slice stands for the way to the next one".into())
            }
            PartialSegments::Apart if !ends => Err("no surface ends a ray".into()),
            PartialSegments::Apart if !context.has(&DECISIONS) => {
                Err(format!("{} culls no fragments", context.method.name).into())
            }
            PartialSegments::Apart => Ok(()),
        }
    })
};
