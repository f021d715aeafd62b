//! `nn-*+fused`: near-neighbor skipping, intermediate passes after the first merged into the main passes [Thesis §5.7].

use super::near_neighbor::by;
use super::rows::{cast, decided, empty, unswitched};
use crate::feature::{DECISIONS, MARK_COPIES};
use crate::part::rows::{Context, Method};
use crate::part::steps::Steps;
use crate::pass::fused::fused;
use crate::pass::near_neighbor::near_neighbor;
use crate::resource;
use crate::scene::settings::Distance;

const fn row(distance: Distance, name: &'static str, about: &'static str) -> Method {
    Method {
        fused: true,
        steps: |context, steps| cast(context, steps, passes),
        ..by(distance, name, about, "Thesis §5.7")
    }
}

pub const NN_OMNI_FUSED: Method =
    row(Distance::Omni, "nn-omni+fused", "nn-omni, intermediate passes after the first merged into the main passes");

pub const NN_DIRECTIONAL_FUSED: Method =
    row(Distance::Directional, "nn-directional+fused", "nn-directional, its passes merged in the same way");

pub const NN_OPTIMAL_FUSED: Method =
    row(Distance::Optimal, "nn-optimal+fused", "nn-optimal, its passes merged in the same way");

pub const NN_CONE_FUSED: Method = row(Distance::Cone, "nn-cone+fused", "nn-cone, its passes merged in the same way");

/// One intermediate pass, then main passes that mark where rays go on.
fn passes(context: &Context, steps: &mut Steps) {
    let Some(form) = context.form.filter(|_| context.has(&DECISIONS)) else { return unswitched(context, steps) };
    empty(context, steps);
    let mut marked = None;
    for pass in context.drawn_passes() {
        if marked.is_none() {
            steps.push(near_neighbor(context, pass, true, form));
        }
        let beside = context.has(&MARK_COPIES).then_some(resource::MARKS);
        decided(context, steps, pass, marked, beside);
        steps.push(fused(context, pass, form));
        marked = Some(pass);
    }
}
