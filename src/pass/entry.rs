//! Entry point determination [KW03 §2.1, Thesis §5.2.2].

use crate::geometry::BOX_FRONT;
use crate::part::access::Usage;
use crate::part::{Draw, Group, Step, Work};
use crate::resource;
use crate::twin;

pub fn entry() -> Step {
    Step::new(
        "entry".to_owned(),
        Group::Setup,
        0,
        vec![Usage::Vertices.of(resource::BOX), Usage::Sampled.of(resource::FRAME), Usage::Color.of(resource::ENTRY)],
        Work::Draw(Draw::plain(&BOX_FRONT, "entry.frag", twin::entry::entry)),
    )
}
