//! The whole ray in one loop [Stegmaier05 §3, §5], drawn or computed.

use std::sync::Arc;

use super::{constants, rays};
use crate::feature::{self, BLOCK_RANGES, DISTANCES, EARLY_ENDS, ISO_SURFACE, effect, lights, surface};
use crate::geometry::ray_begins;
use crate::glsl::Shader;
use crate::part::access::{Access, Usage};
use crate::part::resource::Resource;
use crate::part::rows::{Context, Hook};
use crate::part::{Constant, Draw, Group, PixelDispatch, Step, Work};
use crate::resource;
use crate::scene::settings::Accumulate;
use crate::twin;

/// The loop as a fragment shader, for every pixel that the box's front faces cover, in the tiles that are drawn.
pub fn single_pass(context: &Context) -> Step {
    let of_loop = RayLoop::of(context);
    let geometry = ray_begins(context.view);
    let mut accesses = vec![Usage::Vertices.of(geometry.vertices)];
    accesses.extend(of_loop.read(Usage::Sampled));
    let drawn = if of_loop.goes_on { Usage::ColorInput } else { Usage::Color };
    accesses.push(drawn.of(resource::ACCUMULATED));
    let mut draw = Draw::plain(geometry, "single_pass.frag", twin::single_pass::single_pass);
    draw.define(of_loop.defines);
    rays::hand_on(context, &mut draw, &mut accesses);
    draw.insert(effect::insert(context));
    draw.specialize(of_loop.constants);
    Step::drawn("single_pass".to_owned(), Group::Main, 0, accesses, draw)
}

/// The loop as a compute shader, for every pixel of the targets.
pub fn single_pass_compute(context: &Context) -> Step {
    let of_loop = RayLoop::of(context);
    let mut accesses: Vec<Access> = of_loop.read(Usage::ComputeRead).collect();
    let written = if of_loop.goes_on { Usage::ImageUpdate } else { Usage::ImageWrite };
    accesses.push(written.of(resource::ACCUMULATED));
    let format = compute_format(context.scene.settings.image.accumulate);
    let insert = effect::insert(context);
    let shader = Shader { insert, ..Shader::new("single_pass.comp", of_loop.defines.into_iter().chain([format])) };
    let work = Work::Pixels(PixelDispatch {
        shader: Arc::new(shader),
        constants: Arc::new(of_loop.constants),
        twin: twin::single_pass::computed,
    });
    Step::new("single_pass_compute".to_owned(), Group::Main, 0, accesses, work)
}

/// The define of a compute shader that writes RES.
pub fn compute_format(accumulate: Accumulate) -> &'static str {
    match accumulate {
        Accumulate::Rgba32f => "RGBA32F",
        Accumulate::Rgba16f => "RGBA16F",
        Accumulate::Rgba8 => "RGBA8",
    }
}

/// What the loop is made of, whoever runs it.
struct RayLoop {
    reads: Vec<Resource>,
    defines: Vec<&'static str>,
    constants: Vec<Constant>,
    /// Whether the ray goes on behind a layer with what it holds.
    goes_on: bool,
}

impl RayLoop {
    fn of(context: &Context) -> Self {
        let surface = context.has(&ISO_SURFACE);
        let goes_on = context.section > 0;
        let mut hooks = vec![Hook::Interval, Hook::Ray, Hook::RayEnd, Hook::Sample];
        hooks.extend(surface.then_some(Hook::Light));
        let mut reads = vec![resource::FRAME];
        reads.extend(feature::values(context).map(|access| access.resource));
        reads.extend((surface && surface::is_lit(context)).then(|| lights::lights(context)));
        let mut defines: Vec<&str> = goes_on.then_some("GOES_ON").into_iter().collect();
        let mut constants = vec![constants::samples(context.scene), constants::projection(context)];
        for hook in hooks.iter().copied().chain([Hook::Decide]) {
            reads.extend(feature::reads(context, hook).into_iter().map(|access| access.resource));
            constants.extend(feature::constants(context, hook));
        }
        defines.extend(hooks.into_iter().flat_map(|hook| feature::defines(context, hook)));
        // An opaque surface ends its ray whatever T is.
        defines.extend(EARLY_ENDS.define(context).filter(|_| !context.scene.ends_at_surfaces()));
        defines.extend(leap(context));
        constants.extend(leap(context).map(|_| constants::spans(context.scene)));
        if surface {
            defines.extend(surface::shows(context));
            constants.push(surface::refine(context));
        }
        Self { reads, defines, constants, goes_on }
    }

    fn read(&self, usage: Usage) -> impl Iterator<Item = Access> {
        self.reads.iter().map(move |resource| usage.of(*resource))
    }
}

/// The define of a loop that leaps.
fn leap(context: &Context) -> Option<&'static str> {
    match () {
        () if context.has(&DISTANCES) => Some("LEAP_DISTANCES"),
        () if context.has(&BLOCK_RANGES) => Some("LEAP_BLOCKS"),
        () => None,
    }
}
