//! Runs a plan in f64 through the twins of its passes, pixel by pixel, without a device.

use rayon::prelude::*;

use super::structures::Structures;
use crate::part::geometry::{Geometry, Hits, Sample};
use crate::part::{Draw, Group, Step, Work};
use crate::plan::Plan;
use crate::projection::{self, surface_values};
use crate::scene::Scene;
use crate::scene::texture::{TextureChoice, TextureMap};
use crate::scene::view::View;
use crate::truth::exact::Absorber;
use crate::twin::{Effect, LeavingRay, MetSurface, Pixel, Twin};

/// What a frame leaves when it runs in f64.
#[derive(Clone, Debug)]
pub struct CpuFrame {
    /// Premultiplied RGBA, row 0 on top.
    pub pixels: Vec<[f64; 4]>,
    /// The iso-surface that each ray has met.
    pub surfaces: Vec<Option<MetSurface>>,
    /// Where each ray that has bent leaves the volume.
    pub leaves: Vec<Option<LeavingRay>>,
    /// How far f32 may be from each pixel, beyond what it takes from sums of samples.
    pub rounding: Vec<f64>,
    /// Pixels that f32 cannot decide (see [`Pixel::undecided`]), or the rasteriser.
    pub undecided: Vec<bool>,
    /// How many of them lie so near to the outline of the box that a rasteriser, which moves corners to its raster,
    /// may cover them or not.
    pub outline: u64,
    pub counts: Counts,
    /// Fragments of each counting step of the frame: rays that were not dead, pixels of a layer.
    pub rays_left: Vec<u64>,
    /// Main fragments that took a sample of non-zero opacity: no skipping can run fewer and keep the picture.
    pub ideal: u64,
}

/// Fragments of each main pass and of the intermediate pass before it; where segments that end at a surface have a pass of their
/// own, it comes last.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    pub main: Vec<u64>,
    pub intermediate: Vec<u64>,
    /// Of the lighting pass of iso-surfaces: rays that have met one.
    pub light: u64,
    /// Of the parts of rays between layers, front to back; empty without polygons.
    pub layers: Vec<LayerCounts>,
}

/// Fragments of the parts of rays that end at a layer, or behind all of them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LayerCounts {
    /// Pixels of the layer at which this part ends; none where layers have no colours, whose pixels nobody draws.
    pub pixels: Option<u64>,
    pub main: u64,
    pub intermediate: u64,
}

impl Counts {
    pub fn new(passes: u32) -> Self {
        Self { main: vec![0; passes as usize], intermediate: vec![0; passes as usize], light: 0, layers: Vec::new() }
    }

    /// Counts the fragments of a step. Steps come in the order of their frame, in which polygons are peeled first.
    pub fn add(&mut self, step: &Step, fragments: u64) {
        let part = if step.group == Group::Blend { step.pass } else { step.section } as usize;
        let peels = step.group == Group::Peel;
        if peels || part >= self.layers.len() && !self.layers.is_empty() {
            self.layers.resize(self.layers.len().max(part + 1), LayerCounts::default());
        }
        let layer = self.layers.get_mut(part).filter(|_| !peels);
        let pass = step.pass as usize;
        if step.group == Group::Main && pass >= self.main.len() {
            // The pass of segments that end at a surface.
            self.main.resize(pass + 1, 0);
            self.intermediate.resize(pass + 1, 0);
        }
        match step.group {
            Group::Main => {
                self.main[pass] += fragments;
                layer.into_iter().for_each(|layer| layer.main += fragments);
            }
            Group::Intermediate => {
                self.intermediate[pass] += fragments;
                layer.into_iter().for_each(|layer| layer.intermediate += fragments);
            }
            Group::Light => self.light += fragments,
            Group::Blend => layer.into_iter().for_each(|layer| *layer.pixels.get_or_insert(0) += fragments),
            _ => {}
        }
    }
}

fn add(mine: &mut [u64], theirs: &[u64]) {
    mine.iter_mut().zip(theirs).for_each(|(a, b)| *a += b);
}

/// The raster of most rasterisers, as [`crate::vulkan::DeviceInfo::sub_pixel_bits`] has it.
pub const SUB_PIXEL_BITS: u32 = 8;

