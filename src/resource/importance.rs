//! What adaptive sampling reads and keeps (Weiler03 "Adaptive Sampling").

use ash::vk;

use crate::part::resource::{Life, Origin, Resource, ResourceInfo, ResourceKind, Texture};
use crate::vulkan::ImageShape;

/// The importance volume.
pub const IMPORTANCE: Resource = Resource::new(&IMPORTANCE_INFO);
static IMPORTANCE_INFO: ResourceInfo = ResourceInfo {
    name: "importance",
    holds: "how often the shortest step is doubled from a cell on, and 128 where nothing shows on it",
    kind: ResourceKind::Texture(Texture {
        format: |_| vk::Format::R8_UINT,
        extent: |facts| facts.scene.field.cells(),
        shape: ImageShape::Volume,
        filtered: false,
        shared: |_| true,
    }),
    life: Life::Transfer,
    origin: Origin::Built,
};

/// Where the rays of adaptive main passes are.
pub const REACHED: Resource = Resource::new(&REACHED_INFO);
static REACHED_INFO: ResourceInfo = ResourceInfo {
    name: "reached",
    holds: "how far the ray has come, in steps of the shortest length",
    kind: ResourceKind::Target(|_| vk::Format::R32_SFLOAT),
    life: Life::Frame,
    origin: Origin::Drawn,
};
