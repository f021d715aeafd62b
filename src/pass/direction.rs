//! Ray direction determination [KW03 §2.1, Thesis §5.2.2].

use crate::part::resource::{Resource, Usage};
use crate::part::{Draw, Faces, Group, Step, Work};
use crate::twin;

pub fn direction() -> Step {
    Step {
        name: "direction".to_owned(),
        group: Group::Setup,
        pass: 0,
        accesses: vec![
            Usage::Vertices.of(Resource::Box),
            Usage::Sampled.of(Resource::Frame),
            Usage::Sampled.of(Resource::Entry),
            Usage::Color.of(Resource::Direction),
        ]
        .into(),
        work: Work::Draw(Draw::plain(Faces::Back, "direction.frag", twin::direction::direction)),
    }
}
