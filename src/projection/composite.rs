//! `composite`: colours by the transfer function, front to back [KW03 §1.1].

use super::row::{Ends, Projection};
use crate::math::blend::Blend;

pub const COMPOSITE: Projection = Projection {
    name: "composite",
    about: "Colours by the transfer function, each put under those in front of it",
    source: "KW03 §1.1",
    code: 0,
    blend: Blend::Over,
    ends: Ends::Opaque,
    values: None,
};
