//! All cases.

use super::case::Case;
use super::{depth, optical, sampling, transfer, traps, values, views};

/// Every case, by groups.
pub fn battery() -> Vec<Case> {
    [
        optical::cases(),
        transfer::cases(),
        values::cases(),
        views::cases(),
        sampling::cases(),
        depth::cases(),
        traps::cases(),
    ]
    .into_iter()
    .flatten()
    .collect()
}
