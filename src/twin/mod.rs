//! The f64 reference: a twin of every pass and of what passes share, under the same stem as in `glsl`.

mod adaptive;
pub mod backdrop;
pub mod block_skip;
mod cell_surface;
pub mod clip_begin;
mod clip_volume;
pub mod clip_winding;
mod crossings;
pub mod direction;
pub mod entry;
mod environment;
pub mod fused;
pub mod gradient;
pub mod layer;
mod light_path;
pub mod lighting;
pub mod main_pass;
pub mod near_neighbor;
pub mod peel;
pub mod phong;
mod refraction;
pub mod samples;
pub mod section;
pub mod segment;
pub mod shells;
pub mod single_pass;
pub mod slices;
pub mod start;
pub mod surface;
pub mod termination;
pub mod tetrahedra;

pub use refraction::LeavingRay;

use glam::DVec3;

use crate::math::ray::ViewRays;
use crate::projection::{Levels, Projection};
use crate::scene::mesh::MOST_CLIPS;
use crate::scene::slices::Slices;
use crate::scene::tetrahedra::{CellsView, Entry};
use crate::scene::{Light, Scene};
use crate::structure::blocks::Blocks;
use crate::structure::gradients::GradientTexels;
use crate::structure::grid::DistanceField;
use crate::truth::cell_table::CellTable;
use crate::truth::exact::Absorber;
use crate::truth::importance::Importance;
use crate::truth::preintegrated::PreintegratedTable;

/// Depth of a ray that is saturated or gone, as in `glsl/shared/mark.glsl`.
pub const DEAD: f64 = 1.0;

/// Depth of a ray that has nothing to do in the next segment, and goes on behind it.
pub const SKIPPED: f64 = 0.5;

/// What every twin knows of the frame.
#[derive(Clone, Copy)]
pub struct Twin<'a> {
    pub scene: &'a Scene,
    pub rays: ViewRays,
    /// How far off the place where a ray enters or leaves may be in f32, in texture coordinates, besides its last bit.
    pub rays_off: f64,
    /// What samples lie on, where they lie on slices.
    pub slices: Option<&'a Slices>,
    /// What rays meet of a mesh of cells; none for methods that do not go through them.
    pub cells: Option<&'a CellsView>,
    /// The transfer function as what light passes through on its way through cells and on adaptive steps.
    pub medium: Option<&'a Absorber<'a>>,
    /// Ways through cells, where they are looked up.
    pub cell_table: Option<&'a CellTable>,
    /// How long adaptive steps may be, where steps are.
    pub importance: Option<&'a Importance>,
    /// N, main passes of the frame.
    pub passes: u32,
    pub distance: Option<&'a DistanceField>,
    pub blocks: Option<&'a Blocks>,
    /// Of pre-integrated classification.
    pub table: Option<&'a PreintegratedTable>,
    /// Gradients, where they are read from a texture.
    pub gradients: Option<&'a GradientTexels>,
    pub projection: &'static Projection,
    /// Whether main passes mark where rays go on.
    pub fused: bool,
    /// What its values are held against, as x.
    pub levels: Levels,
    /// The values that are on each surface, as x; none where colours are shown.
    pub surface_values: &'a [[f64; 2]],
    /// Lights on surfaces or on samples, in the volume's axes.
    pub lights: &'a [Light],
    /// Steps of the raster that a rasteriser moves corners to, in pixels.
    pub raster: f64,
}

/// A surface that a ray meets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surface {
    /// Steps from where the ray enters the volume, negative in front of it.
    pub steps: f64,
    /// Lit, premultiplied RGBA.
    pub color: [f64; 4],
    /// Whether clip geometry keeps the volume behind it.
    pub kept: bool,
}

/// Where a ray meets an iso-surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MetSurface {
    /// Steps from the entry point.
    pub steps: f64,
    /// The number of the surface, by rising values.
    pub level: usize,
    /// Along the gradient by central differences, of any length, volume space.
    pub normal: DVec3,
}

