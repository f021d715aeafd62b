//! What tells where a volume holds nothing to see, and what it is built from.

use std::borrow::Cow;

use ash::vk;

use super::texels::Texels;
use crate::part::resource::{Bytes, Facts, Life, Origin, Resource, ResourceInfo, ResourceKind, Texture};
use crate::scene::Field;
use crate::scene::settings::Distance;
use crate::shared;
use crate::structure::Lookup;
use crate::structure::blocks::{BLOCK, CODES, visibility_table};
use crate::structure::bundle::Bundles;
use crate::structure::cells::Support;
use crate::structure::grid::{Grid, OCTANTS};
use crate::vulkan::ImageShape;

/// Minimum and maximum of every cell of a grid, whose side is the index.
pub const CELL_RANGE: Resource = Resource::new(&CELL_RANGE_INFO);
static CELL_RANGE_INFO: ResourceInfo = ResourceInfo {
    name: "cell_range",
    holds: "minimum and maximum of a cell's values, as the texture keeps them",
    kind: ResourceKind::Storage(|facts, side| {
        (size_of::<[f32; 2]>() * Grid::new(&facts.scene.field, side.into()).count()) as u64
    }),
    life: Life::Volume,
    origin: Origin::Built,
};

/// The ranges of the blocks of [KW03 §2.3].
pub const fn block_ranges() -> Resource {
    CELL_RANGE.at(BLOCK as u16)
}

/// CT [KW03 §2.3].
pub const BLOCK_TABLE: Resource = Resource::new(&BLOCK_TABLE_INFO);
static BLOCK_TABLE_INFO: ResourceInfo = ResourceInfo {
    name: "block_table",
    holds: "1 where anything shows between two values, by their codes",
    kind: ResourceKind::Texture(Texture {
        format: |_| vk::Format::R8_UINT,
        extent: |_| [CODES, CODES, 1],
        shape: ImageShape::Flat,
        filtered: false,
        shared: |_| true,
    }),
    life: Life::Transfer,
    origin: Origin::Host(|facts| visibility_table(&Texels::of(facts.scene).shown(facts.scene)).into()),
};

/// Where the transfer function shows anything.
pub const SUPPORT: Resource = Resource::new(&SUPPORT_INFO);
static SUPPORT_INFO: ResourceInfo = ResourceInfo {
    name: "support",
    holds: "closed intervals of the texture's values in which anything shows",
    kind: ResourceKind::Storage(|facts, _| support(facts).len() as u64),
    life: Life::Transfer,
    origin: Origin::Host(support),
};

fn support(facts: &Facts) -> Cow<'static, [u8]> {
    let support = Support::of(&Texels::of(facts.scene).shown(facts.scene));
    bytemuck::cast_slice(&support.closed()).to_vec().into()
}

/// The bundles of rays that distances are made for.
pub const BUNDLE: Resource = Resource::new(&BUNDLE_INFO);
static BUNDLE_INFO: ResourceInfo = ResourceInfo {
    name: "bundle",
    holds: "where rays come from and how far their directions are off, `Bundle` of bundle.comp",
    kind: ResourceKind::Uniform(|_, _| size_of::<shared::Bundle>() as u64),
    life: Life::View,
    origin: Origin::Host(|facts| {
        let field = &facts.scene.field;
        let made_for = facts.lookup.and_then(|lookup| Some((Grid::new(field, lookup.cell), lookup.view?)));
        let bundle = made_for.map(|(grid, view)| shared::Bundle::from(&Bundles::new(&grid, field, &view)));
        bundle.map_or_else(Cow::default, |bundle| bytemuck::bytes_of(&bundle).to_vec().into())
    }),
};

/// Distances to the nearest interesting cell, as frames look them up.
pub const NEAREST_DISTANCE: Resource = Resource::new(&NEAREST_DISTANCE_INFO);
static NEAREST_DISTANCE_INFO: ResourceInfo = ResourceInfo {
    name: "nearest_distance",
    holds: "whole voxels that are free from a cell on, and one more; 0 where it is interesting",
    kind: ResourceKind::Texture(Texture {
        // A byte a cell, or all octants of a cell in one texel.
        format: |facts| if octants(facts) == 1 { vk::Format::R8_UINT } else { vk::Format::R32G32_UINT },
        extent: |facts| grid(facts).cells,
        shape: ImageShape::Volume,
        filtered: false,
        // Others are made from those of all views.
        shared: |facts| facts.lookup.is_none_or(|lookup| lookup.view.is_none()),
    }),
    life: Life::View,
    origin: Origin::Built,
};

/// The distances in any direction, where others are made from them.
pub const OMNI_DISTANCE: Resource = Resource::new(&OMNI_DISTANCE_INFO);
static OMNI_DISTANCE_INFO: ResourceInfo = ResourceInfo {
    name: "omni_distance",
    holds: "as `nearest_distance`, for rays in any direction",
    kind: ResourceKind::Texture(Texture {
        format: |_| vk::Format::R8_UINT,
        extent: |facts| grid(facts).cells,
        shape: ImageShape::Volume,
        filtered: false,
        shared: |_| true,
    }),
    life: Life::Transfer,
    origin: Origin::Built,
};

