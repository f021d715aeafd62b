//! Distances to what shows [Thesis §5.3].

use super::reasons::DENSE;
use crate::part::Constant;
use crate::part::rows::{Ahead, Context, Feature, Hook, Why};
use crate::resource;
use crate::scene::settings::Distance;
use crate::structure::cells::all_interesting;

/// Distances to the nearest interesting cell, and their look-ups.
pub const DISTANCES: Feature = Feature {
    without: Some("DENSE"),
    constants,
    reads: |_| vec![resource::NEAREST_DISTANCE],
    ..Feature::at(Hook::Decide, "distance structure", needed)
};

fn needed(context: &Context) -> Result<(), Why> {
    match context.method.ahead {
        Ahead::Nothing => Err(format!("{} does not look ahead", context.method.name).into()),
        Ahead::Blocks => Err(format!("{} skips by blocks", context.method.name).into()),
        Ahead::Distances(_) if context.plans() && all_interesting(context.scene) => Err(DENSE.into()),
        Ahead::Distances(_) => Ok(()),
    }
}

/// The constants of `distance.glsl` and `near_neighbor.glsl`: how distances are looked up. A loop looks again wherever it has leapt to.
fn constants(context: &Context) -> Vec<Constant> {
    let Some(distance) = context.method.distance() else { return Vec::new() };
    let method = &context.scene.settings.method;
    let mut constants = vec![("CELL", method.cell), ("OCTANTS", u32::from(distance == Distance::Directional))];
    if !context.method.loops() {
        constants.extend([("EXIT_LOOKAHEAD", u32::from(method.exit_lookahead)), ("LOOKUPS", method.lookups)]);
    }
    constants
}
