//! The transfer function's pieces, asked for the value of each sample.

use super::classification::CLASSIFICATION;
use super::colors::COLORS;
use super::preintegration::PREINTEGRATION;
use crate::part::Constant;
use crate::part::rows::{Context, Feature, Hook, Why};
use crate::resource;
use crate::shared::MOST_FEW_PIECES;

/// Pieces of the transfer function in a buffer, and the search for the piece of a value.
pub const TRANSFER_FUNCTION: Feature = Feature {
    of_cells: true,
    constants,
    reads: |context| {
        vec![match (context.has(&FEW_PIECES), context.has(&COLORS)) {
            (true, true) => resource::FEW_TRANSFER,
            (true, false) => resource::FEW_GREY_TRANSFER,
            (false, true) => resource::TRANSFER,
            (false, false) => resource::GREY_TRANSFER,
        }]
    },
    ..Feature::at(Hook::Sample, "transfer function", |context| match context.has(&CLASSIFICATION) {
        true if !context.has(&PREINTEGRATION) => Ok(()),
        _ => Err(Why::Untold),
    })
};

/// So few pieces that all of them are looked at, without a search: constants of all invocations, where a search reads a storage buffer
/// at another place in each.
pub const FEW_PIECES: Feature = Feature {
    of_cells: true,
    with: Some("FEW_PIECES"),
    ..Feature::at(Hook::Sample, "few pieces", |context| {
        let few = context.scene.transfer.knots().len() <= MOST_FEW_PIECES;
        if few && context.has(&TRANSFER_FUNCTION) { Ok(()) } else { Err(Why::Untold) }
    })
};

/// The constants of `transfer.glsl` and of `preintegrated.glsl`, whose axes go on beyond the first knot and the last.
fn constants(context: &Context) -> Vec<Constant> {
    let pieces = context.scene.transfer.knots().len() as u32 + u32::from(context.has(&PREINTEGRATION));
    vec![("PIECES", pieces), ("SEARCH", pieces.next_power_of_two() / 2)]
}
