//! Ray direction determination [KW03 §2.1, Thesis §5.2.2].

use crate::feature;
use crate::geometry::BOX_BACK;
use crate::part::access::Usage;
use crate::part::rows::{Context, Hook};
use crate::part::{Draw, Group, Step};
use crate::resource;
use crate::twin;

pub fn direction(context: &Context) -> Step {
    let mut accesses = vec![Usage::Vertices.of(resource::BOX), Usage::Sampled.of(resource::FRAME)];
    accesses.extend(feature::reads(context, Hook::Interval));
    accesses.extend([Usage::Sampled.of(resource::ENTRY), Usage::Color.of(resource::DIRECTION)]);
    let twin = match context.method.takes_samples() {
        true => twin::direction::direction,
        false => twin::direction::without_samples,
    };
    let mut draw = Draw::plain(&BOX_BACK, "direction.frag", twin);
    draw.define(feature::defines(context, Hook::Interval));
    Step::drawn("direction".to_owned(), Group::Setup, 0, accesses, draw)
}
