//! Nested iso-surfaces as polygons [Heidrich95 §2], what they are made from, and what they are drawn with.

use ash::vk;

use crate::part::resource::{Facts, Life, Origin, Resource, ResourceInfo, ResourceKind};
use crate::scene::shells::{CASES, Faces, Lattice, Shell, ShellDepth};
use crate::scene::{Field, Scene};
use crate::shared;

/// The shells of a scene.
fn shells<'a>(facts: &Facts<'a>) -> &'a [Shell] {
    facts.scene.shells.as_ref().map_or(&[], |shells| &shells.list)
}

/// The polygons of a shell, whose number from the dimmest on is the index.
pub const SHELL_POLYGONS: Resource = Resource::new(&SHELL_POLYGONS_INFO);
static SHELL_POLYGONS_INFO: ResourceInfo = ResourceInfo {
    name: "shell_polygons",
    holds: "vertices in volume space, then of each triangle the numbers of its three",
    kind: ResourceKind::Polygons(|facts, number| {
        let (shells, field) = (&facts.scene.shells, &facts.scene.field);
        shells.as_ref().map_or(0, |shells| polygon_bytes(shells.count_of(number.into(), field)))
    }),
    life: Life::Shell,
    origin: Origin::Built,
};

/// Bytes of so many vertices and triangles.
fn polygon_bytes([vertices, triangles]: [u32; 2]) -> u64 {
    size_of::<[f32; 3]>() as u64 * u64::from(vertices) + size_of::<[u32; 3]>() as u64 * u64::from(triangles)
}

/// Bytes of the polygons of each of a scene's shells that is drawn.
pub fn shell_bytes(scene: &Scene) -> Vec<u64> {
    let drawn = scene.shells.iter().flat_map(|shells| shells.drawn());
    drawn.map(|shell| polygon_bytes(shell.count(&scene.field))).collect()
}

/// Bytes of the largest buffer that building a scene's shells on a device takes.
pub fn largest_shell_buffer(scene: &Scene) -> u64 {
    let polygons = shell_bytes(scene).into_iter().max().unwrap_or(0);
    polygons.max(edge_bytes(&scene.field)).max(sum_bytes(&scene.field))
}

/// Words of 32 nodes of the lattice that shells lie in.
pub fn lattice_words(field: &Field) -> usize {
    let [x, y, z] = Lattice::new(field, Faces::Closed).nodes();
    x.div_ceil(u32::BITS as usize) * y * z
}

/// Entries that one invocation sums up.
pub const SUMMED: usize = 64;

/// The numbers of entries of `shell_sums` over each other: those of each word, and sums of 64 until there are no more than that.
pub fn sum_counts(field: &Field) -> Vec<usize> {
    let mut counts = vec![lattice_words(field)];
    while let Some(count) = counts.last().filter(|count| **count > SUMMED) {
        counts.push(count.div_ceil(SUMMED));
    }
    counts
}

/// Which nodes of the lattice are not below the level.
pub const SHELL_SIDES: Resource = Resource::new(&SHELL_SIDES_INFO);
static SHELL_SIDES_INFO: ResourceInfo = ResourceInfo::passing(
    "shell_sides",
    "a bit a node of the lattice: whether its value is not below the level",
    |facts, _| (size_of::<u32>() * lattice_words(&facts.scene.field)) as u64,
);

fn edge_bytes(field: &Field) -> u64 {
    (size_of::<[u32; 3]>() * lattice_words(field)) as u64
}

/// Which edges of the lattice have a vertex.
pub const SHELL_EDGES: Resource = Resource::new(&SHELL_EDGES_INFO);
static SHELL_EDGES_INFO: ResourceInfo = ResourceInfo::passing(
    "shell_edges",
    "a bit a node for each axis: whether the edge that goes up there has a vertex",
    |facts, _| edge_bytes(&facts.scene.field),
);

fn sum_bytes(field: &Field) -> u64 {
    (size_of::<[u32; 2]>() * (sum_counts(field).into_iter().sum::<usize>() + 1)) as u64
}

/// How many vertices and triangles come before.
pub const SHELL_SUMS: Resource = Resource::new(&SHELL_SUMS_INFO);
static SHELL_SUMS_INFO: ResourceInfo = ResourceInfo::passing(
    "shell_sums",
    "vertices and triangles before a word of nodes among 64 words, those before 64 words among 64 times as many, and so on; in the end all",
    |facts, _| sum_bytes(&facts.scene.field),
);

/// The triangles of each case.
pub const SHELL_CASES: Resource = Resource::new(&SHELL_CASES_INFO);
static SHELL_CASES_INFO: ResourceInfo = ResourceInfo {
    name: "shell_cases",
    holds: "of each case of a cell four bits for each edge of its triangles, and in the last four their number",
    kind: ResourceKind::Storage(|_, _| size_of::<[u64; 256]>() as u64),
    life: Life::Volume,
    origin: Origin::Host(|_| {
        let packed: Vec<u64> = CASES.iter().map(|case| packed(case)).collect();
        bytemuck::cast_slice(&packed).to_vec().into()
    }),
};

/// Bits that an edge of a cell takes.
const EDGE_BITS: usize = 4;

fn packed(triangles: &[[u8; 3]]) -> u64 {
    let edges = triangles.iter().flatten().enumerate();
    let bits = edges.fold(0, |bits, (i, edge)| bits | u64::from(*edge) << (EDGE_BITS * i));
    bits | (triangles.len() as u64) << (u64::BITS as usize - EDGE_BITS)
}

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
