//! What iso-surfaces reflect [Thesis §4.3].

use std::borrow::Cow;

use ash::vk;

use crate::part::resource::{Facts, Life, Origin, Resource, ResourceInfo, ResourceKind, Texture};
use crate::shared;
use crate::vulkan::ImageShape;

/// The picture of what is around the volume.
pub const ENVIRONMENT: Resource = Resource::new(&ENVIRONMENT_INFO);
static ENVIRONMENT_INFO: ResourceInfo = ResourceInfo {
    name: "environment",
    holds: "linear red, green and blue seen in a direction of volume space, as environment.glsl lays them out",
    kind: ResourceKind::Texture(Texture {
        format: |_| vk::Format::R32G32B32A32_SFLOAT,
        extent: |facts| {
            let [width, height] = facts.scene.environment.as_ref().map_or([1; 2], |one| one.picture.size);
            [width, height, 1]
        },
        shape: ImageShape::Flat,
        filtered: false,
        shared: |_| true,
    }),
    life: Life::Transfer,
    origin: Origin::Host(texels),
};

fn texels(facts: &Facts) -> Cow<'static, [u8]> {
    let texels = facts.scene.environment.iter().flat_map(|one| &one.picture.texels);
    let rows: Vec<[f32; 4]> = texels.map(|&[r, g, b]| [r, g, b, 1.0]).collect();
    bytemuck::cast_slice(&rows).to_vec().into()
}

/// How the environment lies about the volume, and how much of it shows.
pub const ENVIRONMENT_PLACE: Resource = Resource::new(&ENVIRONMENT_PLACE_INFO);
static ENVIRONMENT_PLACE_INFO: ResourceInfo = ResourceInfo {
    name: "environment_place",
    holds: "rows that lead from the volume's axes to volume space, and the part that is reflected, as environment.glsl has them",
    kind: ResourceKind::Storage(|facts, _| rows(facts).len() as u64),
    life: Life::Frame,
    origin: Origin::Host(rows),
};

fn rows(facts: &Facts) -> Cow<'static, [u8]> {
    let rows: Vec<[f32; 4]> =
        facts.scene.environment.iter().flat_map(|environment| shared::environment_rows(environment)).collect();
    bytemuck::cast_slice(&rows).to_vec().into()
}
