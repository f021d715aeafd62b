//! Within which clip meshes rays begin.

use crate::feature::layers::{clip_begin as begin_of, clip_meshes};
use crate::geometry::SCREEN;
use crate::part::access::Usage;
use crate::part::rows::Context;
use crate::part::{Draw, Group, Step};
use crate::resource;
use crate::twin;

/// What rays begin within, from what they enter more often than they leave it.
pub fn clip_begin(context: &Context) -> Step {
    let accesses = vec![
        Usage::Vertices.of(resource::SCREEN_CORNERS),
        Usage::Sampled.of(resource::CLIP_WINDING),
        Usage::Color.of(begin_of(context)),
    ];
    let mut draw = Draw::plain(&SCREEN, "clip_begin.frag", twin::clip_begin::clip_begin);
    draw.specialize(clip_meshes(context));
    Step::drawn("clip_begin".to_owned(), Group::Setup, 0, accesses, draw)
}
