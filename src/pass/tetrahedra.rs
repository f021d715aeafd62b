//! Rays through the cells of a mesh: where they enter, the ray propagation [Weiler03 "Multi-Pass Algorithm"], and its loop in one pass.

use std::sync::Arc;

use ash::vk;

use super::single_pass::compute_format;
use super::{constants, cull};
use crate::feature::{EARLY_ENDS, ISO_SURFACE, cells};
use crate::geometry::{BOUNDARY, SCREEN};
use crate::glsl::Shader;
use crate::part::access::{Access, Usage};
use crate::part::form::Form;
use crate::part::resource::Resource;
use crate::part::rows::Context;
use crate::part::{Constant, DepthTest, Draw, Group, PixelDispatch, Step, Work};
use crate::resource;
use crate::scene::settings::{Cull, Mark};
use crate::twin;

/// What every shader reads that sees vertices.
const VERTICES: [Resource; 2] = [resource::TET_VIEW, resource::TET_PLACES];

/// What goes from cell to cell reads besides.
const CELLS: [Resource; 2] = [resource::FRAME, resource::TET_ACROSS];

/// Whether rays begin within the mesh, behind the layer 0 then.
pub fn begins(context: &Context) -> bool {
    context.view.cells.as_ref().is_some_and(|cells| cells.begins.is_some())
}

/// How mesh data are read (`glsl/shared/rows.glsl`).
fn rows(context: &Context) -> Option<&'static str> {
    context.view.cells.as_ref().filter(|cells| cells.in_storage).map(|_| "STORAGE")
}

/// The faces behind which rays begin within the mesh.
pub fn begin(context: &Context) -> Step {
    let mut draw = Draw::plain(&SCREEN, "tet_enter.frag", twin::tetrahedra::enter);
    let mut accesses = vec![Usage::Vertices.of(resource::SCREEN_CORNERS), Usage::Sampled.of(resource::TET_BEGIN)];
    accesses.extend(VERTICES.map(|resource| Usage::Sampled.of(resource)));
    accesses.push(Usage::Sampled.of(resource::TET_BOUNDARY));
    draw.define(["BEGINS"]);
    draw.define(rows(context));
    accesses.push(Usage::Color.of(resource::TET_ENTRY));
    Step::drawn("tet_begin".to_owned(), Group::Setup, 0, accesses, draw)
}

/// The nearest faces by which rays enter, behind those of the layer before.
pub fn enter(context: &Context, layer: u32) -> Step {
    let mut draw = Draw::plain(&BOUNDARY, "tet_enter.frag", twin::tetrahedra::enter);
    let mut accesses = vec![Usage::Vertices.of(resource::TET_CORNERS), Usage::Sampled.of(resource::PLACEMENT)];
    accesses.extend(VERTICES.map(|resource| Usage::Sampled.of(resource)));
    accesses.push(Usage::Sampled.of(resource::TET_BOUNDARY));
    draw.define(rows(context));
    if let Some(before) = layer.checked_sub(1) {
        accesses.push(Usage::Sampled.of(resource::TET_ENTRY.at(before as u16)));
        draw.define(["LAYER_BEFORE"]);
        draw.define((before == 0 && begins(context)).then_some("AFTER_BEGIN"));
    }
    accesses.push(Usage::Color.of(resource::TET_ENTRY.at(layer as u16)));
    accesses.push(Usage::DepthAnew.of(resource::PEEL_DEPTH));
    draw.test = DepthTest { compare: Some(vk::CompareOp::GREATER), write: true, bounds: false };
    Step::drawn(format!("tet_enter #{layer}"), Group::Peel, layer, accesses, draw)
}

/// The whole way behind a layer, as a fragment shader.
pub fn single_pass(context: &Context, layer: u32) -> Step {
    let (reads, defines, constants) = through_cells(context, layer);
    let mut draw = Draw::plain(&SCREEN, "tet_single_pass.frag", twin::tetrahedra::single_pass);
    let mut accesses = vec![Usage::Vertices.of(resource::SCREEN_CORNERS)];
    accesses.extend(reads.into_iter().map(|resource| Usage::Sampled.of(resource)));
    accesses.push(if layer > 0 { Usage::ColorInput } else { Usage::Color }.of(resource::ACCUMULATED));
    draw.define(defines);
    draw.specialize(constants);
    Step::drawn("tet_single_pass".to_owned(), Group::Main, 0, accesses, draw)
}

/// The same as a compute shader.
pub fn single_pass_compute(context: &Context, layer: u32) -> Step {
    let (reads, defines, constants) = through_cells(context, layer);
    let mut accesses: Vec<Access> = reads.into_iter().map(|resource| Usage::ComputeRead.of(resource)).collect();
    accesses.push(if layer > 0 { Usage::ImageUpdate } else { Usage::ImageWrite }.of(resource::ACCUMULATED));
    let format = compute_format(context.scene.settings.image.accumulate);
    let shader = Shader::new("tet_single_pass.comp", defines.into_iter().chain([format]));
    let work = Work::Pixels(PixelDispatch {
        shader: Arc::new(shader),
        constants: Arc::new(constants),
        twin: twin::tetrahedra::single_pass,
    });
    Step::new("tet_single_pass_compute".to_owned(), Group::Main, 0, accesses, work)
}

