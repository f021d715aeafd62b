//! `cpu`: the f64 reference, the sum of `rc-ert` on the CPU.

use super::rc_ert::RC_ERT;
use super::rows::{RAY_CASTER, takes_any_steps};
use crate::part::rows::Method;

pub const CPU: Method = Method {
    name: "cpu",
    about: "The f64 reference: the same sum, on the CPU",
    source: "KW03 §2.1",
    takes: takes_any_steps,
    forms: Vec::new,
    on_device: false,
    skips_of: Some(&RC_ERT),
    steps: RC_ERT.steps,
    ..RAY_CASTER
};
