//! Entry point determination [KW03 §2.1, Thesis §5.2.2].

use crate::part::resource::{Resource, Usage};
use crate::part::{Draw, Faces, Group, Step, Work};
use crate::twin;

pub fn entry() -> Step {
    Step {
        name: "entry".to_owned(),
        group: Group::Setup,
        pass: 0,
        accesses: vec![
            Usage::Vertices.of(Resource::Box),
            Usage::Sampled.of(Resource::Frame),
            Usage::Color.of(Resource::Entry),
        ]
        .into(),
        work: Work::Draw(Draw::plain(Faces::Front, "entry.frag", twin::entry::entry)),
    }
}