/// A buffer that builds write, kept for others.
const fn built(name: &'static str, holds: &'static str, bytes: Bytes) -> ResourceInfo {
    ResourceInfo { name, holds, kind: ResourceKind::Storage(bytes), life: Life::Transfer, origin: Origin::Built }
}

const BITS: Bytes = |facts, _| 4 * words_of_bits(&grid(facts)) as u64;

/// A bit for each cell: whether it is interesting.
pub const INTERESTING: Resource = Resource::new(&INTERESTING_INFO);
static INTERESTING_INFO: ResourceInfo = built("interesting", "a bit a cell: whether anything shows in it", BITS);

/// Any interesting cell among 2^3, from each cell on.
pub const WIDE_2: Resource = Resource::new(&WIDE_2_INFO);
static WIDE_2_INFO: ResourceInfo =
    built("wide_2", "a bit a cell: whether anything shows in the 2^3 cells from it on", BITS);

/// Any interesting cell among 4^3, from each cell on.
pub const WIDE_4: Resource = Resource::new(&WIDE_4_INFO);
static WIDE_4_INFO: ResourceInfo =
    built("wide_4", "a bit a cell: whether anything shows in the 4^3 cells from it on", BITS);

const SQUARE_BYTES: Bytes = |facts, _| (size_of::<u32>() * grid(facts).count()) as u64;

/// Squared distances on their way through the axes.
pub const SQUARES: Resource = Resource::new(&SQUARES_INFO);
static SQUARES_INFO: ResourceInfo =
    ResourceInfo::passing("squares", "squared distance to the nearest interesting cell so far", SQUARE_BYTES);

/// Squared distances after the second axis, where the first is needed again.
pub const SQUARES_AFTER: Resource = Resource::new(&SQUARES_AFTER_INFO);
static SQUARES_AFTER_INFO: ResourceInfo =
    ResourceInfo::passing("squares_after", "as `squares`, after one more axis", SQUARE_BYTES);

/// Distances on their way to the texture.
pub const DISTANCE_BYTES: Resource = Resource::new(&DISTANCE_BYTES_INFO);
static DISTANCE_BYTES_INFO: ResourceInfo =
    ResourceInfo::passing("distance_bytes", "texels of `nearest_distance`", |facts, _| match octants(facts) {
        1 => 4 * words_of_bytes(grid(facts).cells) as u64,
        octants => (octants * grid(facts).count()) as u64,
    });

/// Distances for boxes of 2^3 cells, from which those of cells go on.
pub const BOXES_2: Resource = Resource::new(&BOXES_2_INFO);
static BOXES_2_INFO: ResourceInfo =
    ResourceInfo::passing("boxes_2", "distances for boxes of 2^3 cells", |facts, _| boxes(facts, 2));

/// Distances for boxes of 4^3 cells.
pub const BOXES_4: Resource = Resource::new(&BOXES_4_INFO);
static BOXES_4_INFO: ResourceInfo =
    ResourceInfo::passing("boxes_4", "distances for boxes of 4^3 cells", |facts, _| boxes(facts, 4));

fn boxes(facts: &Facts, side: usize) -> u64 {
    4 * words_of_bytes(grid(facts).cells.map(|n| n.div_ceil(side))) as u64
}

/// The cells of the distances that are looked up.
fn grid(facts: &Facts) -> Grid {
    Grid::new(&facts.scene.field, facts.lookup.map_or(1, |lookup| lookup.cell))
}

/// Octants that the distances tell apart.
fn octants(facts: &Facts) -> usize {
    octants_of(facts.lookup.map(|lookup| lookup.distance))
}

fn octants_of(distance: Option<Distance>) -> usize {
    if distance == Some(Distance::Directional) { OCTANTS } else { 1 }
}

/// Words of rows of the grid that have a bit a cell.
pub fn words_of_bits(grid: &Grid) -> usize {
    grid.cells[0].div_ceil(32) * grid.cells[1] * grid.cells[2]
}

/// Words of rows that have a byte a cell.
pub fn words_of_bytes([x, y, z]: [usize; 3]) -> usize {
    x.div_ceil(4) * y * z
}

/// Bytes of the largest buffer that building distances takes.
pub fn largest_buffer(field: &Field, lookup: &Lookup) -> u64 {
    let cells = Grid::new(field, lookup.cell).count();
    let ranges = if lookup.reads_ranges() { size_of::<[f32; 2]>() * cells } else { 0 };
    let bytes = octants_of(Some(lookup.distance)) * cells;
    ranges.max(size_of::<u32>() * cells).max(bytes) as u64
}
