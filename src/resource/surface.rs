//! Iso-surfaces, the lights on them, and where rays meet them [Thesis ch. 5 §3.2].

use std::borrow::Cow;

use ash::vk;

use crate::part::resource::{Facts, Life, Origin, Resource, ResourceInfo, ResourceKind};
use crate::shared;

/// Iso values and the colours of their surfaces.
pub const SURFACE_LEVELS: Resource = Resource::new(&SURFACE_LEVELS_INFO);
static SURFACE_LEVELS_INFO: ResourceInfo = ResourceInfo {
    name: "surface_levels",
    holds: "linear colour of an iso-surface, and the texture's values that are on it, `SurfaceLevel` of surface.glsl",
    kind: ResourceKind::Storage(|facts, _| size_of_val(levels(facts).as_slice()) as u64),
    life: Life::Transfer,
    origin: Origin::Host(|facts| bytemuck::cast_slice(&levels(facts)).to_vec().into()),
};

fn levels(facts: &Facts) -> Vec<shared::SurfaceLevel> {
    let surface = facts.scene.surface.as_ref();
    surface.map_or_else(Vec::new, |surface| shared::surface_levels(facts.scene, surface))
}

/// Lights of all colours.
pub const LIGHTS: Resource = Resource::new(&LIGHTS_INFO);
static LIGHTS_INFO: ResourceInfo = ResourceInfo {
    name: "lights",
    holds: "four rows a light: its place or direction in volume space, and three linear colours, as phong.glsl has them",
    kind: ResourceKind::Storage(|facts, _| light_rows(facts, false).len() as u64),
    life: Life::Frame,
    origin: Origin::Host(|facts| light_rows(facts, false)),
};

/// White lights.
pub const WHITE_LIGHTS: Resource = Resource::new(&WHITE_LIGHTS_INFO);
static WHITE_LIGHTS_INFO: ResourceInfo = ResourceInfo {
    name: "lights",
    holds: "two rows a light: its place or direction in volume space, and its three parts with the exponent, as phong.glsl has them",
    kind: ResourceKind::Storage(|facts, _| light_rows(facts, true).len() as u64),
    life: Life::Frame,
    origin: Origin::Host(|facts| light_rows(facts, true)),
};

fn light_rows(facts: &Facts, white: bool) -> Cow<'static, [u8]> {
    bytemuck::cast_slice(&shared::light_rows(&facts.scene.shining(), white)).to_vec().into()
}

/// RES of rays that look for a surface: where they meet it.
pub const SURFACE_HIT: Resource = Resource::new(&SURFACE_HIT_INFO);
static SURFACE_HIT_INFO: ResourceInfo = ResourceInfo {
    name: "surface_hit",
    holds: "steps from the entry point to the last place in front of a surface and to the first one on it; in alpha 1 where there is one",
    kind: ResourceKind::Target(|_| vk::Format::R32G32B32A32_SFLOAT),
    life: Life::Frame,
    origin: Origin::Drawn,
};
