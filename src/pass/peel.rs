//! Depth peeling of polygons [Thesis ch. 6 §1.5], a render pass a layer.

use ash::vk;

use super::polygons;
use crate::feature::layers::{clip_begin, clip_meshes, opaque_layer};
use crate::feature::{self, CLIP_BEGIN, OPAQUE_SURFACE};
use crate::geometry::{CLIP_POLYGONS, OPAQUE_POLYGONS, PEELED_POLYGONS};
use crate::part::access::{Access, Usage};
use crate::part::geometry::Geometry;
use crate::part::resource::Resource;
use crate::part::rows::{Context, Hook};
use crate::part::{DepthTest, Draw, Group, Step};
use crate::resource;
use crate::twin::{self, TwinPass};

/// The nearest opaque polygons.
pub fn opaque(context: &Context) -> Step {
    let (mut draw, mut accesses) = drawn(context, &OPAQUE_POLYGONS, twin::peel::opaque);
    behind_clip(context, &mut draw, &mut accesses);
    into(opaque_layer(context), true, &mut draw, &mut accesses);
    Step::drawn("peel_opaque".to_owned(), Group::Peel, 0, accesses, draw)
}

/// The nearest surfaces of clip geometry, in front of which nothing shows [Thesis ch. 6 §3].
pub fn clip(context: &Context) -> Step {
    let (mut draw, mut accesses) = drawn(context, &CLIP_POLYGONS, twin::peel::clip);
    into(clip_begin(context), false, &mut draw, &mut accesses);
    Step::drawn("clip".to_owned(), Group::Setup, 0, accesses, draw)
}

/// The nearest transparent polygons and clip geometry behind those of the layers before, in front of opaque ones.
pub fn transparent(context: &Context, layer: u32) -> Step {
    let (mut draw, mut accesses) = drawn(context, &PEELED_POLYGONS, twin::peel::transparent);
    if layer > 0 {
        accesses.push(Usage::Sampled.of(resource::LAYER.at(layer as u16 - 1)));
        draw.define(["LAYER_BEFORE"]);
    } else {
        behind_clip(context, &mut draw, &mut accesses);
    }
    if context.has(&OPAQUE_SURFACE) {
        accesses.push(Usage::Sampled.of(opaque_layer(context)));
        draw.define(["OPAQUE"]);
    }
    if !context.scene.polygons.clips().is_empty() {
        draw.define(["CLIPPED"]);
        draw.specialize(clip_meshes(context));
    }
    into(resource::LAYER.at(layer as u16), context.blends, &mut draw, &mut accesses);
    Step::drawn(format!("peel #{layer}"), Group::Peel, layer, accesses, draw)
}

fn drawn(context: &Context, geometry: &'static Geometry, twin: TwinPass) -> (Draw, Vec<Access>) {
    let (mut draw, mut accesses) = (Draw::plain(geometry, "peel.frag", twin), polygons::reads());
    accesses.extend(feature::reads(context, Hook::Interval));
    draw.define(feature::defines(context, Hook::Interval));
    (draw, accesses)
}

/// Lets nothing show in front of where clip geometry lets rays begin.
fn behind_clip(context: &Context, draw: &mut Draw, accesses: &mut Vec<Access>) {
    if !context.has(&CLIP_BEGIN) {
        return;
    }
    accesses.push(Usage::Sampled.of(clip_begin(context)));
    draw.define(["LAYER_BEFORE"]);
    draw.define(context.scene.polygons.cuts_in_front().then_some("CLIP_FIRST"));
}

/// Keeps the nearest surfaces, and their colours where somebody asks for them.
fn into(to: Resource, colored: bool, draw: &mut Draw, accesses: &mut Vec<Access>) {
    accesses.push(Usage::Color.of(to));
    if colored {
        draw.define(["COLORED"]);
        accesses.push(Usage::Color.of(resource::LAYER_COLOR.at(to.index)));
    }
    accesses.push(Usage::DepthAnew.of(resource::PEEL_DEPTH));
    draw.test = DepthTest { compare: Some(vk::CompareOp::GREATER), write: true, bounds: false };
}
