//! Ranges of the values in blocks, and the table that says which show [KW03 §2.3].

use super::distances::DISTANCES;
use super::reasons::{DENSE, ONLY_PASS};
use crate::part::rows::{Ahead, Context, Feature, Hook, Why};
use crate::resource;
use crate::structure::cells::all_interesting;

/// Ranges of the values in blocks of 8^3 cells, and the table CT.
pub const BLOCK_RANGES: Feature = Feature {
    reads: |_| vec![resource::block_ranges(), resource::BLOCK_TABLE],
    ..Feature::at(Hook::Decide, "block ranges and their table", needed)
};

fn needed(context: &Context) -> Result<(), Why> {
    match context.method.ahead {
        Ahead::Blocks if context.plans() && all_interesting(context.scene) => Err(DENSE.into()),
        // Nobody would read them before a main pass that always runs.
        Ahead::Blocks
            if context.passes == 1 && !context.method.loops() && !context.scene.settings.method.block_first =>
        {
            Err(ONLY_PASS.into())
        }
        Ahead::Blocks => Ok(()),
        // Distances of larger cells are built from the ranges of these.
        Ahead::Distances(_) if context.has(&DISTANCES) && context.lookup().is_some_and(|l| l.reads_ranges()) => {
            Err(Why::Untold)
        }
        Ahead::Nothing | Ahead::Distances(_) => Err(format!("{} does not look at blocks", context.method.name).into()),
    }
}
