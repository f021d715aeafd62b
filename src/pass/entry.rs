//! Entry point determination [KW03 §2.1, Thesis §5.2.2].

use super::rays;
use crate::geometry::ray_begins;
use crate::part::access::Usage;
use crate::part::rows::Context;
use crate::part::{Draw, Group, Step};
use crate::resource;
use crate::twin;

pub fn entry(context: &Context) -> Step {
    let mut accesses = vec![Usage::Vertices.of(resource::BOX), Usage::Sampled.of(resource::FRAME)];
    let mut draw = Draw::plain(ray_begins(context.view), "entry.frag", twin::entry::entry);
    rays::meet(context, &mut draw, &mut accesses);
    accesses.push(Usage::Color.of(resource::ENTRY));
    draw.fills = true;
    Step::drawn("entry".to_owned(), Group::Setup, 0, accesses, draw)
}
