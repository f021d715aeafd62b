//! Meshes of tetrahedra, and what rays hold on their way through them [Weiler03 "Mesh Data", "Traversal Data"].
//!
//! Mesh data are in buffers of texels, which take less time than storage buffers and images do (`benches/results/lavapipe-22.3/tetrahedra.md`).

use ash::vk;

use crate::part::resource::{Facts, Life, Origin, Resource, ResourceInfo, ResourceKind, Texture};
use crate::scene::Tetrahedra;
use crate::scene::tetrahedra::{FACES, NOTHING};
use crate::shared;
use crate::truth::cell_table::CellTable;
use crate::vulkan::ImageShape;

/// The mesh of the scene, of which something is asked.
fn of<T: Default>(facts: &Facts, ask: impl FnOnce(&Tetrahedra) -> T) -> T {
    facts.scene.tetrahedra.as_deref().map_or_else(T::default, ask)
}

/// What stays as long as the mesh.
const fn of_mesh(
    name: &'static str,
    holds: &'static str,
    kind: ResourceKind,
    bytes: for<'a> fn(&Facts<'a>) -> std::borrow::Cow<'a, [u8]>,
) -> ResourceInfo {
    ResourceInfo { name, holds, kind, life: Life::Volume, origin: Origin::Host(bytes) }
}

/// Vertices.
pub const TET_POINTS: Resource = Resource::new(&TET_POINTS_INFO);
static TET_POINTS_INFO: ResourceInfo = of_mesh(
    "tet_points",
    "vertices of the mesh in volume space, and their x",
    ResourceKind::Texels(vk::Format::R32G32B32A32_SFLOAT, |facts, _| {
        (size_of::<[f32; 4]>() * of(facts, |mesh| mesh.points.len())) as u64
    }),
    |facts| {
        let rows = of(facts, |mesh| {
            let row = |([x, y, z], value): (&[f32; 3], &f32)| [*x, *y, *z, *value];
            mesh.points.iter().zip(&mesh.values).map(row).collect::<Vec<_>>()
        });
        bytemuck::cast_slice(&rows).to_vec().into()
    },
);

/// Vertices as a view has them.
pub const TET_PLACES: Resource = Resource::new(&TET_PLACES_INFO);
static TET_PLACES_INFO: ResourceInfo = ResourceInfo::of_frame(
    "tet_places",
    "vertices of the mesh in columns, rows and depth, and their x, rows of seen.glsl",
    ResourceKind::Texels(vk::Format::R32G32B32A32_SFLOAT, |facts, _| {
        (size_of::<[f32; 4]>() * of(facts, |mesh| mesh.points.len())) as u64
    }),
    |facts| {
        let places = of(facts, |mesh| shared::tet_places(mesh, facts.view));
        bytemuck::cast_slice(&places).to_vec().into()
    },
);

/// Corners of cells.
pub const TET_CELLS: Resource = Resource::new(&TET_CELLS_INFO);
static TET_CELLS_INFO: ResourceInfo = of_mesh(
    "tet_cells",
    "numbers of the four vertices of each cell, rising",
    ResourceKind::Texels(vk::Format::R32G32B32A32_UINT, |facts, _| {
        (size_of::<[u32; 4]>() * of(facts, |mesh| mesh.cells.len())) as u64
    }),
    |facts| {
        let rising = |cell: &[u32; 4]| {
            let mut corners = *cell;
            corners.sort_unstable();
            corners
        };
        let rows = of(facts, |mesh| mesh.cells.iter().map(rising).collect::<Vec<_>>());
        bytemuck::cast_slice(&rows).to_vec().into()
    },
);

/// Neighbours of cells.
pub const TET_ACROSS: Resource = Resource::new(&TET_ACROSS_INFO);
static TET_ACROSS_INFO: ResourceInfo = of_mesh(
    "tet_across",
    "one more than the side across the face opposite to each vertex of a cell, as its cell times 4 and the place of the vertex opposite to it \
     there, and that vertex; 0 on the boundary",
    ResourceKind::Texels(vk::Format::R32G32_UINT, |facts, _| {
        (size_of::<[[u32; 2]; 4]>() * of(facts, |mesh| mesh.across.len())) as u64
    }),
    |facts| {
        let rows = of(facts, |mesh| (0..mesh.cells.len()).map(|cell| across(mesh, cell)).collect::<Vec<_>>());
        bytemuck::cast_slice(&rows).to_vec().into()
    },
);

/// A side of a cell by the place of its corner among those of the cell by rising numbers.
fn by_place(mesh: &Tetrahedra, side: u32) -> u32 {
    let corner = opposite(mesh, side);
    side / 4 * 4 + mesh.cells[side as usize / 4].iter().filter(|other| **other < corner).count() as u32
}

/// The vertex opposite to a side of a cell.
fn opposite(mesh: &Tetrahedra, side: u32) -> u32 {
    mesh.cells[side as usize / 4][side as usize % 4]
}

/// One more than the sides across those of a cell, by places, and the vertices opposite to them; 0 on the boundary.
fn across(mesh: &Tetrahedra, cell: usize) -> [[u32; 2]; 4] {
    let mut sides = [[0; 2]; 4];
    for (corner, other) in mesh.across[cell].iter().enumerate().filter(|(_, other)| **other != NOTHING) {
        let place = by_place(mesh, (4 * cell + corner) as u32) as usize % 4;
        sides[place] = [by_place(mesh, *other) + 1, opposite(mesh, *other)];
    }
    sides
}

