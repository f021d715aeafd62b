//! What rays begin with, in every pixel the box covers: a ray that is skipped never draws it.

use super::constants;
use crate::part::resource::{Resource, Usage};
use crate::part::rows::Context;
use crate::part::{Draw, Faces, Group, Step};
use crate::twin;

pub fn start(context: &Context) -> Step {
    let accesses = vec![
        Usage::Vertices.of(Resource::Box),
        Usage::Sampled.of(Resource::Frame),
        Usage::Color.of(Resource::Accumulated),
    ];
    let mut draw = Draw::plain(Faces::Front, "start.frag", twin::start::start);
    draw.specialize([constants::projection(context)]);
    Step::drawn("start".to_owned(), Group::Setup, 0, accesses, draw)
}
