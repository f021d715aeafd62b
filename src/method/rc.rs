//! `rc`: ray casting without acceleration [KW03 §2.1].

use super::rows::RAY_CASTER;
use crate::part::rows::Method;

pub const RC: Method = Method {
    name: "rc",
    about: "Ray casting without acceleration",
    source: "KW03 §2.1",
    papers: None,
    forms: Vec::new,
    ends_rays: false,
    ..RAY_CASTER
};
