//! Depth peeling of polygons [Thesis ch. 6 §1.5], a render pass a layer.

use ash::vk;

use crate::feature::OPAQUE_SURFACE;
use crate::feature::layers::opaque_layer;
use crate::geometry::{OPAQUE_POLYGONS, TRANSPARENT_POLYGONS};
use crate::part::access::{Access, Usage};
use crate::part::geometry::Geometry;
use crate::part::resource::Resource;
use crate::part::rows::Context;
use crate::part::{DepthTest, Draw, Group, Step};
use crate::resource;
use crate::twin::{self, TwinPass};

/// The nearest opaque polygons.
pub fn opaque(context: &Context) -> Step {
    let (draw, accesses) = drawn(&OPAQUE_POLYGONS, opaque_layer(context), Vec::new(), twin::peel::opaque);
    Step::drawn("peel_opaque".to_owned(), Group::Peel, 0, accesses, draw)
}

/// The nearest transparent polygons behind those of the layers before, in front of opaque ones.
pub fn transparent(context: &Context, layer: u32) -> Step {
    let mut read = Vec::new();
    let mut defines = Vec::new();
    if layer > 0 {
        read.push(Usage::Sampled.of(resource::LAYER.at(layer as u16 - 1)));
        defines.push("LAYER_BEFORE");
    }
    if context.has(&OPAQUE_SURFACE) {
        read.push(Usage::Sampled.of(opaque_layer(context)));
        defines.push("OPAQUE");
    }
    let to = resource::LAYER.at(layer as u16);
    let (mut draw, accesses) = drawn(&TRANSPARENT_POLYGONS, to, read, twin::peel::transparent);
    draw.define(defines);
    Step::drawn(format!("peel #{layer}"), Group::Peel, layer, accesses, draw)
}

fn drawn(geometry: &'static Geometry, to: Resource, read: Vec<Access>, twin: TwinPass) -> (Draw, Vec<Access>) {
    let mut accesses = vec![
        Usage::Vertices.of(resource::POLYGON_CORNERS),
        Usage::Sampled.of(resource::FRAME),
        Usage::Sampled.of(resource::PLACEMENT),
        Usage::Sampled.of(resource::TRIANGLES),
        Usage::Sampled.of(resource::MATERIALS),
    ];
    accesses.extend(read);
    accesses.push(Usage::Color.of(to));
    accesses.push(Usage::Color.of(resource::LAYER_COLOR.at(to.index)));
    accesses.push(Usage::DepthAnew.of(resource::PEEL_DEPTH));
    let mut draw = Draw::plain(geometry, "peel.frag", twin);
    draw.test = DepthTest { compare: Some(vk::CompareOp::GREATER), write: true, bounds: false };
    (draw, accesses)
}
