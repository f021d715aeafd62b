//! Nested iso-surfaces as polygons [Heidrich95 §2], and what they are drawn with.

use ash::vk;

use crate::part::resource::{Facts, Life, Origin, Resource, ResourceInfo, ResourceKind};
use crate::scene::shells::{Shell, ShellDepth, Shells};
use crate::shared;

/// The shells of a scene.
fn shells<'a>(facts: &Facts<'a>) -> &'a [Shell] {
    facts.scene.shells.as_ref().map_or(&[], |shells| &shells.list)
}

/// Corners of all shells.
pub const SHELL_CORNERS: Resource = Resource::new(&SHELL_CORNERS_INFO);
static SHELL_CORNERS_INFO: ResourceInfo = ResourceInfo::of_frame(
    "shell_corners",
    "corners of triangles in volume space, shell by shell, the dimmest first",
    ResourceKind::Vertices(|facts, _| {
        let before = |shells: &Shells| shells.triangles_before(&facts.scene.field).pop().unwrap_or(0);
        facts.scene.shells.as_deref().map_or(0, before) * size_of::<[[f32; 3]; 3]>() as u64
    }),
    |facts| {
        let meshes = shells(facts).iter().map(|shell| shell.polygons(&facts.scene.field));
        let corners =
            meshes.flat_map(|mesh| mesh.triangles.iter().flatten().map(|corner| mesh.corners[*corner as usize]));
        bytemuck::cast_slice(&corners.collect::<Vec<[f32; 3]>>()).to_vec().into()
    },
);

/// Emissions of shells.
pub const SHELL_LEVELS: Resource = Resource::new(&SHELL_LEVELS_INFO);
static SHELL_LEVELS_INFO: ResourceInfo = ResourceInfo::of_frame(
    "shell_levels",
    "what each shell emits, and by how much the emission within it exceeds that around it, `ShellLevel` of shells.frag",
    ResourceKind::Storage(|facts, _| (size_of::<shared::ShellLevel>() * shells(facts).len()) as u64),
    |facts| {
        let levels: Vec<_> = shells(facts).iter().map(shared::ShellLevel::new).collect();
        bytemuck::cast_slice(&levels).to_vec().into()
    },
);

/// From volume space to the picture, with the depth of shells.
pub const SHELL_PLACEMENT: Resource = Resource::new(&SHELL_PLACEMENT_INFO);
static SHELL_PLACEMENT_INFO: ResourceInfo = ResourceInfo::of_frame(
    "shell_placement",
    "where a point of volume space lies in the picture and between the far and the near end of the view, `ShellPlacement` of shells.vert",
    ResourceKind::Uniform(|_, _| size_of::<shared::Placement>() as u64),
    |facts| {
        let view = facts.view;
        let depth = ShellDepth::of(facts.scene, &view.rays);
        let placed = depth.map(|depth| shared::Placement::of_shells(&view.rays, view.size, &depth));
        placed.iter().flat_map(|placement| bytemuck::bytes_of(placement).to_vec()).collect()
    },
);

/// The depth cue.
pub const SHELL_CUE: Resource = Resource::new(&SHELL_CUE_INFO);
static SHELL_CUE_INFO: ResourceInfo = ResourceInfo::of_frame(
    "shell_cue",
    "the depth cue and the way from depths to the eye, `ShellCue` of shells.frag",
    ResourceKind::Uniform(|_, _| size_of::<shared::ShellCue>() as u64),
    |facts| {
        let depth = ShellDepth::of(facts.scene, &facts.view.rays);
        let cue = depth.map(|depth| shared::ShellCue::new(facts.scene, &depth, &facts.view.rays));
        cue.iter().flat_map(|cue| bytemuck::bytes_of(cue).to_vec()).collect()
    },
);

/// The depth buffer of shells.
pub const SHELL_DEPTH: Resource = Resource::new(&SHELL_DEPTH_INFO);
static SHELL_DEPTH_INFO: ResourceInfo = ResourceInfo {
    name: "shell_depth",
    holds: "z* of the brightest shell so far, or of the surface that hides what is behind it [Heidrich95 equation 5]; in sums depth, \
            from 0 at the far end to 1 at the near end",
    kind: ResourceKind::Target(|_| vk::Format::D32_SFLOAT),
    life: Life::Frame,
    origin: Origin::Drawn,
};