/// One pixel of every image of the frame.
#[derive(Clone, Debug, Default)]
pub struct Pixel {
    pub column: u32,
    pub row: u32,
    /// ENTRY, texture coordinates.
    pub entry: DVec3,
    /// DIR: unit direction and length, volume space.
    pub direction: DVec3,
    pub length: f64,
    /// Steps from where the ray enters to where it has bent last, which ENTRY has then, as DIR has its direction there and the length of
    /// all of it; whether it has bent.
    pub anchor: f64,
    pub bent: bool,
    /// The index of refraction along the direction.
    pub momentum: DVec3,
    /// Where a ray that has bent leaves the volume.
    pub leaves: Option<LeavingRay>,
    /// RES, premultiplied RGBA.
    pub accumulated: [f64; 4],
    /// RES of rays that look for a surface: steps to the places between which they meet it, 0, and 1 where there is one.
    pub hit: [f64; 4],
    /// How far f32 may be off with where a clip volume cuts the step in which that was met, in steps.
    pub cut: f64,
    /// The iso-surface that the ray has met, once it is lit.
    pub surface: Option<MetSurface>,
    /// How far the ray has come, in adaptive steps of the shortest length.
    pub reached: u32,
    /// The depth buffer.
    pub stored: f64,
    /// The depth buffer of shells, and how far a rasteriser may see it elsewhere.
    pub shell_depth: f64,
    pub shell_spread: f64,
    /// The faces by which the ray enters a mesh of cells, layer by layer; none before that was asked.
    pub entries: Option<Vec<Option<Entry>>>,
    /// The side by which the ray enters its current cell, and where.
    pub cell: Option<tetrahedra::CellState>,
    /// Fronts less backs of each clip mesh that the ray meets.
    pub entered: [i32; MOST_CLIPS],
    /// Where clip geometry lets the volume begin: a surface behind all that is hidden, or the begin of the ray.
    pub begin: Option<Surface>,
    /// Surfaces of the layers that were peeled.
    pub layers: Vec<Surface>,
    /// The nearest opaque surface.
    pub opaque: Option<Surface>,
    /// The part of the ray that is drawn: that behind so many layers.
    pub section: u32,
    /// f32 cannot decide whether a sample is on the ray, on which side of a jump or in which of two cells it lies, or
    /// whether the ray is saturated; picture and counts of the pixel may differ by more than rounding.
    pub undecided: bool,
    /// How far f32 may be from the colour, beyond what it takes from sums of samples.
    pub rounding: f64,
}

/// Numbers as the 32-bit attachments ENTRY and DIR keep them: samples are taken along the ray that is stored.
fn stored(value: DVec3) -> DVec3 {
    value.as_vec3().as_dvec3()
}

/// What a pass did with a pixel it ran for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Effect {
    /// Nothing that shows.
    Silent,
    /// The fragment is none of those that pass.
    Discarded,
    /// It took a sample of non-zero opacity, or, where values are shown, one that changes the pixel.
    Contributed,
    /// The same of many fragments of one pixel: how many pass, and how many of them took such a sample.
    Several { fragments: u64, contributed: u64 },
}

impl Effect {
    /// Fragments that pass.
    pub fn fragments(self) -> u64 {
        match self {
            Self::Discarded => 0,
            Self::Silent | Self::Contributed => 1,
            Self::Several { fragments, .. } => fragments,
        }
    }

    /// Fragments that took a sample which shows.
    pub fn contributed(self) -> u64 {
        match self {
            Self::Silent | Self::Discarded => 0,
            Self::Contributed => 1,
            Self::Several { contributed, .. } => contributed,
        }
    }
}

/// The f64 form of a pass: one pixel, the main pass it belongs to.
pub type TwinPass = fn(&Twin, &mut Pixel, u32) -> Effect;
