//! How often rays enter each clip mesh more than they leave it.

use super::polygons;
use crate::feature::ORTHOGRAPHIC;
use crate::geometry::CLIP_POLYGONS;
use crate::math::blend::Blend;
use crate::part::access::Usage;
use crate::part::rows::Context;
use crate::part::{Draw, Group, Step};
use crate::resource;
use crate::twin;

/// Counts the fronts less the backs of each clip mesh that a ray meets.
pub fn clip_winding(context: &Context) -> Step {
    let mut accesses = polygons::reads();
    accesses.push(Usage::Color.of(resource::CLIP_WINDING));
    let mut draw = Draw::plain(&CLIP_POLYGONS, "clip_winding.frag", twin::clip_winding::clip_winding);
    draw.define(ORTHOGRAPHIC.define(context));
    draw.blend = Blend::Add;
    Step::drawn("clip_winding".to_owned(), Group::Setup, 0, accesses, draw)
}
