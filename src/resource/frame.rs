//! What belongs to one frame: its box, its view, and what it draws into.

use std::borrow::Cow;
use std::sync::Arc;

use ash::vk;

use crate::part::resource::{Life, Origin, Resource, ResourceInfo, ResourceKind};
use crate::scene::settings::{Accumulate, DepthFormat, Formats};
use crate::scene::slice_polygons::CutPlanes;
use crate::scene::slices::Slices;
use crate::shared;
use crate::vulkan::texel_bytes;

/// The box's triangles, the front ones first.
pub const BOX: Resource = Resource::new(&BOX_INFO);
static BOX_INFO: ResourceInfo = ResourceInfo {
    name: "box",
    holds: "corners of triangles in clip space, pixels of the view; the front ones, then the back ones",
    kind: ResourceKind::Vertices(|facts, _| {
        (size_of::<[f32; 3]>() * (facts.view.front.len() + facts.view.back.len())) as u64
    }),
    life: Life::Frame,
    origin: Origin::Host(|facts| {
        let corners: Vec<[f32; 3]> = [facts.view.front.as_slice(), &facts.view.back].concat();
        bytemuck::cast_slice(&corners).to_vec().into()
    }),
};

/// The view and the sampling.
pub const FRAME: Resource = Resource::new(&FRAME_INFO);
static FRAME_INFO: ResourceInfo = ResourceInfo {
    name: "frame",
    holds: "rays of the view and the sampling, `Frame` of frame.glsl",
    kind: ResourceKind::Uniform(|_, _| size_of::<shared::Frame>() as u64),
    life: Life::Frame,
    origin: Origin::Host(|facts| {
        let region = facts.view.region;
        let frame = shared::Frame::new(facts.scene, &facts.view.rays, facts.passes, [region.x, region.y]);
        Cow::Owned(bytemuck::bytes_of(&frame).to_vec())
    }),
};

/// The view's rays in single floats.
pub const SINGLE_RAYS: Resource = Resource::new(&SINGLE_RAYS_INFO);
static SINGLE_RAYS_INFO: ResourceInfo = ResourceInfo {
    name: "single_rays",
    holds: "rays of the view in single floats, `SingleRays` of single_rays.glsl",
    kind: ResourceKind::Uniform(|_, _| size_of::<shared::SingleRays>() as u64),
    life: Life::Frame,
    origin: Origin::Host(|facts| {
        let rays = shared::SingleRays::new(&facts.view.single_rays(facts.scene));
        Cow::Owned(bytemuck::bytes_of(&rays).to_vec())
    }),
};

/// Polygons of slices.
pub const SLICE_CORNERS: Resource = Resource::new(&SLICE_CORNERS_INFO);
static SLICE_CORNERS_INFO: ResourceInfo = ResourceInfo {
    name: "slice_corners",
    holds: "corners of triangles in clip space, and the number of their slice; in the order of drawing",
    kind: ResourceKind::Vertices(|facts, _| {
        (size_of::<[f32; 4]>() * facts.view.slice_polygons(facts.scene).corners.len()) as u64
    }),
    life: Life::Frame,
    origin: Origin::Host(|facts| bytemuck::cast_slice(&facts.view.slice_polygons(facts.scene).corners).into()),
};

/// Numbers of slices and of corners, of slices that the vertex shader cuts.
pub const SLICE_NUMBERS: Resource = Resource::new(&SLICE_NUMBERS_INFO);
static SLICE_NUMBERS_INFO: ResourceInfo = ResourceInfo {
    name: "slice_numbers",
    holds: "number of the slice and of its corner, of triangles in the order of drawing",
    kind: ResourceKind::Vertices(|facts, _| {
        let corners = |slices: &Arc<Slices>| size_of::<[f32; 2]>() * slices.numbers_in_all() as usize;
        facts.view.slices.as_ref().map_or(0, corners) as u64
    }),
    life: Life::Frame,
    origin: Origin::Host(|facts| {
        let slices = facts.view.slices.as_ref();
        slices.map_or_else(Cow::default, |slices| bytemuck::cast_slice(&slices.numbers()).to_vec().into())
    }),
};

/// What the vertex shader cuts slices by.
pub const SLICE_CUT: Resource = Resource::new(&SLICE_CUT_INFO);
static SLICE_CUT_INFO: ResourceInfo = ResourceInfo {
    name: "slice_cut",
    holds: "the box, planes and the way to clip space, `SliceCut` of slices_cut.vert",
    kind: ResourceKind::Uniform(|_, _| size_of::<shared::SliceCut>() as u64),
    life: Life::Frame,
    origin: Origin::Host(|facts| {
        let cut = facts.view.slices.as_ref().and_then(|slices| CutPlanes::new(facts.scene, slices));
        cut.iter().flat_map(|planes| bytemuck::bytes_of(&shared::SliceCut::new(planes)).to_vec()).collect()
    }),
};

