//! How large a plan's resources are on a device, before there is one.

use crate::part::resource::Resource;
use crate::plan::{Plan, bytes_per_pixel};
use crate::scene::Scene;
use crate::scene::texture::TextureChoice;
use crate::shared;
use crate::structure::blocks::{BLOCK, CODES};
use crate::structure::grid::{Grid, OCTANTS};
use crate::truth::preintegrated;

/// Bytes of a resource; none for what exists only while a structure is built.
pub fn bytes(scene: &Scene, plan: &Plan, resource: Resource) -> Option<u64> {
    let (field, knots) = (&scene.field, scene.transfer.knots().len());
    let cells = |side: u32| Grid::new(field, side).count();
    let row = size_of::<[f32; 4]>();
    let bytes = match resource {
        Resource::Box => size_of::<[f32; 3]>() * (plan.view.front.len() + plan.view.back.len()),
        Resource::Frame => size_of::<shared::Frame>(),
        Resource::Volume => field.values.len() * TextureChoice::of(scene).format.bytes(),
        Resource::Holes => field.cells().iter().product(),
        Resource::Transfer => 3 * row * knots,
        Resource::GreyTransfer => 2 * row * knots,
        Resource::Axis => size_of::<shared::AxisPiece>() * (knots + 1),
        Resource::Preintegrated => row * preintegrated::nodes(scene).pow(2),
        Resource::NearestDistance => {
            let lookup = plan.distance?;
            let octants = if lookup.distance == crate::scene::settings::Distance::Directional { OCTANTS } else { 1 };
            cells(lookup.cell) * octants
        }
        Resource::CellRange if plan.distance.is_none() => size_of::<[f32; 2]>() * cells(BLOCK as u32),
        Resource::BlockTable => CODES * CODES,
        target => {
            let pixel = bytes_per_pixel(target, scene.settings.formats());
            return (pixel > 0).then(|| plan.view.region.pixels() * pixel);
        }
    };
    Some(bytes as u64)
}
