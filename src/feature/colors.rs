//! Colours of the transfer function.

use super::classification::CLASSIFICATION;
use super::preintegration::PREINTEGRATION;
use crate::part::rows::{Context, Feature, Hook, Why};
use crate::scene::TransferFunction;

/// Red, green and blue of their own in the transfer function's pieces.
pub const COLORS: Feature = Feature {
    of_cells: true,
    constants: |context| vec![("GREY", u32::from(!context.has(&COLORS)))],
    ..Feature::at(Hook::Sample, "colours of the transfer function", needed)
};

fn needed(context: &Context) -> Result<(), Why> {
    if !context.has(&CLASSIFICATION) {
        return Err(Why::Untold);
    }
    if !context.plans() || !is_grey(&context.scene.transfer) {
        return Ok(());
    }
    // A pre-integrated table has all four channels.
    if context.has(&PREINTEGRATION) { Err(Why::Untold) } else { Err("red, green and blue are alike everywhere".into()) }
}

/// Whether red, green and blue are alike everywhere.
fn is_grey(transfer: &TransferFunction) -> bool {
    transfer.knots().iter().all(|knot| knot.color.iter().all(|c| *c == knot.color[0]))
}
