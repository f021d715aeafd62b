//! Ray direction determination [KW03 §2.1, Thesis §5.2.2].

use crate::geometry::BOX_BACK;
use crate::part::access::Usage;
use crate::part::{Draw, Group, Step, Work};
use crate::resource;
use crate::twin;

pub fn direction() -> Step {
    Step::new(
        "direction".to_owned(),
        Group::Setup,
        0,
        vec![
            Usage::Vertices.of(resource::BOX),
            Usage::Sampled.of(resource::FRAME),
            Usage::Sampled.of(resource::ENTRY),
            Usage::Color.of(resource::DIRECTION),
        ],
        Work::Draw(Draw::plain(&BOX_BACK, "direction.frag", twin::direction::direction)),
    )
}
