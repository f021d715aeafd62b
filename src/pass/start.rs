//! What rays begin with, in every pixel the box covers: a ray that is skipped never draws it.

use super::constants;
use crate::geometry::BOX_FRONT;
use crate::part::access::Usage;
use crate::part::rows::Context;
use crate::part::{Draw, Group, Step};
use crate::resource;
use crate::twin;

pub fn start(context: &Context) -> Step {
    let accesses = vec![
        Usage::Vertices.of(resource::BOX),
        Usage::Sampled.of(resource::FRAME),
        Usage::Color.of(resource::ACCUMULATED),
    ];
    let mut draw = Draw::plain(&BOX_FRONT, "start.frag", twin::start::start);
    draw.specialize([constants::projection(context)]);
    Step::drawn("start".to_owned(), Group::Setup, 0, accesses, draw)
}
