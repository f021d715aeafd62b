//! What a frame may have and a scene may not need: [`FEATURES`] is the one list.
//!
//! To add one: a file here with its row, a line in [`FEATURES`] (the order of the lines of plans), its code in the shaders at
//! its hook with its f64 twin, and scenes that need it and do not need it in `tests/matrix/scenes.rs`, which a test asks for.

pub mod adaptive;
mod apart;
pub mod backdrop;
mod block_ranges;
pub mod cells;
mod classification;
pub mod clip_volume;
mod colors;
mod counting;
mod decisions;
mod distances;
mod early_ends;
pub mod effect;
pub mod environment;
mod extra_fetches;
pub mod gradients;
mod holes;
mod interpolation;
mod last_sample;
pub mod layers;
pub mod light_paths;
pub mod lights;
mod opacity_correction;
mod orthographic;
mod planes;
mod preintegration;
mod reasons;
pub mod refraction;
pub mod shells;
pub mod single_rays;
mod start;
pub mod surface;
pub mod tiles;
mod transfer_function;

pub use adaptive::ADAPTIVE;
pub use apart::APART;
pub use backdrop::{BACKDROP, BACKDROP_PICTURE};
pub use block_ranges::BLOCK_RANGES;
pub use clip_volume::CLIP_VOLUME;
pub use counting::{BATCH, COUNTING};
pub use decisions::{DECISIONS, MARK_COPIES};
pub use distances::DISTANCES;
pub use early_ends::{EARLY_ENDS, may_end, rays_may_end};
pub use effect::EFFECT;
pub use environment::ENVIRONMENT;
pub use layers::{CLIP_BEGIN, DEPTH_LAYERS, OPAQUE_SURFACE};
pub use orthographic::ORTHOGRAPHIC;
pub use refraction::REFRACTION;
pub use single_rays::SINGLE_RAYS;
pub use start::START;
pub use surface::{ISO_SURFACE, SURFACES_IN_VOLUME, TRANSPARENT_SURFACES};

use crate::part::Constant;
use crate::part::access::{Access, Usage};
use crate::part::rows::{Context, Feature, Hook};
use crate::resource;
use classification::CLASSIFICATION;
use colors::COLORS;
use decisions::LATER_DECISIONS;
use extra_fetches::EXTRA_FETCHES;
use gradients::{GRADIENT_TEXTURE, GRADIENTS_BESIDE_SAMPLES};
use holes::HOLES;
use interpolation::{INTERPOLATION, SHADER_INTERPOLATION};
use last_sample::LAST_SAMPLE;
use layers::{CLIPPED, LAYER_BEFORE, LAYER_BEHIND};
use light_paths::{SHADOWS, TRANSLUCENCY};
use lights::{LIGHT_COLORS, LIT_SAMPLES};
use opacity_correction::OPACITY_CORRECTION;
use planes::CLIP_PLANES;
use preintegration::PREINTEGRATION;
use transfer_function::{FEW_PIECES, TRANSFER_FUNCTION};

/// Every feature, in the order in which plans say what was left out.
pub const FEATURES: [&Feature; 45] = [
    &DECISIONS,
    &MARK_COPIES,
    &LATER_DECISIONS,
    &DISTANCES,
    &BLOCK_RANGES,
    &EARLY_ENDS,
    &START,
    &CLASSIFICATION,
    &COLORS,
    &HOLES,
    &OPACITY_CORRECTION,
    &PREINTEGRATION,
    &ADAPTIVE,
    &LAST_SAMPLE,
    &SHADER_INTERPOLATION,
    &INTERPOLATION,
    &COUNTING,
    &TRANSFER_FUNCTION,
    &FEW_PIECES,
    &EXTRA_FETCHES,
    &DEPTH_LAYERS,
    &CLIP_BEGIN,
    &LAYER_BEFORE,
    &CLIPPED,
    &LAYER_BEHIND,
    &OPAQUE_SURFACE,
    &APART,
    &ORTHOGRAPHIC,
    &CLIP_PLANES,
    &SINGLE_RAYS,
    &CLIP_VOLUME,
    &ISO_SURFACE,
    &TRANSPARENT_SURFACES,
    &SURFACES_IN_VOLUME,
    &LIT_SAMPLES,
    &GRADIENT_TEXTURE,
    &GRADIENTS_BESIDE_SAMPLES,
    &LIGHT_COLORS,
    &ENVIRONMENT,
    &SHADOWS,
    &TRANSLUCENCY,
    &EFFECT,
    &REFRACTION,
    &BACKDROP,
    &BACKDROP_PICTURE,
];

fn at(hook: Hook) -> impl Iterator<Item = &'static Feature> {
    FEATURES.into_iter().filter(move |feature| feature.at == hook)
}

/// The specialization constants of all features at a hook.
pub fn constants(context: &Context, hook: Hook) -> Vec<Constant> {
    at(hook).flat_map(|feature| (feature.constants)(context)).collect()
}

/// What shaders with a hook read of the features there are.
pub fn reads(context: &Context, hook: Hook) -> Vec<Access> {
    let there = at(hook).filter(|feature| context.has(feature));
    there.flat_map(|feature| (feature.reads)(context)).map(|resource| Usage::Sampled.of(resource)).collect()
}

/// The volume, or the stack of textures that the view is drawn with, where samples do not take their values from beside their gradients.
pub fn values(context: &Context) -> Option<Access> {
    let volume = context.view.stack_axis().map_or(resource::VOLUME, |axis| resource::STACKS[axis]);
    (!context.has(&GRADIENTS_BESIDE_SAMPLES)).then(|| Usage::Sampled.of(volume))
}

/// The defines of a shader with a hook.
pub fn defines(context: &Context, hook: Hook) -> Vec<&'static str> {
    at(hook).filter_map(|feature| feature.define(context)).collect()
}
