//! `nn-*`: near-neighbor skipping [Thesis §5.3, §5.3.1, §5.7].

use super::rc_ert::RC_ERT;
use super::rows::{BOUNDS, RAY_CASTER, cast, culled_forms, decided, empty, main, unswitched};
use crate::feature::DECISIONS;
use crate::part::rows::{Ahead, Context, Method};
use crate::part::steps::Steps;
use crate::pass::near_neighbor::near_neighbor;
use crate::scene::settings::Distance;
use crate::twin::section::section_end;

/// A row of near-neighbor skipping by a kind of distance.
pub(super) const fn by(distance: Distance, name: &'static str, about: &'static str, source: &'static str) -> Method {
    Method {
        name,
        about,
        source,
        papers: BOUNDS,
        forms: culled_forms,
        ahead: Ahead::Distances(distance),
        skips_of: Some(&RC_ERT),
        steps: |context, steps| cast(context, steps, passes),
        ..RAY_CASTER
    }
}

pub const NN_OMNI: Method =
    by(Distance::Omni, "nn-omni", "Near-neighbor skipping, distance in any direction", "Thesis §5.3");

pub const NN_DIRECTIONAL: Method = by(
    Distance::Directional,
    "nn-directional",
    "Near-neighbor skipping, distance within the octant of the fragment's ray",
    "Thesis §5.3.1",
);

pub const NN_OPTIMAL: Method = by(
    Distance::Optimal,
    "nn-optimal",
    "Near-neighbor skipping, distance along the rays of this view",
    "Thesis §5.3.1",
);

pub const NN_CONE: Method = by(
    Distance::Cone,
    "nn-cone",
    "Near-neighbor skipping, distance within a cone around this view's rays, good for cameras nearby",
    "Thesis §5.7",
);

/// An intermediate pass before each main pass, both for rays whose section begins at or before it.
pub(super) fn passes(context: &Context, steps: &mut Steps) {
    let Some(form) = context.form.filter(|_| context.has(&DECISIONS)) else { return unswitched(context, steps) };
    empty(context, steps);
    let mut first = true;
    for pass in context.drawn_passes() {
        steps.push(near_neighbor(context, pass, first, form));
        decided(context, steps, pass, (!first).then_some(pass), None);
        first = false;
        let end = section_end(pass, context.passes) as f32;
        steps.push(main(context, pass, Some((form.cull, end))));
    }
}
