//! Deciding which rays go on: intermediate passes, the depth buffer, and how marks come there.

use super::adaptive::ADAPTIVE;
use super::block_ranges::BLOCK_RANGES;
use super::distances::DISTANCES;
use super::early_ends::EARLY_ENDS;
use super::layers::cut;
use super::reasons::{DENSE, ONLY_PASS, never_ends};
use crate::part::rows::{Context, Feature, Why};
use crate::scene::settings::Mark;

/// Passes that decide which rays go on, and the depth buffer that holds what they decide.
pub const DECISIONS: Feature = Feature::of_frame("intermediate passes and the depth buffer", decisions);

/// A colour image of marks and its copies into the depth buffer.
pub const MARK_COPIES: Feature = Feature::of_frame("marks image and copies to depth", mark_copies);

/// Intermediate passes of their own before every main pass but the first.
pub const LATER_DECISIONS: Feature = Feature::of_frame("intermediate passes after the first", later_decisions);

/// Whether something can be skipped that the method looks for.
fn skips(context: &Context) -> bool {
    context.has(&DISTANCES) || context.has(&BLOCK_RANGES)
}

fn decisions(context: &Context) -> Result<(), Why> {
    let method = context.method;
    if !method.takes_samples() {
        return Err(Why::Untold);
    }
    if context.form.is_none() {
        return Err(format!("{} culls no fragments", method.name).into());
    }
    // Polygons end rays as well.
    if cut(context) {
        return Ok(());
    }
    // Adaptive rays leave the volume after more passes or fewer.
    if !context.has(&EARLY_ENDS) && !skips(context) && !context.has(&ADAPTIVE) {
        let never_ends = never_ends(context);
        return Err(if method.looks_ahead() { format!("{never_ends}, and {DENSE}") } else { never_ends }.into());
    }
    // Methods that switch rays on and off begin with the second main pass [KW03 §2.1], unless blocks are looked at first.
    let blocks_first = context.has(&BLOCK_RANGES) && context.scene.settings.method.block_first;
    if context.passes == 1 && !method.marks_sections() && !blocks_first {
        return Err(ONLY_PASS.into());
    }
    Ok(())
}

fn mark_copies(context: &Context) -> Result<(), Why> {
    if !context.has(&DECISIONS) {
        return Err(Why::Untold);
    }
    match context.form {
        Some(form) if form.mark == Mark::Copy => Ok(()),
        _ => Err("the intermediate pass writes depth itself".into()),
    }
}

fn later_decisions(context: &Context) -> Result<(), Why> {
    if context.method.fused { Err("main passes decide where rays go on".into()) } else { Ok(()) }
}
