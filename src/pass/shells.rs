//! Shells, one a pass [Heidrich95 §2, §3], and the surfaces that hide what is behind them [Heidrich95 §4].

use ash::vk;

use crate::feature::ORTHOGRAPHIC;
use crate::feature::layers::opaque_layer;
use crate::geometry::{SHELL_SURFACES, SHELLS};
use crate::math::blend::Blend;
use crate::part::access::{Access, Usage};
use crate::part::rows::Context;
use crate::part::{DepthTest, Draw, Group, Step};
use crate::resource;
use crate::scene::settings::{ShellMode, ShellSum};
use crate::scene::shells::ShellDepth;
use crate::twin;

/// Keeps what is nearer, or brighter.
const GREATER: Option<vk::CompareOp> = Some(vk::CompareOp::GREATER);

/// The depths that 0 and 1 are taken to for a shell.
fn range(context: &Context, number: u32) -> [f32; 2] {
    let emission = context.scene.shells.as_ref().map_or(0.0, |shells| shells.list[number as usize].emission);
    let depth = ShellDepth::of(context.scene, &context.view.rays);
    let mode = context.scene.settings.shells.mode.unwrap_or(ShellMode::Sum);
    depth.map_or([0.0, 1.0], |depth| depth.range(mode, emission))
}

/// A shell, by its number from the dimmest on.
pub fn shell(context: &Context, number: u32) -> Step {
    let polygons = resource::SHELL_POLYGONS.at(number as u16);
    let mut accesses = vec![
        Usage::Vertices.of(polygons),
        Usage::Placing.of(resource::SHELL_PLACEMENT),
        Usage::Sampled.of(resource::SHELL_CUE),
    ];
    let mut draw = Draw::plain(&SHELLS, "shells.frag", twin::shells::shell);
    (draw.vertices, draw.depths) = (polygons, range(context, number));
    let mode = context.scene.settings.shells.mode.unwrap_or(ShellMode::Sum);
    match mode {
        ShellMode::Max => accesses.push(Usage::Color.of(resource::ACCUMULATED)),
        ShellMode::Sum => sum(context, &mut draw, &mut accesses),
        ShellMode::Surface => surface(context, &mut draw, &mut accesses),
    }
    if mode != ShellMode::Sum {
        accesses.push(Usage::DepthWrite.of(resource::SHELL_DEPTH));
        draw.test = DepthTest { compare: GREATER, write: true, bounds: false };
    } else if context.opaque {
        accesses.push(Usage::DepthTest.of(resource::SHELL_DEPTH));
        draw.test = DepthTest { compare: GREATER, write: false, bounds: false };
    }
    draw.blend = if mode == ShellMode::Surface { Blend::Replace } else { context.blend() };
    Step::drawn(format!("shell_pass #{number}"), Group::Main, number, accesses, draw)
}

/// What a shell adds to a sum.
fn sum(context: &Context, draw: &mut Draw, accesses: &mut Vec<Access>) {
    accesses.push(Usage::Sampled.of(resource::SHELL_LEVELS));
    if context.scene.settings.shells.sum == ShellSum::Lengths {
        accesses.push(Usage::Sampled.of(resource::FRAME));
        draw.define(["LENGTHS"]);
        draw.define(context.has(&ORTHOGRAPHIC).then_some("ORTHOGRAPHIC"));
        if context.opaque {
            accesses.push(Usage::Sampled.of(opaque_layer(context)));
            draw.define(["OPAQUE"]);
        }
    } else {
        draw.define(["CROSSINGS"]);
    }
    accesses.push(Usage::Color.of(resource::ACCUMULATED));
}

/// Where on its ray a shell is.
fn surface(context: &Context, draw: &mut Draw, accesses: &mut Vec<Access>) {
    let read = [resource::FRAME, resource::ENTRY, resource::DIRECTION];
    accesses.extend(read.map(|resource| Usage::Sampled.of(resource)));
    draw.define(["SURFACE"]);
    draw.define(context.has(&ORTHOGRAPHIC).then_some("ORTHOGRAPHIC"));
    accesses.push(Usage::Color.of(resource::SURFACE_HIT));
}

/// Opaque polygons into the depth buffer, without colours; where the greatest is to be found under the matrix of a shell.
pub fn surfaces(context: &Context, number: Option<u32>) -> Step {
    let accesses = vec![
        Usage::Vertices.of(SHELL_SURFACES.vertices),
        Usage::Placing.of(resource::SHELL_PLACEMENT),
        Usage::DepthWrite.of(resource::SHELL_DEPTH),
    ];
    let mut draw = Draw::plain(&SHELL_SURFACES, "", twin::shells::surfaces);
    (draw.shader, draw.depths) = (None, range(context, number.unwrap_or(0)));
    draw.test = DepthTest { compare: GREATER, write: true, bounds: false };
    match number {
        Some(number) => Step::drawn(format!("surface_pass #{number}"), Group::Intermediate, number, accesses, draw),
        None => Step::drawn("surface_pass".to_owned(), Group::Setup, 0, accesses, draw),
    }
}
