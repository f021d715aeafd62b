//! `rc-block`: `rc-ert` with skipping of empty 8^3 blocks [KW03 §2.3].

use super::rc_ert::RC_ERT;
use super::rows::{RAY_CASTER, cast, switched};
use crate::feature::BLOCK_RANGES;
use crate::part::rows::{Ahead, Context, Method};
use crate::part::steps::Steps;
use crate::pass::block_skip::block_skip;
use crate::pass::termination::termination;

pub const RC_BLOCK: Method = Method {
    name: "rc-block",
    about: "rc-ert with skipping of empty 8^3 blocks",
    source: "KW03 §2.3",
    ahead: Ahead::Blocks,
    skips_of: Some(&RC_ERT),
    steps: |context, steps| cast(context, steps, passes),
    ..RAY_CASTER
};

/// An intermediate pass that looks at blocks before each main pass that it may keep from running.
pub(super) fn passes(context: &Context, steps: &mut Steps) {
    match context.has(&BLOCK_RANGES) {
        true => switched(context, steps, u32::from(!context.scene.settings.method.block_first), block_skip),
        false => switched(context, steps, 1, termination),
    }
}