/// Runs the plan as a device whose rasteriser has a raster of 2^-`sub_pixel_bits` pixels would.
pub fn run(scene: &Scene, plan: &Plan, structures: &Structures, sub_pixel_bits: u32) -> CpuFrame {
    let height = plan.view.size[1];
    let (table, gradients, cell_table) =
        (structures.table(scene), structures.gradients(scene), structures.cells(scene));
    let importance = structures.importance(scene);
    let projection = projection::of(&scene.settings);
    let map = TextureMap::of(&scene.field, TextureChoice::of(scene).kept);
    let surface_values: Vec<[f64; 2]> =
        surface_values(scene, map).into_iter().map(|values| values.map(|value| map.x(value))).collect();
    let lights = scene.shining();
    let medium = Absorber::new(&scene.transfer);
    let twin = Twin {
        scene,
        rays: plan.view.rays,
        rays_off: plan.rays_off,
        slices: plan.view.slices.as_deref(),
        cells: plan.view.cells.as_deref(),
        medium: Some(&medium),
        cell_table: cell_table.as_deref(),
        importance: importance.as_deref(),
        passes: plan.passes,
        distance: plan.distance.and_then(|lookup| structures.distance(&lookup)).map(|d| &d.value),
        blocks: structures.blocks.as_ref().map(|b| &b.value),
        table: table.as_deref(),
        gradients: gradients.as_deref(),
        projection,
        fused: plan.method.fused,
        levels: projection.levels_in_x(scene),
        surface_values: &surface_values,
        lights: &lights,
        raster: 0.5f64.powi(sub_pixel_bits as i32),
    };
    let rows: Vec<(CpuFrame, Vec<u64>)> = (0..height).into_par_iter().map(|row| run_row(&twin, plan, row)).collect();
    let mut frame = CpuFrame::empty(plan);
    let mut fragments = vec![0; plan.frame().len()];
    for (row, of_row) in rows {
        frame.pixels.extend(row.pixels);
        frame.surfaces.extend(row.surfaces);
        frame.leaves.extend(row.leaves);
        frame.rounding.extend(row.rounding);
        frame.undecided.extend(row.undecided);
        frame.outline += row.outline;
        add(&mut fragments, &of_row);
        frame.ideal += row.ideal;
    }
    frame.count(plan, &fragments);
    frame
}

impl CpuFrame {
    fn empty(plan: &Plan) -> Self {
        Self {
            pixels: Vec::new(),
            surfaces: Vec::new(),
            leaves: Vec::new(),
            rounding: Vec::new(),
            undecided: Vec::new(),
            outline: 0,
            counts: Counts::new(plan.passes),
            rays_left: Vec::new(),
            ideal: 0,
        }
    }

    /// Adds up the fragments of each step of the frame, but for those that are not run since the step they hang on counted
    /// nothing.
    fn count(&mut self, plan: &Plan, fragments: &[u64]) {
        let steps = || plan.frame().iter().zip(fragments);
        for (step, fragments) in steps() {
            let runs = step.guard.is_none_or(|guard| self.rays_left[guard as usize] > 0);
            let fragments = if runs { *fragments } else { 0 };
            if step.group.counts() {
                self.rays_left.push(fragments);
            }
            self.counts.add(step, fragments);
        }
    }
}

/// A row of pixels, and the fragments that each step of the frame has there.
fn run_row(twin: &Twin, plan: &Plan, row: u32) -> (CpuFrame, Vec<u64>) {
    let mut frame = CpuFrame::empty(plan);
    let mut fragments = vec![0; plan.frame().len()];
    for column in 0..plan.view.size[0] {
        let mut pixel = Pixel { column, row, ..Pixel::default() };
        let mut hits = Coverage::default();
        for (step, count) in plan.frame().iter().zip(&mut fragments) {
            let of_step = match &step.work {
                Work::Draw(draw) => {
                    let sample = Sample { pixel: [column, row], raster: twin.raster };
                    let drawn = draw.geometry.draws(&plan.view, step.pass, sample.pixel);
                    let mut meets = || hits.of(draw.geometry, twin.scene, &plan.view, sample).fragments > 0;
                    (drawn && meets() && takes_part(draw, &pixel)).then_some(draw.twin)
                }
                Work::Pixels(pixels) => plan.view.region.contains([column, row]).then_some(Some(pixels.twin)),
                _ => None,
            };
            let Some(pass) = of_step else { continue };
            twin.enter(&mut pixel, step.section);
            let effect = pass.map_or(Effect::Silent, |pass| pass(twin, &mut pixel, step.pass));
            *count += effect.fragments();
            frame.ideal += effect.contributed();
        }
        let on_outline = hits.undecided();
        frame.pixels.push(pixel.accumulated);
        frame.surfaces.push(pixel.surface);
        frame.leaves.push(pixel.leaves);
        frame.rounding.push(pixel.rounding);
        frame.undecided.push(pixel.undecided || on_outline);
        frame.outline += u64::from(on_outline);
    }
    (frame, fragments)
}

/// Whether the fragment passes the step's tests. One rule for every form: least <= stored <= bound.
fn takes_part(draw: &Draw, pixel: &Pixel) -> bool {
    (f64::from(draw.least)..=f64::from(draw.bound)).contains(&pixel.stored)
}

/// What geometries make of one pixel, each asked once.
#[derive(Default)]
struct Coverage(Vec<(&'static Geometry, Hits)>);

impl Coverage {
    fn of(&mut self, geometry: &'static Geometry, scene: &Scene, view: &View, sample: Sample) -> Hits {
        if let Some((_, known)) = self.0.iter().find(|(of, _)| *of == geometry) {
            return *known;
        }
        let hits = (geometry.hits)(scene, view, sample);
        self.0.push((geometry, hits));
        hits
    }

    fn undecided(&self) -> bool {
        self.0.iter().any(|(_, hits)| hits.undecided)
    }
}
