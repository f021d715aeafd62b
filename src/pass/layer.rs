//! Colours of a layer under what is in front of it [Thesis ch. 6 §2.2], or over what is behind it [Thesis ch. 6 §2.1].

use std::sync::Arc;

use crate::feature::ISO_SURFACE;
use crate::geometry::SCREEN;
use crate::math::blend::Blend;
use crate::part::access::Usage;
use crate::part::rows::Context;
use crate::part::{Draw, Group, Step, Work};
use crate::resource;
use crate::twin::{self, TwinPass};

/// Blends the colours of `layer` in, wherever it has some and no iso-surface is in front of it.
pub fn layer(context: &Context, layer: u32) -> Step {
    let mut step = blended(context, format!("layer #{layer}"), layer, twin::layer::layer);
    // In a loop a surface in front of it has ended the ray, whose opacity leaves nothing to be seen behind it.
    if context.has(&ISO_SURFACE) && !context.method.loops() {
        Arc::make_mut(&mut step.accesses).push(Usage::Sampled.of(resource::SURFACE_HIT));
        if let Work::Draw(draw) = &mut step.work {
            draw.define(["SURFACE"]);
            draw.twin = Some(twin::layer::layer_without_surface);
        }
    }
    step
}

/// Blends the colours of opaque polygons in, whose layer is that behind the transparent ones.
pub fn opaque(context: &Context) -> Step {
    blended(context, "layer_opaque".to_owned(), context.layers, twin::layer::opaque)
}

/// Draws the colours of opaque polygons in place of what is there, before what may be in front of them.
pub fn opaque_first(context: &Context) -> Step {
    let mut step = blended(context, "layer_opaque".to_owned(), context.layers, twin::layer::opaque_first);
    if let Work::Draw(draw) = &mut step.work {
        draw.blend = Blend::Replace;
    }
    step
}

fn blended(context: &Context, name: String, layer: u32, twin: TwinPass) -> Step {
    let accesses = vec![
        Usage::Vertices.of(resource::SCREEN_CORNERS),
        Usage::Sampled.of(resource::LAYER.at(layer as u16)),
        Usage::Sampled.of(resource::LAYER_COLOR.at(layer as u16)),
        Usage::Color.of(resource::ACCUMULATED),
    ];
    let mut draw = Draw::plain(&SCREEN, "layer.frag", twin);
    draw.blend = context.blend();
    Step::drawn(name, Group::Blend, layer, accesses, draw)
}
