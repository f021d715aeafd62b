//! Meshes of cells: what of the features their frames have, and what they refuse.

use super::classification::CLASSIFICATION;
use super::colors::COLORS;
use super::surface::{ISO_SURFACE, SURFACES_IN_VOLUME};
use super::transfer_function::{FEW_PIECES, TRANSFER_FUNCTION};
use super::{light_paths, lights};
use crate::error::{Error, Result};
use crate::part::Constant;
use crate::part::resource::Resource;
use crate::part::rows::{Context, Feature};
use crate::projection::{self, AVERAGE};
use crate::resource;
use crate::scene::Scene;
use crate::scene::settings::{Alpha, Filter, Find, Shows};

/// The features that ways through cells are classified by.
const OF_CELLS: [&Feature; 4] = [&CLASSIFICATION, &COLORS, &TRANSFER_FUNCTION, &FEW_PIECES];

/// Specialization constants of what ways through cells bring.
pub fn constants(context: &Context) -> Vec<Constant> {
    let mut constants = Vec::new();
    if context.has(&CLASSIFICATION) && !context.scene.has_cell_table() {
        constants.extend(OF_CELLS.into_iter().flat_map(|feature| (feature.constants)(context)));
        constants.extend([one_color(context), shallow(context)]);
    }
    constants.extend(context.has(&ISO_SURFACE).then(|| lights::white_lights(context)));
    constants
}

/// Of `cell_integral.glsl`: whether the transfer function has one colour.
pub fn one_color(context: &Context) -> Constant {
    let knots = context.scene.transfer.knots();
    let one_color = context.plans() && knots.iter().all(|knot| knot.color == knots[0].color);
    ("ONE_COLOR", u32::from(one_color))
}

/// Optical depths up to this are shallow, somewhat less than one half, which shaders need: lengths of ways are rounded.
const SHALLOW: f64 = 0.49;

/// Of `cell_integral.glsl`: whether no opacity is above one half, and no optical depth of a way through a cell.
fn shallow(context: &Context) -> Constant {
    let scene = context.scene;
    let most = scene.transfer.knots().iter().fold(0.0, |most: f64, knot| most.max(knot.opacity));
    let longest = scene
        .tetrahedra
        .as_ref()
        .map_or(f64::INFINITY, |mesh| mesh.longest_edge / (scene.transfer.reference * scene.field.finest()));
    let depth = -(-most).ln_1p() * longest;
    ("SHALLOW", u32::from(context.plans() && most <= 0.5 && depth <= SHALLOW))
}

/// What ways through cells read.
pub fn reads(context: &Context) -> Vec<Resource> {
    let mut reads = match context.scene.has_cell_table() {
        true => vec![resource::TET_TABLE],
        false => classified_by(context).flat_map(|feature| (feature.reads)(context)).collect(),
    };
    if context.has(&ISO_SURFACE) {
        reads.extend([resource::TET_POINTS, resource::SURFACE_LEVELS, lights::lights(context)]);
    }
    reads
}

fn classified_by(context: &Context) -> impl Iterator<Item = &'static Feature> {
    OF_CELLS.into_iter().filter(|feature| context.has(feature))
}

/// The defines of shaders that go through cells.
pub fn defines(context: &Context) -> Vec<&'static str> {
    let mut defines: Vec<&str> =
        [ISO_SURFACE.define(context), SURFACES_IN_VOLUME.define(context)].into_iter().flatten().collect();
    match context.scene.has_cell_table() {
        true => defines.push("TABLE"),
        // Surfaces alone have neither colours nor values.
        false if context.has(&ISO_SURFACE) => {
            defines.extend(classified_by(context).filter_map(|feature| feature.define(context)));
        }
        false => defines.extend(OF_CELLS.into_iter().filter_map(|feature| feature.define(context))),
    }
    defines
}

/// Takes volumes of voxels.
///
/// # Errors
/// When the scene shows a mesh of cells.
pub fn takes_voxels(scene: &Scene) -> Result<()> {
    match scene.tetrahedra {
        None => Ok(()),
        Some(_) => Err(Error::usage(
            format!("--method {}", scene.settings.method.name),
            format!("takes voxels, and {} is a mesh of cells", scene.field.volume.name),
            "use tet-single-pass, tet-single-pass+compute or tet-propagation, or --method auto",
        )),
    }
}

