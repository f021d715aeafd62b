//! All cases, by what may go wrong.

mod depth;
mod family;
mod optical;
mod planes;
mod projection;
mod sampling;
mod surfaces;
mod transfer;
mod traps;
mod values;
mod views;

use super::case::StabilityCase;

/// Every case, by groups.
pub fn battery() -> Vec<StabilityCase> {
    [
        optical::cases(),
        transfer::cases(),
        values::cases(),
        views::cases(),
        planes::cases(),
        surfaces::cases(),
        family::cases(),
        sampling::cases(),
        depth::cases(),
        projection::cases(),
        traps::cases(),
    ]
    .into_iter()
    .flatten()
    .collect()
}
