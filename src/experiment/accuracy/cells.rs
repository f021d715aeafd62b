//! Errors of ways through the cells of a mesh: integrated exactly, and by tables [Roettger00].

use super::Curve;
use crate::error::Result;
use crate::method;
use crate::projection;
use crate::scene::Scene;
use crate::scene::settings::Classification;

/// The order of tables in the distance between their nodes, where the transfer function has no bends between them: they are linear there.
const ORDER_OF_TABLES: f64 = 2.0;

/// What curves of tables are called.
const BY_TABLE: &str = "by table";

/// A way to integrate: its words, the order of its error, and the tables it is measured with, none for no table.
pub type CellIntegral = (String, Option<f64>, Vec<Option<u32>>);

/// The exact integral, and tables of these nodes a side, each once, where there are colours to put into them.
pub fn ways(scene: &Scene, sizes: &[u32]) -> Vec<CellIntegral> {
    let mut ways = vec![(String::new(), None, vec![None])];
    let colors = scene.surface.is_none() || scene.surfaces_in_volume();
    if colors && !projection::of(&scene.settings).shows_values() {
        let mut sizes = sizes.to_vec();
        sizes.sort_unstable();
        sizes.dedup();
        ways.push((BY_TABLE.to_owned(), Some(ORDER_OF_TABLES), sizes.into_iter().map(Some).collect()));
    }
    ways
}

/// The scene with a table of so many nodes a side, or with none.
///
/// # Errors
/// When it cannot have one.
pub fn with_table(scene: &Scene, nodes: Option<u32>) -> Result<Scene> {
    let mut scene = scene.clone();
    let sampling = &mut scene.settings.sampling;
    sampling.classification = if nodes.is_some() { Classification::PreIntegrated } else { Classification::Post };
    sampling.table = nodes.unwrap_or(sampling.table);
    scene.settings.check()?;
    Ok(scene)
}

impl Curve {
    /// Whether it has one picture, of ways through cells that are integrated exactly.
    pub fn is_of_exact_cells(&self) -> bool {
        let through_cells = method::of_cells().iter().any(|name| name.name() == self.method);
        through_cells && !self.is_of_tables()
    }

    /// Whether it goes by the nodes of a table.
    pub fn is_of_tables(&self) -> bool {
        self.points.iter().any(|point| point.table.is_some())
    }
}
