//! What rays that bend read, and what is behind the volume [Stegmaier05 §4, §6].

use ash::vk;

use crate::part::resource::{Facts, Life, Origin, Resource, ResourceInfo, ResourceKind, Texture};
use crate::scene::backdrop::Pattern;
use crate::scene::environment::Picture;
use crate::scene::texture::{TextureChoice, TextureMap};
use crate::shared;
use crate::vulkan::ImageShape;

/// Indices of refraction.
pub const REFRACTIVE_INDEX: Resource = Resource::new(&REFRACTIVE_INDEX_INFO);
static REFRACTIVE_INDEX_INFO: ResourceInfo = ResourceInfo {
    name: "refractive_index",
    holds: "pieces of the index of refraction over the texture's values, as refraction.glsl has them",
    kind: ResourceKind::Storage(|facts, _| size_of_val(pieces(facts).as_slice()) as u64),
    life: Life::Transfer,
    origin: Origin::Host(|facts| bytemuck::cast_slice(&pieces(facts)).to_vec().into()),
};

fn pieces(facts: &Facts) -> Vec<[f32; 4]> {
    let scene = facts.scene;
    shared::index_pieces(scene, TextureMap::of(&scene.field, TextureChoice::of(scene).kept))
}

/// The picture behind the volume.
pub const BACKDROP: Resource = Resource::new(&BACKDROP_INFO);
static BACKDROP_INFO: ResourceInfo = ResourceInfo {
    name: "backdrop",
    holds: "linear red, green and blue of the picture behind the volume",
    kind: ResourceKind::Texture(Texture {
        format: |_| vk::Format::R32G32B32A32_SFLOAT,
        extent: |facts| {
            let [width, height] = picture(facts).map_or([1; 2], |picture| picture.size);
            [width, height, 1]
        },
        shape: ImageShape::Flat,
        filtered: false,
        shared: |_| true,
    }),
    life: Life::Transfer,
    origin: Origin::Host(|facts| {
        let texels = picture(facts).into_iter().flat_map(|picture| &picture.texels);
        let rows: Vec<[f32; 4]> = texels.map(|&[r, g, b]| [r, g, b, 1.0]).collect();
        bytemuck::cast_slice(&rows).to_vec().into()
    }),
};

fn picture<'a>(facts: &Facts<'a>) -> Option<&'a Picture> {
    match &facts.scene.backdrop.as_ref()?.pattern {
        Pattern::Picture(picture) => Some(picture),
        Pattern::Checker(_) => None,
    }
}
