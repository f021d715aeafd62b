//! The texture of gradients, with values beside them [Stegmaier05 §4].

use ash::vk;

use crate::part::resource::{Bytes, Facts, Life, Origin, Resource, ResourceInfo, ResourceKind, Texture};
use crate::scene::Scene;
use crate::scene::settings::{GradientTexture, ShadingSettings};
use crate::vulkan::ImageShape;

/// Gradients at voxel centres. The index tells operator and format apart.
pub const GRADIENTS: Resource = Resource::new(&GRADIENTS_INFO);
static GRADIENTS_INFO: ResourceInfo = ResourceInfo {
    name: "gradients",
    holds: "along the gradient at a voxel's centre in parts of the steepest (volume space), and in alpha the value, as gradient.glsl has them",
    kind: ResourceKind::Texture(Texture {
        format: |facts| match facts.scene.settings.shading.format {
            GradientTexture::Rgba8 => vk::Format::R8G8B8A8_UNORM,
            GradientTexture::Rgba16f => vk::Format::R16G16B16A16_SFLOAT,
            GradientTexture::Rgba32f => vk::Format::R32G32B32A32_SFLOAT,
        },
        extent: |facts| facts.scene.field.dims(),
        shape: ImageShape::Volume,
        filtered: true,
        shared: |_| true,
    }),
    life: Life::Volume,
    origin: Origin::Built,
};

/// That of gradients as a scene's settings have them.
pub fn gradients(scene: &Scene) -> Resource {
    let ShadingSettings { gradient, format: texture, .. } = scene.settings.shading;
    let formats = GradientTexture::Rgba32f as u16 + 1;
    GRADIENTS.at(gradient as u16 * formats + texture as u16)
}

const TEXEL_BYTES: Bytes = |facts: &Facts, _| gradient_bytes(facts.scene);

/// Gradients on their way to the texture.
pub const GRADIENT_TEXELS: Resource = Resource::new(&GRADIENT_TEXELS_INFO);
static GRADIENT_TEXELS_INFO: ResourceInfo =
    ResourceInfo::passing("gradient_texels", "texels of `gradients`, x fastest", TEXEL_BYTES);

/// Bytes of the gradients of a scene's volume.
pub fn gradient_bytes(scene: &Scene) -> u64 {
    (scene.field.values.len() * scene.settings.shading.format.bytes()) as u64
}
