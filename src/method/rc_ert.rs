//! `rc-ert`: ray casting with early ray termination by early z [KW03 §2.1].

use super::rows::{RAY_CASTER, cast, switched, takes_any_steps};
use crate::part::rows::Method;
use crate::pass::termination::termination;

pub const RC_ERT: Method = Method {
    name: "rc-ert",
    about: "Ray casting with early ray termination by early z",
    source: "KW03 §2.1",
    takes: takes_any_steps,
    steps: |context, steps| cast(context, steps, |context, steps| switched(context, steps, 1, termination)),
    ..RAY_CASTER
};
