//! Structures that are built of a volume: those that tell where it holds nothing to see, and gradients.

mod axes;
pub mod axis;
pub mod blocks;
pub mod bundle;
pub mod cells;
mod changes;
pub mod content;
pub mod distance;
mod ends;
pub mod gradients;
pub mod grid;
pub mod octants;
pub mod ranges;
mod repair;
pub mod square;
pub mod transform;
pub mod update;
pub mod wide;

use glam::DVec3;

use crate::projection::{self, Shown};
use crate::scene::settings::{Distance, Filter, ProjectionName};
use crate::scene::{Camera, Field, Scene};
use bundle::Bundles;
use cells::Values;
use grid::{DistanceField, Grid};

/// The distances a frame looks up: two frames with equal ones share a structure, as long as volume and transfer
/// function stay.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lookup {
    pub distance: Distance,
    /// Side of a cell, in voxels.
    pub cell: u32,
    /// Samples have the value of the nearest voxel, so that a cell shows what one of its voxels shows, and nothing between.
    pub nearest: bool,
    /// What counts as interesting is a matter of the projection.
    pub projection: ProjectionName,
    /// Where rays come from and how far their directions may be off: for structures made for a view.
    pub view: Option<LookupView>,
}

/// What `optimal` and `cone` were made for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LookupView {
    pub from: RaysFrom,
    /// Half-angle of the cone about the direction of the ray through each point, radians; none for the view's own rays only.
    pub half_angle: Option<f64>,
}

/// Where the rays of a view come from, in volume space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RaysFrom {
    Eye(DVec3),
    /// From far away, all along this direction of length 1.
    Along(DVec3),
}

impl RaysFrom {
    /// The rays of a camera.
    pub fn of(camera: &Camera) -> Self {
        match camera.height {
            None => Self::Eye(camera.eye),
            Some(_) => Self::Along((camera.target - camera.eye).normalize_or_zero()),
        }
    }
}

impl Lookup {
    /// Whether cells are judged by the range of their values.
    pub fn reads_ranges(&self) -> bool {
        self.cell > 1 && !self.nearest
    }

    /// What is looked up of distances of a kind in a scene.
    pub fn new(scene: &Scene, distance: Distance) -> Self {
        let method = &scene.settings.method;
        let nearest = scene.settings.sampling.filter == Filter::Nearest;
        let view = |half_angle| Some(LookupView { from: RaysFrom::of(&scene.camera), half_angle });
        let view = match distance {
            Distance::Omni | Distance::Directional => None,
            Distance::Optimal => view(None),
            Distance::Cone => view(Some(method.cone.to_radians())),
        };
        Self { distance, cell: method.cell, nearest, projection: projection::of(&scene.settings).name(), view }
    }
}

/// The structure of an `nn-*` method on the host: the twin of what compute shaders build. `values` are the volume's as
/// a texture holds them, and `shown` is said of these.
pub fn build(field: &Field, values: &Values, shown: &Shown, lookup: &Lookup) -> DistanceField {
    let grid = Grid::new(field, lookup.cell);
    let interesting = cells::interesting(field, values, shown, &grid, lookup.nearest);
    match (lookup.distance, &lookup.view) {
        (Distance::Directional, _) => octants::directional(&grid, &interesting),
        (_, None) => distance::omni(&grid, &interesting),
        (_, Some(view)) => {
            let omni = distance::omni(&grid, &interesting);
            bundle::along(&omni, &interesting, &Bundles::new(&grid, field, view))
        }
    }
}
