//! The structures a plan asks for, built on the CPU, with what building them took.

use std::sync::Arc;

use cpu_time::ProcessTime;

use crate::part::resource::Resource;
use crate::plan::Plan;
use crate::projection::Shown;
use crate::resource;
use crate::resource::texels::Texels;
use crate::scene::Scene;
use crate::scene::gradients::GradientCoding;
use crate::structure::gradients::GradientTexels;
use crate::structure::grid::DistanceField;
use crate::structure::{self, Lookup, blocks::Blocks};
use crate::truth::cell_table::CellTable;
use crate::truth::importance::Importance;
use crate::truth::preintegrated::PreintegratedTable;

/// A structure and what it cost.
#[derive(Clone, Debug)]
pub struct Built<T> {
    pub value: T,
    /// CPU time of the process, milliseconds.
    pub cpu_ms: f64,
    pub bytes: u64,
}

/// What a frame looks up to skip.
#[derive(Clone, Debug, Default)]
pub struct Structures {
    pub distances: Vec<(Lookup, Built<DistanceField>)>,
    pub blocks: Option<Built<Blocks>>,
    /// Gradients, where a frame reads them from a texture.
    pub gradients: Option<Arc<GradientTexels>>,
    /// Of pre-integrated classification, for one transfer function and one step.
    pub table: Option<Arc<PreintegratedTable>>,
    /// How long adaptive steps may be.
    pub importance: Option<Arc<Importance>>,
    /// Of ways through cells, for one transfer function.
    pub cells: Option<Arc<CellTable>>,
}

impl Structures {
    /// Adds what the plan reads and is not there yet. All of it depends on volume and transfer function, some on the
    /// view besides, so that plans of one scene may share it.
    pub fn prepare(&mut self, scene: &Scene, plan: &Plan) {
        self.table = self.table(scene);
        self.gradients = self.gradients(scene);
        self.cells = self.cells(scene);
        self.importance = self.importance(scene);
        if let Some(lookup) = plan.distance.filter(|lookup| self.distance(lookup).is_none()) {
            let texels = Texels::of(scene);
            let build = || structure::build(&scene.field, &texels.values, &texels.shown(scene), &lookup);
            self.distances.push((lookup, timed(build, |d| d.bytes.len() as u64)));
        }
        let reads = |r: Resource| plan.frame().iter().any(|s| s.accesses.iter().any(|a| a.resource == r));
        if self.blocks.is_none() && reads(resource::block_ranges()) {
            self.blocks = Some(timed(|| Blocks::build(&scene.field, &Shown::in_x(scene)), Blocks::bytes));
        }
    }

    /// The table of pre-integrated classification, where the scene asks for one: the one that is here, or a new one.
    pub fn table(&self, scene: &Scene) -> Option<Arc<PreintegratedTable>> {
        let new = || self.table.clone().unwrap_or_else(|| Arc::new(PreintegratedTable::new(scene)));
        scene.has_step_table().then(new)
    }

    /// The table of ways through cells, where the scene asks for one: the one that is here, or a new one.
    pub fn cells(&self, scene: &Scene) -> Option<Arc<CellTable>> {
        self.cells.clone().or_else(|| CellTable::of(scene).map(Arc::new)).filter(|_| scene.has_cell_table())
    }

    /// The importance volume, where the scene asks for one: the one that is here, or a new one.
    pub fn importance(&self, scene: &Scene) -> Option<Arc<Importance>> {
        let asked = scene.settings.adaptive.importance;
        self.importance.clone().filter(|_| asked).or_else(|| Importance::of(scene).map(Arc::new))
    }

    /// The gradients, where the scene reads them from a texture: those that are here, or new ones.
    pub fn gradients(&self, scene: &Scene) -> Option<Arc<GradientTexels>> {
        let new = || {
            let (texels, operator) = (Texels::of(scene), scene.settings.shading.gradient);
            Arc::new(GradientTexels::new(&scene.field, &texels.values, operator, GradientCoding::of(scene)))
        };
        scene.has_gradient_texture().then(|| self.gradients.clone().unwrap_or_else(new))
    }

    /// The distances of that kind, where they were built.
    pub fn distance(&self, lookup: &Lookup) -> Option<&Built<DistanceField>> {
        self.distances.iter().find(|(made, _)| made == lookup).map(|(_, built)| built)
    }
}

fn timed<T>(build: impl FnOnce() -> T, bytes: impl FnOnce(&T) -> u64) -> Built<T> {
    let begin = ProcessTime::now();
    let value = build();
    let cpu_ms = begin.elapsed().as_secs_f64() * 1e3;
    let bytes = bytes(&value);
    Built { value, cpu_ms, bytes }
}
