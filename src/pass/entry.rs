//! Entry point determination [KW03 §2.1, Thesis §5.2.2].

use crate::feature;
use crate::geometry::BOX_FRONT;
use crate::part::access::Usage;
use crate::part::rows::{Context, Hook};
use crate::part::{Draw, Group, Step};
use crate::resource;
use crate::twin;

pub fn entry(context: &Context) -> Step {
    let mut accesses = vec![Usage::Vertices.of(resource::BOX), Usage::Sampled.of(resource::FRAME)];
    accesses.extend(feature::reads(context, Hook::Interval));
    accesses.push(Usage::Color.of(resource::ENTRY));
    let mut draw = Draw::plain(&BOX_FRONT, "entry.frag", twin::entry::entry);
    draw.define(feature::defines(context, Hook::Interval));
    Step::drawn("entry".to_owned(), Group::Setup, 0, accesses, draw)
}
