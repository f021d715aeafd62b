//! Compute steps that build structures: which cells are interesting, how far it is to the nearest of them, gradients, and shells.
//!
//! They are run before frames, once for what they depend on: the volume, the transfer function, the view. Each step is
//! cut into slices, so that a large volume takes many short dispatches. [`RECIPES`] says which steps make what.

mod bundle;
mod distance;
mod gradients;
mod interesting;
mod range;
mod shells;

use bundle::{bundle, widen_2, widen_4};
use distance::{directional, omni};
use gradients::gradients;
use interesting::interesting;
use range::cell_range;

use std::sync::Arc;

use crate::glsl::Shader;
use crate::part::access::{Access, Usage};
use crate::part::resource::{Facts, Life, Resource};
use crate::part::{Dispatch, Group, Step, Work};
use crate::resource;
use crate::resource::texels::Texels;
use crate::scene::gradients::GradientCoding;
use crate::scene::settings::Distance;
use crate::shared::Slice;
use crate::structure::grid::Grid;
use crate::structure::{self, Lookup, RaysFrom};

/// How a resource is built.
pub struct Recipe {
    pub makes: Resource,
    /// The steps, by what sizes follow from and the resource's index; none where the host alone has a form of it.
    pub steps: Option<fn(&Facts, u16) -> Vec<Step>>,
    /// The bytes as the host makes them, where it has a form of its own.
    pub host: Option<fn(&Facts, u16) -> Vec<u8>>,
}

/// Every recipe.
pub static RECIPES: [Recipe; 9] = [
    Recipe {
        makes: resource::CELL_RANGE,
        steps: Some(|facts, side| vec![cell_range(&Grid::new(&facts.scene.field, side.into()))]),
        host: None,
    },
    Recipe {
        makes: resource::INTERESTING,
        steps: Some(|facts, _| {
            of_lookup(facts, |grid, lookup| vec![interesting(grid, facts.scene.field.holes.is_some(), lookup)])
        }),
        host: None,
    },
    Recipe {
        makes: resource::WIDE_2,
        steps: Some(|facts, _| of_lookup(facts, |grid, _| vec![widen_2(grid)])),
        host: None,
    },
    Recipe {
        makes: resource::WIDE_4,
        steps: Some(|facts, _| of_lookup(facts, |grid, _| vec![widen_4(grid)])),
        host: None,
    },
    Recipe {
        makes: resource::OMNI_DISTANCE,
        steps: Some(|facts, _| of_lookup(facts, |grid, _| omni(grid, resource::OMNI_DISTANCE))),
        host: None,
    },
    Recipe {
        makes: resource::NEAREST_DISTANCE,
        steps: Some(|facts, _| {
            of_lookup(facts, |grid, lookup| match lookup.distance {
                Distance::Omni => omni(grid, resource::NEAREST_DISTANCE),
                Distance::Directional => directional(grid),
                Distance::Optimal | Distance::Cone => {
                    bundle(grid, lookup.view.is_some_and(|view| matches!(view.from, RaysFrom::Along(_))))
                }
            })
        }),
        host: Some(|facts, _| {
            let texels = Texels::of(facts.scene);
            let shown = texels.shown(facts.scene);
            let build = |lookup| structure::build(&facts.scene.field, &texels.values, &shown, &lookup).bytes;
            facts.lookup.map(build).unwrap_or_default()
        }),
    },
    Recipe {
        makes: resource::GRADIENTS,
        steps: Some(|facts, _| gradients(facts.scene)),
        host: Some(|facts, _| {
            let (scene, texels) = (facts.scene, Texels::of(facts.scene));
            let operator = scene.settings.shading.gradient;
            structure::gradients::texels(&scene.field, &texels.values, operator, &GradientCoding::of(scene))
        }),
    },
    Recipe { makes: resource::SHELL_POLYGONS, steps: Some(shells::shell), host: Some(shells::polygons) },
    Recipe {
        makes: resource::IMPORTANCE,
        steps: None,
        host: Some(|facts, _| facts.importance.map_or_else(Vec::new, |made| made.steps.clone())),
    },
];

/// The recipe of a resource; none for what is not built.
pub fn recipe(resource: Resource) -> Option<&'static Recipe> {
    RECIPES.iter().find(|recipe| std::ptr::eq(recipe.makes.of, resource.of))
}

fn of_lookup(facts: &Facts, steps: impl FnOnce(&Grid, &Lookup) -> Vec<Step>) -> Vec<Step> {
    facts.lookup.map_or_else(Vec::new, |lookup| steps(&Grid::new(&facts.scene.field, lookup.cell), &lookup))
}

/// The host makes a resource, and its bytes are uploaded.
pub fn host(resource: Resource, group: Group) -> Step {
    let pass = if resource.of.life == Life::Shell { resource.index } else { 0 };
    Step::new(resource.numbered(), group, pass.into(), vec![Usage::Upload.of(resource)], Work::Host(resource))
}

/// What a step of `count` invocations knows of the grid.
fn slice(grid: &Grid, count: usize) -> Slice {
    let [cells_x, cells_y, cells_z] = grid.cells.map(|n| n as u32);
    Slice { end: count as u32, cells_x, cells_y, cells_z, cell: grid.cell as u32, ..Slice::default() }
}

/// A dispatch that reads and writes these, bound under their own names or those given.
fn dispatch(
    name: String,
    shader: Shader,
    reads: &[(&'static str, Resource)],
    writes: &[(&'static str, Resource)],
    slice: Slice,
    cells: usize,
) -> Step {
    let used = |usage: Usage| move |(_, resource): &(&str, Resource)| usage.of(*resource);
    let mut accesses: Vec<Access> = reads.iter().map(used(Usage::ComputeRead)).collect();
    accesses.extend(writes.iter().map(used(Usage::ComputeWrite)));
    let work = Work::Dispatch(Dispatch {
        shader: Arc::new(shader),
        constants: Vec::new(),
        bound: [reads, writes].concat(),
        slice,
        cells: cells as u32,
    });
    Step::new(name, Group::Structure, 0, accesses, work)
}

/// Texels that were made in the buffer `from`, to the texture `to`.
fn unpack(from: Resource, to: Resource) -> Step {
    let accesses = vec![Usage::CopySource.of(from), Usage::CopyTarget.of(to)];
    let work = Work::Unpack { from, to };
    Step::new(to.name().to_owned(), Group::Structure, 0, accesses, work)
}
