//! What rays begin with, in every pixel the box covers: a ray that is skipped never draws it.

use super::{constants, rays};
use crate::geometry::BOX_FRONT;
use crate::part::access::Usage;
use crate::part::rows::Context;
use crate::part::{Draw, Group, Step};
use crate::resource;
use crate::twin;

pub fn start(context: &Context) -> Step {
    let mut accesses = vec![Usage::Vertices.of(resource::BOX), Usage::Sampled.of(resource::FRAME)];
    let mut draw = Draw::plain(&BOX_FRONT, "start.frag", twin::start::start);
    if context.projection().levels_in_x(context.scene).falls() {
        draw.define(["SHORT_RAYS"]);
        rays::find_length(context, &mut draw, &mut accesses);
    }
    accesses.push(Usage::Color.of(resource::ACCUMULATED));
    draw.specialize([constants::projection(context)]);
    Step::drawn("start".to_owned(), Group::Setup, 0, accesses, draw)
}

/// The same where nothing but surfaces emits.
pub fn black() -> Step {
    let accesses = vec![Usage::Vertices.of(resource::BOX), Usage::Color.of(resource::ACCUMULATED)];
    let mut draw = Draw::plain(&BOX_FRONT, "start.frag", twin::start::black);
    draw.define(["BLACK"]);
    Step::drawn("start".to_owned(), Group::Setup, 0, accesses, draw)
}