/// Where slices lie.
pub const SLICES: Resource = Resource::new(&SLICES_INFO);
static SLICES_INFO: ResourceInfo = ResourceInfo {
    name: "slices",
    holds: "where slices lie, `Slices` of slices.glsl",
    kind: ResourceKind::Uniform(|_, _| size_of::<shared::Slices>() as u64),
    life: Life::Frame,
    origin: Origin::Host(|facts| {
        let slices = facts.view.slices.as_ref().map(|slices| shared::Slices::new(facts.scene, slices));
        slices.iter().flat_map(|slices| bytemuck::bytes_of(slices).to_vec()).collect()
    }),
};

/// Planes that rays are cut at.
pub const CLIP_PLANES: Resource = Resource::new(&CLIP_PLANES_INFO);
static CLIP_PLANES_INFO: ResourceInfo = ResourceInfo {
    name: "clip_planes",
    holds: "clip planes, heights of the eye over them and what rays rise by, `ClipPlane` of ray.glsl",
    kind: ResourceKind::Storage(|facts, _| (size_of::<shared::ClipPlane>() * facts.scene.clip_planes().len()) as u64),
    life: Life::Frame,
    origin: Origin::Host(|facts| {
        let plane = |plane| shared::ClipPlane::new(plane, &facts.view.rays);
        let planes: Vec<_> = facts.scene.clip_planes().iter().map(plane).collect();
        bytemuck::cast_slice(&planes).to_vec().into()
    }),
};

/// An image that frames draw into.
const fn target(name: &'static str, holds: &'static str, format: fn(Formats) -> vk::Format) -> ResourceInfo {
    ResourceInfo { name, holds, kind: ResourceKind::Target(format), life: Life::Frame, origin: Origin::Drawn }
}

/// ENTRY [KW03 §2.1].
pub const ENTRY: Resource = Resource::new(&ENTRY_INFO);
static ENTRY_INFO: ResourceInfo =
    target("entry", "where the ray enters, texture coordinates", |_| vk::Format::R32G32B32A32_SFLOAT);

/// DIR [KW03 §2.1].
pub const DIRECTION: Resource = Resource::new(&DIRECTION_INFO);
static DIRECTION_INFO: ResourceInfo =
    target("direction", "unit direction and length of the ray, volume space", |_| vk::Format::R32G32B32A32_SFLOAT);

/// RES [KW03 §2.1].
pub const ACCUMULATED: Resource = Resource::new(&ACCUMULATED_INFO);
static ACCUMULATED_INFO: ResourceInfo =
    target("accumulated", "what the ray has gathered, premultiplied linear RGBA", |formats| match formats.accumulate {
        Accumulate::Rgba32f => vk::Format::R32G32B32A32_SFLOAT,
        Accumulate::Rgba16f => vk::Format::R16G16B16A16_SFLOAT,
        Accumulate::Rgba8 => vk::Format::R8G8B8A8_UNORM,
    });

/// The depth buffer.
pub const STORED: Resource = Resource::new(&STORED_INFO);
static STORED_INFO: ResourceInfo =
    target("stored", "the mark of the ray, a depth from 0 to 1", |formats| match formats.depth {
        DepthFormat::D32 => vk::Format::D32_SFLOAT,
        DepthFormat::D24 => vk::Format::X8_D24_UNORM_PACK32,
        DepthFormat::D16 => vk::Format::D16_UNORM,
    });

/// Decisions of an intermediate pass on their way to the depth buffer, in the same bytes.
pub const MARKS: Resource = Resource::new(&MARKS_INFO);
static MARKS_INFO: ResourceInfo = target("marks", "the bytes of a mark to come", |formats| marks(formats.depth));

fn marks(depth: DepthFormat) -> vk::Format {
    match depth {
        DepthFormat::D32 | DepthFormat::D24 => vk::Format::R32_SFLOAT,
        DepthFormat::D16 => vk::Format::R8G8_UNORM,
    }
}

/// Between a colour and a depth image a copy needs a buffer.
pub const MARKS_BUFFER: Resource = Resource::new(&MARKS_BUFFER_INFO);
static MARKS_BUFFER_INFO: ResourceInfo = ResourceInfo {
    name: "marks_buffer",
    holds: "marks between the two images",
    kind: ResourceKind::Staging(|facts, _| {
        let texel = texel_bytes(marks(facts.scene.settings.formats().depth)).unwrap_or(0);
        facts.view.region.pixels() * texel
    }),
    life: Life::Frame,
    origin: Origin::Drawn,
};