/// What the loop behind a layer reads, its defines and its constants.
fn through_cells(context: &Context, layer: u32) -> (Vec<Resource>, Vec<&'static str>, Vec<Constant>) {
    let mut reads = [VERTICES, CELLS].concat();
    reads.extend([resource::TET_BOUNDARY, resource::TET_ENTRY.at(layer as u16)]);
    reads.extend(cells::reads(context));
    let mut defines = cells::defines(context);
    defines.extend(EARLY_ENDS.define(context));
    defines.extend((layer > 0).then_some("GOES_ON"));
    defines.extend((layer == 0 && begins(context)).then_some("FROM_WITHIN"));
    defines.extend(rows(context));
    let mut constants = cells::constants(context);
    constants.push(constants::projection(context));
    (reads, defines, constants)
}

/// Puts rays behind a layer of faces into the first set of traversal data [Weiler03 "Traversal Data"].
pub fn start(context: &Context, layer: u32) -> Step {
    let mut draw = Draw::plain(&SCREEN, "tet_start.frag", twin::tetrahedra::start);
    let mut accesses = vec![
        Usage::Vertices.of(resource::SCREEN_CORNERS),
        Usage::Sampled.of(resource::FRAME),
        Usage::Sampled.of(resource::TET_BOUNDARY),
        Usage::Sampled.of(resource::TET_ENTRY.at(layer as u16)),
        Usage::Color.of(resource::TET_CELL),
        Usage::Color.of(resource::TET_POINT),
    ];
    draw.define(rows(context));
    if context.projection().shows_values() {
        accesses.push(if layer > 0 { Usage::ColorInput } else { Usage::Color }.of(resource::ACCUMULATED));
        draw.define(["VALUES"]);
        draw.define((layer > 0).then_some("GOES_ON"));
        draw.specialize([constants::projection(context)]);
    }
    Step::drawn("tet_start".to_owned(), Group::Setup, 0, accesses, draw)
}

/// The update of depths: of rays that have left the mesh behind this layer, or need no more, before main pass `pass`, an even one
/// [Weiler03 "Terminating Finished Rays"].
pub fn update(context: &Context, pass: u32, form: Form) -> Step {
    let mut draw = Draw::plain(&SCREEN, "tet_update.frag", twin::tetrahedra::update);
    let mut accesses = vec![
        Usage::Vertices.of(resource::SCREEN_CORNERS),
        Usage::Sampled.of(resource::FRAME),
        Usage::Sampled.of(resource::TET_CELL),
    ];
    accesses.extend(context.has(&EARLY_ENDS).then_some(Usage::Sampled.of(resource::ACCUMULATED)));
    draw.define(EARLY_ENDS.define(context));
    draw.specialize([constants::depth_bits(context.scene), constants::projection(context)]);
    if form.mark != Mark::Copy {
        // The reason stands in the shader.
        accesses.push(Usage::Color.of(resource::TET_POINT.at(1)));
        draw.define(["BESIDE"]);
    }
    cull::mark_into(&mut draw, &mut accesses, form.mark, vk::CompareOp::ALWAYS);
    Step::drawn(format!("tet_update #{pass}"), Group::Intermediate, pass, accesses, draw)
}

/// A propagation step: through the current cell of each ray to the next.
pub fn propagate(context: &Context, pass: u32, culled: Option<(Cull, f32)>) -> Step {
    let mut draw = Draw::plain(&SCREEN, "tet_propagation.frag", twin::tetrahedra::propagate);
    let (from, to) = ((pass % 2) as u16, ((pass + 1) % 2) as u16);
    let mut accesses = vec![Usage::Vertices.of(resource::SCREEN_CORNERS)];
    accesses.extend(
        VERTICES.into_iter().chain(CELLS).chain([resource::TET_CELLS]).map(|resource| Usage::Sampled.of(resource)),
    );
    accesses.extend(cells::reads(context).into_iter().map(|resource| Usage::Sampled.of(resource)));
    accesses.extend([resource::TET_CELL, resource::TET_POINT].map(|set| Usage::Sampled.of(set.at(from))));
    accesses.extend([resource::TET_CELL, resource::TET_POINT].map(|set| Usage::Color.of(set.at(to))));
    accesses.push(Usage::Color.of(resource::ACCUMULATED));
    draw.define(cells::defines(context));
    draw.define((pass == 0 && context.has(&ISO_SURFACE)).then_some("ENTERS"));
    draw.define(begins(context).then_some("FROM_WITHIN"));
    draw.define(rows(context));
    draw.specialize(cells::constants(context));
    draw.specialize([constants::projection(context)]);
    draw.blend = context.projection().blend;
    if let Some((how, bound)) = culled {
        cull::cull_by_stored(&mut draw, &mut accesses, how, bound);
    }
    Step::drawn(format!("tet_propagation #{pass}"), Group::Main, pass, accesses, draw)
}
