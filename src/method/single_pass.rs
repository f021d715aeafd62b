//! `single-pass`: one shader holds the whole ray [Stegmaier05 §3, §5]; with blocks and distances it leaps inside its loop.
//! `+compute`: the same loop in a compute shader.

use super::rows::{RAY_CASTER, cast};
use crate::feature::adaptive;
use crate::feature::cells::takes_voxels;
use crate::part::rows::{Ahead, Context, Method, Traversal};
use crate::part::steps::Steps;
use crate::pass::single_pass::{single_pass, single_pass_compute};
use crate::scene::settings::Distance;

const fn row(name: &'static str, about: &'static str, ahead: Ahead, skips_of: Option<&'static Method>) -> Method {
    Method {
        name,
        about,
        source: "Stegmaier05 §5",
        takes: |scene| {
            adaptive::refuse(scene)?;
            takes_voxels(scene)
        },
        papers: None,
        forms: Vec::new,
        ahead,
        traversal: Traversal::FragmentLoop,
        skips_of,
        steps: |context, steps| cast(context, steps, drawn),
        ..RAY_CASTER
    }
}

const fn computed(of: Method, name: &'static str, about: &'static str, skips_of: Option<&'static Method>) -> Method {
    Method {
        name,
        about,
        skips_of,
        traversal: Traversal::ComputeLoop,
        steps: |context, steps| cast(context, steps, dispatched),
        ..of
    }
}

pub const SINGLE_PASS: Method = Method {
    takes: |scene| {
        takes_voxels(scene)?;
        adaptive::check(scene)
    },
    ..row("single-pass", "Ray casting by one shader that holds the whole ray", Ahead::Nothing, None)
};

pub const SINGLE_PASS_BLOCK: Method = row(
    "single-pass-block",
    "single-pass that leaps over empty 8^3 blocks inside its loop",
    Ahead::Blocks,
    Some(&SINGLE_PASS),
);

pub const SINGLE_PASS_OMNI: Method = row(
    "single-pass-omni",
    "single-pass that leaps by the distance in any direction",
    Ahead::Distances(Distance::Omni),
    Some(&SINGLE_PASS),
);

pub const SINGLE_PASS_DIRECTIONAL: Method = row(
    "single-pass-directional",
    "single-pass that leaps by the distance within the octant of its ray",
    Ahead::Distances(Distance::Directional),
    Some(&SINGLE_PASS),
);

pub const SINGLE_PASS_COMPUTE: Method =
    computed(SINGLE_PASS, "single-pass+compute", "single-pass as a compute shader, in tiles of 8 x 8 pixels", None);

pub const SINGLE_PASS_BLOCK_COMPUTE: Method = computed(
    SINGLE_PASS_BLOCK,
    "single-pass-block+compute",
    "single-pass-block as a compute shader",
    Some(&SINGLE_PASS_COMPUTE),
);

pub const SINGLE_PASS_OMNI_COMPUTE: Method = computed(
    SINGLE_PASS_OMNI,
    "single-pass-omni+compute",
    "single-pass-omni as a compute shader",
    Some(&SINGLE_PASS_COMPUTE),
);

pub const SINGLE_PASS_DIRECTIONAL_COMPUTE: Method = computed(
    SINGLE_PASS_DIRECTIONAL,
    "single-pass-directional+compute",
    "single-pass-directional as a compute shader",
    Some(&SINGLE_PASS_COMPUTE),
);

/// The loop as a fragment shader.
fn drawn(context: &Context, steps: &mut Steps) {
    steps.push(single_pass(context));
}

/// The loop as a compute shader.
fn dispatched(context: &Context, steps: &mut Steps) {
    steps.push(single_pass_compute(context));
}
