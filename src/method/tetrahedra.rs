//! `tet-*`: rays from cell to cell of a mesh of tetrahedra [Weiler03 "Hardware-Based Ray Propagation"].

use super::rows::{EARLY_Z, RAY_CASTER, SWITCH, every_form};
use crate::feature::cells::takes_cells;
use crate::feature::{BATCH, EARLY_ENDS};
use crate::geometry::SCREEN;
use crate::part::rows::{CellWalk, Context, Method, Traversal};
use crate::part::steps::Steps;
use crate::pass::{alive, clear, mark_copy, tetrahedra};
use crate::resource;
use crate::scene::settings::Mark;

pub const TET_SINGLE_PASS: Method = Method {
    name: "tet-single-pass",
    about: "A mesh of tetrahedra, its rays from cell to cell in one shader that holds the whole way",
    source: "Weiler03",
    takes: takes_cells,
    papers: None,
    forms: Vec::new,
    traversal: Traversal::Cells(CellWalk::FragmentLoop),
    steps: |context, steps| {
        layers(context, steps, |context, layer, steps| steps.push(tetrahedra::single_pass(context, layer)))
    },
    ..RAY_CASTER
};

pub const TET_SINGLE_PASS_COMPUTE: Method = Method {
    name: "tet-single-pass+compute",
    about: "tet-single-pass as a compute shader, in tiles of 8 x 8 pixels",
    traversal: Traversal::Cells(CellWalk::ComputeLoop),
    steps: |context, steps| {
        layers(context, steps, |context, layer, steps| steps.push(tetrahedra::single_pass_compute(context, layer)));
    },
    ..TET_SINGLE_PASS
};

pub const TET_PROPAGATION: Method = Method {
    name: "tet-propagation",
    about: "A mesh of tetrahedra, its rays a cell further in each pass",
    papers: EARLY_Z,
    forms: every_form,
    traversal: Traversal::Cells(CellWalk::Passes),
    steps: |context, steps| layers(context, steps, propagation),
    ..TET_SINGLE_PASS
};

/// The faces by which rays enter the mesh, layer by layer; then `through` behind each of them.
fn layers(context: &Context, steps: &mut Steps, through: fn(&Context, u32, &mut Steps)) {
    let Some(cells) = context.view.cells.as_ref().filter(|_| context.passes > 0) else { return };
    let begins = u32::from(tetrahedra::begins(context));
    steps.extend((begins > 0).then(|| tetrahedra::begin(context)));
    for layer in begins..cells.layers() {
        steps.push(tetrahedra::enter(context, layer));
    }
    for layer in 0..cells.layers() {
        // Without faces there is nothing behind them.
        steps.enter(layer + 1, layer.checked_sub(begins));
        through(context, layer, steps);
    }
    steps.enter(0, None);
}

/// Passes behind a layer: after every second one depths are updated, and now and then the rays left are counted.
fn propagation(context: &Context, layer: u32, steps: &mut Steps) {
    // The first update reads RES, which begins with values where these are shown.
    let reads = layer == 0 && context.has(&EARLY_ENDS) && !context.projection().shows_values();
    steps.extend(reads.then(|| clear::clear(context)));
    steps.push(tetrahedra::start(context, layer));
    let Some(form) = context.form else {
        steps.extend((0..context.passes).map(|pass| tetrahedra::propagate(context, pass, None)));
        return;
    };
    for pass in 0..context.passes {
        if pass.is_multiple_of(2) {
            steps.push(tetrahedra::update(context, pass, form));
            steps.extend((form.mark == Mark::Copy).then(|| mark_copy::mark_copy(pass, None)));
        }
        if pass > 0 && pass.is_multiple_of(BATCH) {
            steps.push(alive::alive(&SCREEN, pass, Some(resource::ACCUMULATED)));
        }
        steps.push(tetrahedra::propagate(context, pass, Some((form.cull, SWITCH))));
    }
}
