//! What is behind the volume, in every pixel of the view [Stegmaier05 §4].

use crate::feature::BACKDROP_PICTURE;
use crate::feature::backdrop::constants;
use crate::geometry::SCREEN;
use crate::part::access::Usage;
use crate::part::rows::Context;
use crate::part::{Draw, Group, Step};
use crate::resource;
use crate::twin;

pub fn backdrop(context: &Context) -> Step {
    let mut accesses = vec![Usage::Vertices.of(resource::SCREEN_CORNERS), Usage::Sampled.of(resource::FRAME)];
    let mut draw = Draw::plain(&SCREEN, "backdrop.frag", twin::backdrop::backdrop);
    if context.has(&BACKDROP_PICTURE) {
        accesses.push(Usage::Sampled.of(resource::BACKDROP));
    }
    accesses.push(Usage::Color.of(resource::ACCUMULATED));
    draw.define(BACKDROP_PICTURE.define(context));
    draw.specialize(context.scene.backdrop.iter().flat_map(|one| constants(context.scene, one)));
    Step::drawn("backdrop".to_owned(), Group::Setup, 0, accesses, draw)
}
