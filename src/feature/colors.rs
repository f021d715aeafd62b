//! Colours of the transfer function.

use crate::part::rows::{Context, Feature, Hook, Why};
use crate::scene::TransferFunction;

/// Red, green and blue of their own in the transfer function's pieces.
pub const COLORS: Feature = Feature {
    constants: |context| vec![("GREY", u32::from(!context.has(&COLORS)))],
    ..Feature::at(Hook::Sample, "colours of the transfer function", needed)
};

fn needed(context: &Context) -> Result<(), Why> {
    match () {
        () if !context.plans() || !is_grey(&context.scene.transfer) => Ok(()),
        // The table holds all four.
        () if context.scene.settings.sampling.spans() => Err(Why::Untold),
        () => Err("red, green and blue are alike everywhere".into()),
    }
}

/// Whether red, green and blue are alike everywhere.
fn is_grey(transfer: &TransferFunction) -> bool {
    transfer.knots().iter().all(|knot| knot.color.iter().all(|c| *c == knot.color[0]))
}
