//! All cases, by what may go wrong.

mod depth;
mod family;
mod optical;
mod planes;
mod projection;
mod sampling;
mod slices;
mod surfaces;
mod transfer;
mod traps;
mod values;
mod views;

use super::case::StabilityCase;
use crate::method::METHODS;
use crate::part::rows::Method;
use crate::scene::settings::MethodName;

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
        slices::cases(),
        depth::cases(),
        projection::cases(),
        traps::cases(),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// The names of methods that are chosen by their rows.
fn named(chosen: fn(&Method) -> bool) -> Vec<MethodName> {
    METHODS.into_iter().filter(|method| chosen(method)).map(Method::name).collect()
}
