//! The volume and what classifies its values.

use std::borrow::Cow;

use ash::vk;

use super::texels::{Texels, texel_format};
use crate::part::resource::{Facts, Life, Origin, Resource, ResourceInfo, ResourceKind, Texture};
use crate::scene::texture::TextureChoice;
use crate::shared;
use crate::structure::cells::Values;
use crate::truth::preintegrated;

/// The scalar field.
pub const VOLUME: Resource = Resource::new(&VOLUME_INFO);
static VOLUME_INFO: ResourceInfo = ResourceInfo {
    name: "volume",
    holds: "scalar values at voxel centres, as the texture keeps them",
    kind: ResourceKind::Texture(Texture {
        format: |facts| texel_format(TextureChoice::of(facts.scene).format),
        extent: |facts| facts.scene.field.dims(),
        flat: false,
        filtered: true,
        shared: |_| true,
    }),
    life: Life::Volume,
    origin: Origin::Host(|facts| bytes_of(Texels::of(facts.scene).values)),
};

/// The texels' own bytes, which are those of the file where these do.
fn bytes_of(values: Values) -> Cow<[u8]> {
    fn bytes<'a, T: bytemuck::Pod>(codes: Cow<'a, [T]>) -> Cow<'a, [u8]> {
        match codes {
            Cow::Borrowed(codes) => bytemuck::cast_slice(codes).into(),
            Cow::Owned(codes) => bytemuck::cast_slice(&codes).to_vec().into(),
        }
    }
    match values {
        Values::Unorm8(codes) => codes,
        Values::Unorm16(codes) => bytes(codes),
        Values::Float(values) => bytes(values),
    }
}

/// Cells that stay transparent.
pub const HOLES: Resource = Resource::new(&HOLES_INFO);
static HOLES_INFO: ResourceInfo = ResourceInfo {
    name: "holes",
    holds: "1 for a cell that stays transparent",
    kind: ResourceKind::Texture(Texture {
        format: |_| vk::Format::R8_UINT,
        extent: |facts| facts.scene.field.cells(),
        flat: false,
        filtered: false,
        shared: |_| true,
    }),
    life: Life::Volume,
    origin: Origin::Host(|facts| facts.scene.field.holes.iter().flatten().map(|&hole| u8::from(hole)).collect()),
};

/// Bytes of a row of the pieces' buffer.
const ROW: usize = size_of::<[f32; 4]>();

/// Pieces of the transfer function, over the texture's values.
pub const TRANSFER: Resource = Resource::new(&TRANSFER_INFO);
static TRANSFER_INFO: ResourceInfo = ResourceInfo {
    name: "transfer",
    holds: "three rows a piece: its place, its colour and opacity, their change",
    kind: ResourceKind::Storage(|facts, _| (3 * ROW * facts.scene.transfer.knots().len()) as u64),
    life: Life::Transfer,
    origin: Origin::Host(|facts| rows(facts, false)),
};

/// Pieces of a transfer function without colours.
pub const GREY_TRANSFER: Resource = Resource::new(&GREY_TRANSFER_INFO);
static GREY_TRANSFER_INFO: ResourceInfo = ResourceInfo {
    name: "transfer",
    holds: "two rows a piece: its place, its grey and opacity with their change",
    kind: ResourceKind::Storage(|facts, _| (2 * ROW * facts.scene.transfer.knots().len()) as u64),
    life: Life::Transfer,
    origin: Origin::Host(|facts| rows(facts, true)),
};

fn rows(facts: &Facts, grey: bool) -> Cow<'static, [u8]> {
    let pieces = shared::pieces(&Texels::of(facts.scene).transfer(&facts.scene.transfer));
    bytemuck::cast_slice(&shared::rows(&pieces, grey)).to_vec().into()
}

/// The table of pre-integrated classification.
pub const PREINTEGRATED: Resource = Resource::new(&PREINTEGRATED_INFO);
static PREINTEGRATED_INFO: ResourceInfo = ResourceInfo {
    name: "preintegrated",
    holds: "premultiplied colour and opacity of a step, by the values at its ends",
    kind: ResourceKind::Texture(Texture {
        format: |_| vk::Format::R32G32B32A32_SFLOAT,
        extent: |facts| {
            let nodes = preintegrated::nodes(facts.scene);
            [nodes, nodes, 1]
        },
        flat: true,
        filtered: false,
        shared: |_| true,
    }),
    life: Life::Transfer,
    origin: Origin::Host(|facts| {
        facts.table.map_or_else(Cow::default, |table| bytemuck::cast_slice(&table.texels).into())
    }),
};

/// The axes of the table of pre-integrated classification.
pub const AXIS: Resource = Resource::new(&AXIS_INFO);
static AXIS_INFO: ResourceInfo = ResourceInfo {
    name: "axis",
    holds: "pieces of the table's axes, over the texture's values",
    kind: ResourceKind::Storage(|facts, _| {
        (size_of::<shared::AxisPiece>() * (facts.scene.transfer.knots().len() + 1)) as u64
    }),
    life: Life::Transfer,
    origin: Origin::Host(|facts| {
        let texels = Texels::of(facts.scene);
        let pieces = facts.table.map(|table| shared::axis_pieces(table, |x| texels.scale * x + texels.offset));
        bytemuck::cast_slice(&pieces.unwrap_or_default()).to_vec().into()
    }),
};
