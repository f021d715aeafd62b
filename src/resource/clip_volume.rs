//! Another volume, by whose values the scene's own one is clipped [Stegmaier05 §6].

use std::borrow::Cow;

use ash::vk;

use crate::part::resource::{Facts, Life, Origin, Resource, ResourceInfo, ResourceKind, Texture};
use crate::shared;
use crate::vulkan::ImageShape;

/// The values of the clip volume. In f32 whatever its type, so that a voxel that has the very value of the level is inside.
pub const CLIP_VOLUME: Resource = Resource::new(&CLIP_VOLUME_INFO);
static CLIP_VOLUME_INFO: ResourceInfo = ResourceInfo {
    name: "clip_volume",
    holds: "values of the clip volume at its voxel centres, 0 to 1 over its own range",
    kind: ResourceKind::Texture(Texture {
        format: |_| vk::Format::R32_SFLOAT,
        extent: |facts| facts.scene.clip_volume.as_ref().map_or([1; 3], |clip| clip.field.dims()),
        shape: ImageShape::Volume,
        filtered: false,
        shared: |_| true,
    }),
    life: Life::Volume,
    origin: Origin::Host(texels),
};

fn texels<'a>(facts: &Facts<'a>) -> Cow<'a, [u8]> {
    facts.scene.clip_volume.as_ref().map_or_else(Cow::default, |clip| bytemuck::cast_slice(&clip.field.values).into())
}

/// Where the clip volume lies, and its level.
pub const CLIP_VOLUME_PLACE: Resource = Resource::new(&CLIP_VOLUME_PLACE_INFO);
static CLIP_VOLUME_PLACE_INFO: ResourceInfo = ResourceInfo {
    name: "clip_volume_place",
    holds: "rows that lead from texture coordinates to voxels of the clip volume, and its level, as clip_volume.glsl has them",
    kind: ResourceKind::Storage(|facts, _| rows(facts).len() as u64),
    life: Life::Volume,
    origin: Origin::Host(rows),
};

fn rows(facts: &Facts) -> Cow<'static, [u8]> {
    let rows: Vec<[f32; 4]> = facts.scene.clip_volume.iter().flat_map(|clip| shared::clip_volume_rows(clip)).collect();
    bytemuck::cast_slice(&rows).to_vec().into()
}
