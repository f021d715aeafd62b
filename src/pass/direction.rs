//! Ray direction determination [KW03 §2.1, Thesis §5.2.2].

use super::rays;
use crate::geometry::ray_ends;
use crate::part::access::Usage;
use crate::part::rows::Context;
use crate::part::{Draw, Group, Step};
use crate::resource;
use crate::twin;

pub fn direction(context: &Context) -> Step {
    let mut accesses = vec![Usage::Vertices.of(resource::BOX), Usage::Sampled.of(resource::FRAME)];
    let twin = match context.method.takes_samples() {
        true => twin::direction::direction,
        false => twin::direction::without_samples,
    };
    let mut draw = Draw::plain(ray_ends(context.view), "direction.frag", twin);
    rays::meet(context, &mut draw, &mut accesses);
    accesses.extend([Usage::Sampled.of(resource::ENTRY), Usage::Color.of(resource::DIRECTION)]);
    Step::drawn("direction".to_owned(), Group::Setup, 0, accesses, draw)
}
