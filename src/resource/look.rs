//! The volume and what classifies its values.

use std::borrow::Cow;

use ash::vk;
use rayon::prelude::*;

use super::texels::{Texels, texel_format};
use crate::part::resource::{Facts, Life, Origin, Resource, ResourceInfo, ResourceKind, Texture};
use crate::scene::texture::TextureChoice;
use crate::shared;
use crate::structure::cells::Values;
use crate::truth::preintegrated;
use crate::vulkan::ImageShape;

/// The scalar field.
pub const VOLUME: Resource = Resource::new(&VOLUME_INFO);
static VOLUME_INFO: ResourceInfo = ResourceInfo {
    name: "volume",
    holds: "scalar values at voxel centres, as the texture keeps them",
    kind: ResourceKind::Texture(Texture {
        format: |facts| texel_format(TextureChoice::of(facts.scene).format),
        extent: |facts| facts.scene.field.dims(),
        shape: ImageShape::Volume,
        filtered: true,
        shared: |_| true,
    }),
    life: Life::Volume,
    origin: Origin::Host(|facts| bytes_of(Texels::of(facts.scene).values)),
};

/// The volume as stacks of 2D textures, across each of its axes [Thesis §3.4.1].
pub const STACKS: [Resource; 3] = [Resource::new(&STACK_X), Resource::new(&STACK_Y), Resource::new(&STACK_Z)];
static STACK_X: ResourceInfo = stack(|facts| stack_sides(facts, 0), |facts| stack_bytes(facts, 0));
static STACK_Y: ResourceInfo = stack(|facts| stack_sides(facts, 1), |facts| stack_bytes(facts, 1));
static STACK_Z: ResourceInfo = stack(|facts| stack_sides(facts, 2), |facts| stack_bytes(facts, 2));

const fn stack(sides: fn(&Facts) -> [usize; 3], bytes: for<'a> fn(&Facts<'a>) -> Cow<'a, [u8]>) -> ResourceInfo {
    ResourceInfo {
        name: "stack",
        holds: "scalar values at voxel centres, a layer for each place along an axis",
        kind: ResourceKind::Texture(Texture {
            format: |facts| texel_format(TextureChoice::of(facts.scene).format),
            extent: sides,
            shape: ImageShape::Layers,
            filtered: true,
            shared: |_| true,
        }),
        life: Life::Volume,
        origin: Origin::Host(bytes),
    }
}

/// The axes of the volume along the columns, the rows and the layers of the stack across `axis`.
fn stack_axes(axis: usize) -> [usize; 3] {
    match axis {
        0 => [1, 2, 0],
        1 => [0, 2, 1],
        _ => [0, 1, 2],
    }
}

fn stack_sides(facts: &Facts, axis: usize) -> [usize; 3] {
    stack_axes(axis).map(|axis| facts.scene.field.dims()[axis])
}

/// The volume's texels in the order of the stack across `axis`.
fn stack_bytes<'a>(facts: &Facts<'a>, axis: usize) -> Cow<'a, [u8]> {
    let (dims, axes) = (facts.scene.field.dims(), stack_axes(axis));
    let bytes = bytes_of(Texels::of(facts.scene).values);
    if axes == [0, 1, 2] {
        return bytes;
    }
    let texel = bytes.len() / dims.iter().product::<usize>().max(1);
    let strides = [1, dims[0], dims[0] * dims[1]];
    let [columns, rows, _] = axes.map(|axis| dims[axis]);
    let mut ordered = vec![0; bytes.len()];
    ordered.par_chunks_mut((columns * rows * texel).max(1)).enumerate().for_each(|(layer, texels)| {
        for (i, place) in texels.chunks_exact_mut(texel).enumerate() {
            let at = (i % columns) * strides[axes[0]] + (i / columns) * strides[axes[1]] + layer * strides[axes[2]];
            place.copy_from_slice(&bytes[at * texel..][..texel]);
        }
    });
    ordered.into()
}

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
        shape: ImageShape::Volume,
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

/// The same pieces as constants of all invocations, where they are few.
pub const FEW_TRANSFER: Resource = Resource::new(&FEW_TRANSFER_INFO);
static FEW_TRANSFER_INFO: ResourceInfo =
    few_pieces("three rows a piece, as in the storage buffer", |facts| few_rows(rows(facts, false)));

/// The same without colours.
pub const FEW_GREY_TRANSFER: Resource = Resource::new(&FEW_GREY_TRANSFER_INFO);
static FEW_GREY_TRANSFER_INFO: ResourceInfo =
    few_pieces("two rows a piece, as in the storage buffer", |facts| few_rows(rows(facts, true)));

const fn few_pieces(holds: &'static str, bytes: for<'a> fn(&Facts<'a>) -> Cow<'a, [u8]>) -> ResourceInfo {
    ResourceInfo {
        name: "transfer",
        holds,
        kind: ResourceKind::Uniform(|_, _| (shared::FEW_ROWS * ROW) as u64),
        life: Life::Transfer,
        origin: Origin::Host(bytes),
    }
}

/// Rows of the buffer of few pieces, of which those that no piece has are 0.
fn few_rows(rows: Cow<'_, [u8]>) -> Cow<'static, [u8]> {
    let mut bytes = rows.into_owned();
    bytes.resize(shared::FEW_ROWS * ROW, 0);
    bytes.into()
}

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
        shape: ImageShape::Flat,
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