/// Takes a mesh of cells with nothing in it or around it but iso-surfaces and their lights: colours, extremes and sums of its values.
///
/// # Errors
/// When the scene shows voxels, or asks for what there is of voxels alone.
pub fn takes_cells(scene: &Scene) -> Result<()> {
    let settings = &scene.settings;
    if scene.tetrahedra.is_none() {
        return Err(Error::usage(
            format!("--method {}", settings.method.name),
            format!("goes through the cells of a mesh, and {} has voxels", scene.field.volume.name),
            "use another method, or give a mesh (builtin:tets-ball, a file of VTK)",
        ));
    }
    let refused = |input: &str, why: &str, remedy: &str| Err(Error::usage(input, why, remedy));
    match () {
        () if settings.adaptive.importance => refused(
            "adaptive.importance (--importance)",
            "is of steps among voxels, and ways through cells have lengths of their own",
            "leave it out",
        ),
        () if !scene.polygons.is_empty() => refused(
            "[[mesh]], [[clip]] with a mesh",
            "are surfaces among voxels, and ways through cells are not cut at them",
            "leave them out",
        ),
        () if !scene.clip_planes().is_empty() || scene.clip_volume.is_some() => {
            refused("[[clip]] (--clip-plane)", "cuts volumes of voxels, and this is a mesh of cells", "leave it out")
        }
        () if settings.shells.mode.is_some() => refused(
            "[shells] (--shells)",
            "shows polygons made between voxels, and this is a mesh of cells",
            "use --iso, which is sought along rays, or leave it out",
        ),
        () if scene.surface.is_some() => takes_surfaces(scene),
        () if !scene.lights.is_empty() => refused(
            "[[light]]",
            "shines on samples by the gradients of voxels, and this is a mesh of cells",
            "add an iso-surface (--iso VALUE, or [surface]) that it shines on, or leave it out",
        ),
        () if asks_for_effects(scene) => refused(EFFECTS, EFFECTS_REFUSED, "leave them out"),
        () if projection::of(settings).name == AVERAGE.name => refused(
            "projection.kind (--projection average)",
            "divides by the length of the ray, which of one through a mesh is known at its end alone",
            "use xray, the sum",
        ),
        () if settings.sampling.filter == Filter::Nearest => refused(
            "sampling.filter (--filter nearest)",
            "asks for the values of voxels alone, and within cells values are linear",
            "leave it out",
        ),
        () if settings.sampling.alpha == Alpha::Paper => refused(
            "sampling.alpha (--alpha paper)",
            "takes opacities of steps as they stand, and ways through cells have lengths of their own",
            "use exponential",
        ),
        () if scene.has_cell_table() && projection::of(settings).shows_values() => refused(
            "sampling.classification (--classification pre-integrated)",
            "makes colours of values, and this projection shows values",
            "use --projection composite, or --classification post",
        ),
        () => Ok(()),
    }
}

const EFFECTS: &str = "[environment], [effects]";

const EFFECTS_REFUSED: &str = "are of samples and surfaces between voxels, and this is a mesh of cells";

fn asks_for_effects(scene: &Scene) -> bool {
    scene.environment.is_some() || scene.effect.is_some() || scene.backdrop.is_some()
}

/// Whether iso-surfaces within cells can be drawn as a scene asks.
fn takes_surfaces(scene: &Scene) -> Result<()> {
    let settings = &scene.settings;
    let refused = |input: &str, why: &str, remedy: &str| Err(Error::usage(input, why, remedy));
    match () {
        () if asks_for_effects(scene) || light_paths::asked(scene).is_some() => {
            refused(EFFECTS, EFFECTS_REFUSED, "leave them out")
        }
        () if scene.has_cell_table() && !scene.surfaces_in_volume() => refused(
            "sampling.classification (--classification pre-integrated)",
            "makes colours of ways through cells, and surfaces have one of their own",
            "use post with surfaces, or draw them with the volume (--surface-volume)",
        ),
        () if settings.surface.find == Find::Range => refused(
            "surface.find (--find range)",
            "asks for places with a value in a range, and rays meet surfaces within cells where they cross their values",
            "use crossing",
        ),
        () if settings.surface.shows != Shows::Color => refused(
            "surface.shows (--surface-shows)",
            "asks for places or normals between voxels, and this is a mesh of cells",
            "show colours",
        ),
        () => Ok(()),
    }
}
