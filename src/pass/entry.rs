//! Entry point determination [KW03 §2.1, Thesis §5.2.2].

use crate::geometry::BOX_FRONT;
use crate::part::access::Usage;
use crate::part::{Draw, Group, Step, Work};
use crate::resource;
use crate::twin;

pub fn entry() -> Step {
    Step {
        name: "entry".to_owned(),
        group: Group::Setup,
        pass: 0,
        accesses: vec![
            Usage::Vertices.of(resource::BOX),
            Usage::Sampled.of(resource::FRAME),
            Usage::Color.of(resource::ENTRY),
        ]
        .into(),
        work: Work::Draw(Draw::plain(&BOX_FRONT, "entry.frag", twin::entry::entry)),
    }
}