/// Faces of the boundary.
pub const TET_BOUNDARY: Resource = Resource::new(&TET_BOUNDARY_INFO);
static TET_BOUNDARY_INFO: ResourceInfo = of_mesh(
    "tet_boundary",
    "of each face of the boundary one more than its side, its vertices and the numbers of the three faces beside it, rows of boundary.glsl",
    ResourceKind::Texels(vk::Format::R32G32B32A32_UINT, |facts, _| {
        (size_of::<[[u32; 4]; 2]>() * of(facts, |mesh| mesh.boundary.len())) as u64
    }),
    |facts| {
        let rows = of(facts, |mesh| {
            let row = |(side, [a, b, c]): (&u32, &[u32; 3])| {
                let [u, v, w] = FACES[*side as usize % 4].map(|corner| mesh.cells[*side as usize / 4][corner]);
                [[by_place(mesh, *side) + 1, u, v, w], [*a, *b, *c, opposite(mesh, *side)]]
            };
            mesh.boundary.iter().zip(&mesh.beside).map(row).collect::<Vec<_>>()
        });
        bytemuck::cast_slice(&rows).to_vec().into()
    },
);

/// Corners of the faces of the boundary.
pub const TET_CORNERS: Resource = Resource::new(&TET_CORNERS_INFO);
static TET_CORNERS_INFO: ResourceInfo = of_mesh(
    "tet_corners",
    "corners of the faces of the boundary, volume space",
    ResourceKind::Vertices(|facts, _| (size_of::<[[f32; 3]; 3]>() * of(facts, |mesh| mesh.boundary.len())) as u64),
    |facts| {
        let corners = of(facts, |mesh| {
            let face = |side: &u32| FACES[*side as usize % 4].map(|i| mesh.cells[*side as usize / 4][i]);
            let point = |vertex: u32| mesh.points[vertex as usize];
            mesh.boundary.iter().map(|side| face(side).map(point)).collect::<Vec<_>>()
        });
        bytemuck::cast_slice(&corners).to_vec().into()
    },
);

/// The mesh as a view has it.
pub const TET_VIEW: Resource = Resource::new(&TET_VIEW_INFO);
static TET_VIEW_INFO: ResourceInfo = ResourceInfo::of_frame(
    "tet_view",
    "rays by columns and rows, and the units of the table of ways, `TetView` of seen.glsl",
    ResourceKind::Uniform(|_, _| size_of::<shared::TetView>() as u64),
    |facts| bytemuck::bytes_of(&shared::TetView::new(facts.scene, facts.view)).to_vec().into(),
);

/// Where rays begin within the mesh.
pub const TET_BEGIN: Resource = Resource::new(&TET_BEGIN_INFO);
static TET_BEGIN_INFO: ResourceInfo = ResourceInfo::of_frame(
    "tet_begin",
    "one more than the number of the face of the boundary by which the ray comes to where it begins; 0 where that is not in the mesh",
    ResourceKind::Texture(Texture {
        format: |_| vk::Format::R32_UINT,
        extent: |facts| {
            let [width, height] = facts.view.region.size();
            [width as usize, height as usize, 1]
        },
        shape: ImageShape::Flat,
        filtered: false,
        shared: |_| false,
    }),
    |facts| match facts.view.cells.as_ref().and_then(|view| view.begins.as_ref()) {
        Some(faces) => bytemuck::cast_slice(faces).into(),
        None => Default::default(),
    },
);

/// Ways through cells.
pub const TET_TABLE: Resource = Resource::new(&TET_TABLE_INFO);
static TET_TABLE_INFO: ResourceInfo = ResourceInfo {
    name: "tet_table",
    holds: "premultiplied colour and opacity of a way, by the values at its ends and its length",
    kind: ResourceKind::Texture(Texture {
        format: |_| vk::Format::R32G32B32A32_SFLOAT,
        extent: |facts| [facts.scene.settings.sampling.table as usize; 3],
        shape: ImageShape::Volume,
        filtered: false,
        shared: |_| true,
    }),
    life: Life::Transfer,
    origin: Origin::Host(|facts| {
        CellTable::of(facts.scene)
            .map_or_else(Default::default, |table| bytemuck::cast_slice(&table.texels).to_vec().into())
    }),
};

/// Two numbers that a ray holds from a cell to the next.
const fn target(name: &'static str, holds: &'static str) -> ResourceInfo {
    let kind = ResourceKind::Target(|_| vk::Format::R32G32_SFLOAT);
    ResourceInfo { name, holds, kind, life: Life::Frame, origin: Origin::Drawn }
}

/// Faces by which rays enter the mesh, a layer for each time.
pub const TET_ENTRY: Resource = Resource::new(&TET_ENTRY_INFO);
static TET_ENTRY_INFO: ResourceInfo = ResourceInfo {
    name: "tet_entry",
    holds: "how near the face is (0: none), one more than its number, its depth from the middle of the mesh, and x there",
    kind: ResourceKind::Target(|_| vk::Format::R32G32B32A32_SFLOAT),
    life: Life::Frame,
    origin: Origin::Drawn,
};

/// Current cells, in two sets [Weiler03 "Traversal Data"].
pub const TET_CELL: Resource = Resource::new(&TET_CELL_INFO);
static TET_CELL_INFO: ResourceInfo = target(
    "tet_cell",
    "one more than the number of the current cell (0: none), and the place of the corner opposite to the side by which the ray enters",
);

/// Intersection points, in two sets [Weiler03 "Traversal Data"].
pub const TET_POINT: Resource = Resource::new(&TET_POINT_INFO);
static TET_POINT_INFO: ResourceInfo = target(
    "tet_point",
    "depth of the point at which the ray enters the current cell, from the middle of the mesh, and x there",
);
