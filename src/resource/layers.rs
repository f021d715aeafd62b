//! Polygons, and the depth layers they are peeled into [Thesis ch. 6 §1.5].

use std::borrow::Cow;

use ash::vk;

use crate::math::bvh::Bounds;
use crate::part::resource::{Life, Origin, Resource, ResourceInfo, ResourceKind};
use crate::shared;

/// A triangle over the whole picture: clip coordinates.
const WHOLE: [[f32; 3]; 3] = [[-1.0, -1.0, 1.0], [3.0, -1.0, 1.0], [-1.0, 3.0, 1.0]];

/// What covers every pixel.
pub const SCREEN_CORNERS: Resource = Resource::new(&SCREEN_CORNERS_INFO);
static SCREEN_CORNERS_INFO: ResourceInfo = ResourceInfo::of_frame(
    "screen_corners",
    "corners of a triangle in clip space that covers the picture",
    ResourceKind::Vertices(|_, _| size_of_val(&WHOLE) as u64),
    |_| Cow::Borrowed(bytemuck::bytes_of(&WHOLE)),
);

/// Corners of all polygons of the scene.
pub const POLYGON_CORNERS: Resource = Resource::new(&POLYGON_CORNERS_INFO);
static POLYGON_CORNERS_INFO: ResourceInfo = ResourceInfo::of_frame(
    "polygon_corners",
    "corners of triangles in volume space; the transparent ones, then those of clip geometry, then the opaque ones",
    ResourceKind::Vertices(|facts, _| (size_of::<[[f32; 3]; 3]>() * facts.scene.polygons.triangles.len()) as u64),
    |facts| {
        let corners: Vec<[[f32; 3]; 3]> = facts.scene.polygons.triangles.iter().map(|one| one.corners).collect();
        bytemuck::cast_slice(&corners).to_vec().into()
    },
);

/// Planes of all polygons as the eye has them.
pub const TRIANGLES: Resource = Resource::new(&TRIANGLES_INFO);
static TRIANGLES_INFO: ResourceInfo = ResourceInfo::of_frame(
    "triangles",
    "unit normal of a triangle and distance of its plane from the eye, volume space, as double-floats; its material",
    ResourceKind::Storage(|facts, _| (size_of::<shared::Triangle>() * facts.scene.polygons.triangles.len()) as u64),
    |facts| {
        let (polygons, origin) = (&facts.scene.polygons, facts.view.rays.origin);
        let triangles: Vec<_> = polygons.triangles.iter().map(|one| shared::Triangle::new(one, origin)).collect();
        bytemuck::cast_slice(&triangles).to_vec().into()
    },
);

/// The looks of meshes.
pub const MATERIALS: Resource = Resource::new(&MATERIALS_INFO);
static MATERIALS_INFO: ResourceInfo = ResourceInfo::of_frame(
    "materials",
    "linear colour and opacity of the fronts and of the backs of a mesh, whether backs show, which clip mesh it is",
    ResourceKind::Storage(|facts, _| (size_of::<shared::Material>() * facts.scene.polygons.materials.len()) as u64),
    |facts| {
        let materials: Vec<_> = facts.scene.polygons.materials.iter().map(shared::Material::new).collect();
        bytemuck::cast_slice(&materials).to_vec().into()
    },
);

/// From volume space to the picture.
pub const PLACEMENT: Resource = Resource::new(&PLACEMENT_INFO);
static PLACEMENT_INFO: ResourceInfo = ResourceInfo::of_frame(
    "placement",
    "where a point of volume space lies in the picture, `Placement` of polygons.vert",
    ResourceKind::Uniform(|_, _| size_of::<shared::Placement>() as u64),
    |facts| {
        let (view, polygons) = (facts.view, &facts.scene.polygons);
        let half = 0.5 * facts.scene.field.extent();
        let mesh = facts.scene.tetrahedra.as_ref().map(|_| Bounds { least: -half, greatest: half });
        let far = polygons.bounds().or(mesh).map_or(1.0, |bounds| view.rays.deepest(bounds.least, bounds.greatest));
        Cow::Owned(bytemuck::bytes_of(&shared::Placement::new(&view.rays, view.size, far)).to_vec())
    },
);

/// An image that frames draw into.
const fn target(name: &'static str, holds: &'static str, format: vk::Format) -> ResourceInfo {
    let kind = match format {
        vk::Format::D32_SFLOAT => ResourceKind::Target(|_| vk::Format::D32_SFLOAT),
        vk::Format::R16G16B16A16_SFLOAT => ResourceKind::Target(|_| vk::Format::R16G16B16A16_SFLOAT),
        _ => ResourceKind::Target(|_| vk::Format::R32G32B32A32_SFLOAT),
    };
    ResourceInfo { name, holds, kind, life: Life::Frame, origin: Origin::Drawn }
}

/// The surfaces that rays meet, by the number of the layer; behind the layers those of opaque polygons, and behind these where
/// clip geometry lets the volume begin.
pub const LAYER: Resource = Resource::new(&LAYER_INFO);
static LAYER_INFO: ResourceInfo = target(
    "layer",
    "of the surface: near over depth (0: none), one more than the triangle's number, distance from where the ray enters, \
     volume space; whether clip geometry keeps what is behind the surface (not below 0), with how often more the ray has entered \
     each clip mesh that keeps what is inside or outside than left it",
    vk::Format::R32G32B32A32_SFLOAT,
);

/// Their colours.
pub const LAYER_COLOR: Resource = Resource::new(&LAYER_COLOR_INFO);
static LAYER_COLOR_INFO: ResourceInfo =
    target("layer_color", "lit colour of the surface, premultiplied linear RGBA", vk::Format::R32G32B32A32_SFLOAT);

/// The depth buffer in which the nearest surface of a layer is found.
pub const PEEL_DEPTH: Resource = Resource::new(&PEEL_DEPTH_INFO);
static PEEL_DEPTH_INFO: ResourceInfo =
    target("peel_depth", "near over depth of the surface, 0 where there is none", vk::Format::D32_SFLOAT);

/// By how much more often rays enter each clip mesh than they leave it. Every device blends into 16 bits, which hold whole numbers
/// to 2048.
pub const CLIP_WINDING: Resource = Resource::new(&CLIP_WINDING_INFO);
static CLIP_WINDING_INFO: ResourceInfo =
    target("clip_winding", "fronts less backs of each clip mesh that the ray meets", vk::Format::R16G16B16A16_SFLOAT);
